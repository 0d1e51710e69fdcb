//! Errors that name a file.

use std::path::Path;

use crate::error::Error;

/// An error about a file. Of a long path the end is shown, so that what is wrong stays in sight; control
/// characters, which would break the line of the message, are shown as '?'.
pub(super) fn refuse(path: &Path, line: Option<u64>, what: &str) -> Error {
    const MOST: usize = 160;
    let path = path.to_string_lossy().replace(char::is_control, "?");
    let count = path.chars().count();
    let shown: String = match count.checked_sub(MOST) {
        Some(cut) if cut > 0 => "...".chars().chain(path.chars().skip(cut)).collect(),
        _ => path,
    };
    let message = match line {
        Some(line) => format!("{shown}: line {line}: {what}"),
        None => format!("{shown}: {what}"),
    };
    Error::File(message.into())
}

/// The message of the system about a file that cannot be read or written.
pub(super) fn failed(path: &Path, what: &str, error: &std::io::Error) -> Error {
    match error.kind() {
        std::io::ErrorKind::OutOfMemory => Error::OutOfMemory("the name of a file"),
        _ => refuse(path, None, &format!("cannot be {what}: {error}")),
    }
}
