//! Errors of a call, named by the argument at fault, and sentences that know which of
//! their numbers are indices.
//!
//! C and Rust count from 0 and write `K[12,7]`; Fortran counts from 1 and writes `K(13,8)`. So a
//! sentence is written with [`index`] and [`entry`], which put marks around an index, and becomes a
//! [`Message`], which resolves them: `format!("{} is not finite", entry("K", [i, j]))`,
//! `format!("pair {}: its weights sum to {sum}", index(pair))`. A sentence without marks is the same
//! in all languages.

use std::fmt;
use std::ops::Deref;

/// The argument that an [`Error::Invalid`] is about.
///
/// The C interface turns it into the position of that argument in the call (status `-k`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Argument {
    /// Space dimension of the contact pairs.
    Dimension,
    /// Number of contact pairs, or of unknowns of an LCP.
    Size,
    /// Stiffness matrix, or the matrix of an LCP.
    Matrix,
    /// Leading dimension of the matrix.
    LeadingDimension,
    /// Nodal loads, or the vector `q` of an LCP.
    Load,
    /// Initial gaps.
    Gap,
    /// Parameters of the friction law: coefficients, thresholds and others.
    Law,
    /// The friction law itself.
    LawChoice,
    /// Slip accumulated before this load case.
    ReferenceSlip,
    /// Covering vector of Lemke's method.
    Covering,
    /// Settings.
    Settings,
    /// Displacements to start from.
    Start,
    /// Contact forces that are measured.
    Force,
    /// Stiffness matrix of the second body.
    SecondMatrix,
    /// Leading dimension of the second body's matrix.
    SecondLeadingDimension,
    /// Degrees of freedom that the host holds fixed.
    Fixed,
    /// Values of the fixed degrees of freedom.
    Prescribed,
    /// Contact pairs: slaves, masters, weights, normals, tangents.
    Pairs,
    /// Remark of a problem file.
    Remark,
    /// Coordinates of the nodes of surfaces.
    Coordinates,
    /// Faces of the slave side of two surfaces.
    SlaveFaces,
    /// Faces of the master side of two surfaces.
    MasterFaces,
    /// A rigid obstacle.
    Obstacle,
    /// The host's order of elimination.
    Order,
    /// A mesh that is written to a file.
    Mesh,
    /// Fields at the nodes of a mesh.
    Fields,
}

impl Argument {
    /// Refuses the argument.
    pub(crate) fn refuse<T>(self, message: impl Into<Message>) -> Result<T, Error> {
        Err(Error::invalid(self, message))
    }
}

/// Which limit of the settings ended a reduction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// It would need more memory than `memory_limit`.
    Memory,
    /// `time_limit` is used up.
    Time,
    /// The progress callback cancelled.
    Cancelled,
}

/// Why a call was refused. Nothing has been computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// An argument is out of range or inconsistent; the message names the entry.
    Invalid {
        /// Which argument.
        argument: Argument,
        /// One sentence for the caller's log, such as `K[12,7] is not finite`.
        message: Message,
    },
    /// The memory for the named work array could not be had.
    OutOfMemory(&'static str),
    /// A limit of the settings, or the progress callback, has ended the reduction of a model.
    Stopped {
        /// Which limit.
        limit: Limit,
        /// One sentence with the limit and what would have been needed.
        message: Message,
    },
    /// A file cannot be read or written; the message names it, the line if there is one, and what
    /// is wrong.
    File(Message),
}

impl Error {
    pub(crate) fn invalid(argument: Argument, message: impl Into<Message>) -> Self {
        Error::Invalid { argument, message: message.into() }
    }

    pub(crate) fn stopped(limit: Limit, message: impl Into<Message>) -> Self {
        Error::Stopped { limit, message: message.into() }
    }

    /// Names the load case, one of several, in the error.
    pub(crate) fn in_case(self, case: usize) -> Self {
        let message = self.message();
        match self {
            Error::Invalid { argument, .. } => Self::invalid(argument, message.in_case(case)),
            other => other,
        }
    }

    /// The sentence.
    pub fn message(&self) -> Message {
        match self {
            Error::Invalid { message, .. }
            | Error::Stopped { message, .. }
            | Error::File(message) => message.clone(),
            Error::OutOfMemory(what) => format!("not enough memory for {what}").into(),
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message())
    }
}

impl std::error::Error for Error {}

