//! Numbers of the header for the choices of the library.

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
