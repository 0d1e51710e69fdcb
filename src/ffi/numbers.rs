//! Numbers of the header for the choices of the library.

use super::guard::Failure;

/// A choice whose values have numbers in the header.
pub(super) trait Numbered: Sized {
    fn number(self) -> i32;
    /// The value with a number, if there is one.
    fn numbered(number: i32) -> Option<Self>;
}

/// Numbers all values of a choice.
macro_rules! numbers {
    ($choice:ty { $($value:ident = $number:ident),* $(,)? }) => {
        impl Numbered for $choice {
            fn number(self) -> i32 {
                match self { $(Self::$value => $number),* }
            }

            fn numbered(number: i32) -> Option<Self> {
                match number { $($number => Some(Self::$value),)* _ => None }
            }
        }
    };
}
pub(super) use numbers;

/// The value that the host has chosen, in a structure called `name`.
pub(super) fn chosen<T: Numbered>(
    position: i32,
    (name, choice): (&str, &str),
    number: i32,
) -> Result<T, Failure> {
    let wrong = || Failure::argument(position, format!("{name}: there is no {choice} {number}"));
    T::numbered(number).ok_or_else(wrong)
}