/// Between these two characters, of Unicode's private use, stand indices with their brackets.
const BEGIN: char = '\u{E000}';
const END: char = '\u{E001}';

/// Indices of one kind that a sentence names; of more it says so.
pub(crate) const MOST_NAMED: usize = 4;

/// An index for a sentence: `pair 12`, in Fortran `pair 13`.
pub(crate) fn index(i: impl fmt::Display) -> String {
    format!("{BEGIN}{i}{END}")
}

/// An entry of an array for a sentence: `K[12,7]`, in Fortran `K(13,8)`.
pub(crate) fn entry<const N: usize>(array: &str, indices: [impl fmt::Display; N]) -> String {
    let indices = indices.map(|i| i.to_string()).join(",");
    format!("{array}{BEGIN}[{indices}]{END}")
}

/// Sizes that a sentence writes without an exponent.
const IN_DECIMALS: std::ops::Range<f64> = 1e-5..1e15;

/// A number for a sentence: `0.3`, `-1e300`.
pub(crate) fn number(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || IN_DECIMALS.contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// A sentence that can be told in the counting of C or of Fortran.
///
/// As a `str` and printed it counts from 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Message {
    /// As it was written.
    marked: String,
    /// As it is told in C; `None` where it has no marks.
    from_zero: Option<String>,
}

impl Message {
    /// The sentence for Fortran: `pair 12: K[12,7]` is `pair 13: K(13,8)`.
    pub fn counted_from_one(&self) -> String {
        resolve(&self.marked, 1)
    }

    /// The sentence of one of several load cases.
    pub(crate) fn in_case(&self, case: usize) -> Self {
        format!("case {}: {}", index(case), self.marked).into()
    }

    /// The sentence with its marks, to become a part of a longer one.
    pub(crate) fn marked(&self) -> &str {
        &self.marked
    }
}

impl<S: Into<String>> From<S> for Message {
    fn from(sentence: S) -> Self {
        let marked = sentence.into();
        let from_zero = marked.contains(BEGIN).then(|| resolve(&marked, 0));
        Message { marked, from_zero }
    }
}

impl Deref for Message {
    type Target = str;

    fn deref(&self) -> &str {
        self.from_zero.as_ref().unwrap_or(&self.marked)
    }
}

impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self)
    }
}

/// Takes the marks out: what is between them counts from `first`, in round brackets if that is 1.
fn resolve(marked: &str, first: u64) -> String {
    let mut text = String::with_capacity(marked.len() + 8);
    for (i, part) in marked.split(BEGIN).enumerate() {
        let (indices, rest) =
            if i == 0 { ("", part) } else { part.split_once(END).unwrap_or((part, "")) };
        let mut left = indices;
        while let Some(c) = left.chars().next() {
            let digits = left.bytes().take_while(u8::is_ascii_digit).count();
            match left[..digits].parse::<u64>() {
                Ok(index) => text.push_str(&index.saturating_add(first).to_string()),
                Err(_) if first == 1 && c == '[' => text.push('('),
                Err(_) if first == 1 && c == ']' => text.push(')'),
                Err(_) => text.push(c),
            }
            left = &left[digits.max(c.len_utf8())..];
        }
        text.push_str(rest);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{Message, entry, index};

    #[test]
    fn a_message_counts_as_its_language_does() {
        for (written, c, fortran) in [
            (
                entry("K", [12, 7]) + " is not finite",
                "K[12,7] is not finite",
                "K(13,8) is not finite",
            ),
            (entry("gap", [0]) + " is NaN", "gap[0] is NaN", "gap(1) is NaN"),
            (format!("pair {}: 0.5, not 1", index(9)), "pair 9: 0.5, not 1", "pair 10: 0.5, not 1"),
            ("dim is 4 [2 or 3]".to_owned(), "dim is 4 [2 or 3]", "dim is 4 [2 or 3]"),
            (
                format!("{} is {}, as {}", entry("K", [0, 1]), 2.5, entry("K", [1, 0])),
                "K[0,1] is 2.5, as K[1,0]",
                "K(1,2) is 2.5, as K(2,1)",
            ),
        ] {
            let message = Message::from(written);
            assert_eq!(message.to_string(), c);
            assert_eq!(message.counted_from_one(), fortran);
            assert_eq!(Message::from(message.marked()), message);
        }
    }
}
