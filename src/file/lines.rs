//! Defensive reader of lines, and of the numbers that stand one a line.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use super::errors::refuse;
use crate::error::{Error, entry, index};

/// Most bytes of a line, its end included.
const MOST_LINE: u64 = 4096;

/// The lines of a file, counted from 1.
pub(super) struct Lines<'a> {
    path: &'a Path,
    reader: BufReader<File>,
    line: Vec<u8>,
    pub(super) number: u64,
}

impl<'a> Lines<'a> {
    pub(super) fn new(path: &'a Path, file: File) -> Self {
        Lines { path, reader: BufReader::new(file), line: Vec::new(), number: 0 }
    }

    /// Goes to the next line; false at the end of the file.
    pub(super) fn advance(&mut self) -> Result<bool, Error> {
        self.line.clear();
        self.number += 1;
        let read = (&mut self.reader).take(MOST_LINE).read_until(b'\n', &mut self.line);
        if let Err(error) = read {
            return self.refuse(format!("cannot be read: {error}"));
        }
        match self.line.last() {
            None => Ok(false),
            Some(b'\n') => Ok(true),
            Some(_) if self.line.len() as u64 == MOST_LINE => {
                self.refuse(format!("longer than {MOST_LINE} bytes"))
            }
            // Half a number may look like a number.
            Some(_) => self.refuse("the file ends before the line does"),
        }
    }

    /// Goes to the next line, which must be there.
    pub(super) fn require(&mut self, what: impl FnOnce() -> String) -> Result<(), Error> {
        match self.advance()? {
            true => Ok(()),
            false => self.refuse(format!("the file ends, {} is missing", what())),
        }
    }

    /// The line without its end and the space around it.
    pub(super) fn text(&self) -> Cow<'_, str> {
        String::from_utf8_lossy(self.line.trim_ascii())
    }

    /// Refuses this line.
    pub(super) fn refuse<T>(&self, what: impl AsRef<str>) -> Result<T, Error> {
        self.refuse_at(self.number, what)
    }

    /// Refuses another line.
    pub(super) fn refuse_at<T>(&self, number: u64, what: impl AsRef<str>) -> Result<T, Error> {
        Err(refuse(self.path, Some(number), what.as_ref()))
    }

    /// Reads `count` entries, those of `name` by columns of `size`. No more than `most` of them are
    /// given memory before they are seen.
    pub(super) fn entries(
        &mut self,
        name: &str,
        (size, count): (usize, usize),
        most: usize,
    ) -> Result<Vec<f64>, Error> {
        let memory = |_| Error::OutOfMemory("the problem in the file");
        let mut values: Vec<f64> = Vec::new();
        values.try_reserve_exact(count.min(most)).map_err(memory)?;
        for i in 0..count {
            let place = || match count == size {
                true => format!("{name}, row {}", index(i)),
                false => entry(name, [i % size, i / size]),
            };
            self.require(place)?;
            let value = self.value(name == "gap", place)?;
            if values.len() == values.capacity() {
                values.try_reserve(1).map_err(memory)?;
            }
            values.push(value);
        }
        Ok(values)
    }

    /// The number of this line, finite, or `+inf` where it may be.
    fn value(&self, infinite: bool, place: impl Fn() -> String) -> Result<f64, Error> {
        let text = self.text();
        let wrong = |what: &str| self.refuse(format!("{}: {} {what}", place(), shown(&text)));
        match text.parse::<f64>() {
            Err(_) => wrong("is not a number"),
            Ok(value) if value.is_finite() => Ok(value),
            Ok(_) if text.contains(|c: char| c.is_ascii_digit()) => wrong("is too large"),
            Ok(value) if infinite && value > 0.0 => Ok(value),
            Ok(_) => wrong("must be finite"),
        }
    }
}

/// A part of a file in a message: printable, and not long.
pub(super) fn shown(text: &str) -> String {
    const MOST: usize = 40;
    let cut = text.chars().nth(MOST).is_some();
    let text: String = text.chars().take(MOST).collect();
    format!("'{}{}'", text.escape_debug(), if cut { "..." } else { "" })
}
