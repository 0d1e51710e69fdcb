//! SGMESG: the last sentence for Fortran, whose numbers count from 1.

use libc::c_char;

use super::super::status::last_counted_from_one;
use super::arguments::{Given, Integer};

export! {
    // Its length is an argument, so that it does not matter how, and whether, a compiler hands over the length of a
    // CHARACTER on its own.
    sgmesg_ sgmesg_64_ (text: *mut c_char, ltext: Given<I>) {
        if let Ok(length) = ltext.read(2, "LTEXT") {
            fill(text, length.wide(), &last_counted_from_one());
        }
    }
}

/// Puts a sentence into a CHARACTER, padded with blanks.
///
/// # Safety
/// `text` is NULL or has `length` characters.
pub(super) unsafe fn fill(text: *mut c_char, length: i64, sentence: &str) {
    // No CHARACTER for a sentence is longer: such a length is refused, not written to.
    let Some(length) = usize::try_from(length).ok().filter(|n| *n <= i32::MAX as usize) else {
        return;
    };
    if text.is_null() {
        return;
    }
    let bytes = sentence.bytes().chain(std::iter::repeat(b' ')).take(length);
    for (i, byte) in bytes.enumerate() {
        // SAFETY: i < length.
        unsafe { text.add(i).write(byte as c_char) };
    }
}
