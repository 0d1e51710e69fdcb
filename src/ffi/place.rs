//! Where something stands among the arguments of a call, and the refusal of what is wrong there.

use std::fmt::{self, Display};

use super::guard::{Failure, Outcome};
use crate::error::{Error, entry, index};

/// The place of an argument, or of a part of it, with its name in sentences.
#[derive(Clone, Copy)]
pub(super) struct Place {
    /// The number of the argument.
    pub(super) position: i32,
    pub(super) name: &'static str,
    /// Which structure of an array of them.
    pub(super) number: Option<usize>,
    /// The field of a structure; empty: it is the whole.
    pub(super) field: &'static str,
}

impl Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)?;
        if let Some(number) = self.number {
            write!(f, " {}", index(number))?;
        }
        if self.field.is_empty() { Ok(()) } else { write!(f, ": {}", self.field) }
    }
}

impl Place {
    /// The argument number `position`.
    pub(super) fn of(position: i32, name: &'static str) -> Self {
        Place { position, name, number: None, field: "" }
    }

    /// Refuses it: its name, and what is wrong.
    pub(super) fn refuse<T>(&self, wrong: impl Display) -> Outcome<T> {
        Err(Failure::argument(self.position, format!("{self} {wrong}")))
    }

    /// Refuses an entry of the array.
    pub(super) fn refuse_entry<T>(&self, i: impl Display, wrong: impl Display) -> Outcome<T> {
        let entry = entry(&self.to_string(), [i]);
        Err(Failure::argument(self.position, format!("{entry} {wrong}")))
    }

    /// Refuses it for something in it, a sentence of its own behind the name.
    pub(super) fn refuse_part<T>(&self, wrong: impl Display) -> Outcome<T> {
        Err(Failure::argument(self.position, format!("{self}: {wrong}")))
    }

    /// Refuses it for an error of the library about something in it.
    pub(super) fn refuse_error<T>(&self, error: &Error) -> Outcome<T> {
        self.refuse_part(error.message().marked())
    }

    /// Refuses NULL, unless there are no elements.
    pub(super) fn refuse_null<T>(&self, pointer: *const T, length: usize) -> Outcome<()> {
        if length > 0 && pointer.is_null() { self.refuse("is NULL") } else { Ok(()) }
    }

    /// A size that must not be negative.
    pub(super) fn size(&self, value: i64) -> Outcome<usize> {
        let wrong = |_| self.refuse(format!("is {value}, it must not be negative"));
        usize::try_from(value).or_else(wrong)
    }
}
