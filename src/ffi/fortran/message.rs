//! SGMESG: the last sentence for Fortran, whose numbers count from 1.

use libc::c_char;
use std::ffi::CStr;

use super::super::status::{last_counted_from_one, signorini_last_error};
use super::arguments::{Integer, read};

/// In front of these words' numbers stand indices, in sentences that do not mark them.
const COUNTED: [&str; 6] =
    ["pair ", "row ", "column ", "entry ", "degree of freedom ", "degrees of freedom "];

/// A sentence without marks is searched for its indices.
fn last() -> String {
    let marked = last_counted_from_one();
    // SAFETY: the library's own zero-terminated buffer.
    let plain = unsafe { CStr::from_ptr(signorini_last_error()) }.to_string_lossy().into_owned();
    if marked == plain { from_one(&plain) } else { marked }
}

fn from_one(text: &str) -> String {
    // A Fortran entry solves one case.
    let mut rest = text.strip_prefix("case 0: ").unwrap_or(text);
    let mut out = String::with_capacity(text.len() + 8);
    let mut inside = false;
    let mut range = false;
    while let Some(first) = rest.chars().next() {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        if digits == 0 {
            inside = match first {
                '[' => true,
                ']' => false,
                _ => inside,
            };
            out.push(match first {
                '[' => '(',
                ']' => ')',
                other => other,
            });
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (number, after) = rest.split_at(digits);
        let counted = inside
            || COUNTED.iter().any(|word| out.ends_with(word))
            || (range && out.ends_with(" to "));
        range = counted && after.starts_with(" to ");
        match number.parse::<u64>() {
            Ok(value) if counted => out.push_str(&(value + 1).to_string()),
            _ => out.push_str(number),
        }
        rest = after;
    }
    out
}

/// SGMESG. Its length is an argument, so that it does not matter how, and whether, a compiler
/// hands over the length of a CHARACTER on its own.
///
/// # Safety
/// `text` has `ltext` characters.
pub(super) unsafe fn copy<I: Integer>(text: *mut c_char, ltext: *const I) {
    // SAFETY: by the caller's contract.
    let Ok(length) = (unsafe { read(2, "LTEXT", ltext) }) else { return };
    // No CHARACTER for a sentence is longer: such a length is refused, not written to.
    let Some(length) = usize::try_from(length.wide()).ok().filter(|n| *n <= i32::MAX as usize)
    else {
        return;
    };
    if text.is_null() {
        return;
    }
    let sentence = last();
    let bytes = sentence.bytes().chain(std::iter::repeat(b' ')).take(length);
    for (i, byte) in bytes.enumerate() {
        // SAFETY: i < length.
        unsafe { text.add(i).write(byte as c_char) };
    }
}

#[cfg(test)]
mod tests {
    use super::from_one;

    #[test]
    fn sentences_count_from_one() {
        for (c, fortran) in [
            ("K[12,7] is not finite", "K(13,8) is not finite"),
            ("gap[0] is NaN", "gap(1) is NaN"),
            ("dim is 4, it must be 2 or 3", "dim is 4, it must be 2 or 3"),
            (
                "pair 9: its weights sum to 0.5, not to 1",
                "pair 10: its weights sum to 0.5, not to 1",
            ),
            ("the begin of column 0 is out of order", "the begin of column 1 is out of order"),
            ("3 of the degrees of freedom 4 to 9", "3 of the degrees of freedom 5 to 10"),
            ("case 0: mu[2] is -1", "mu(3) is -1"),
        ] {
            assert_eq!(from_one(c), fortran);
        }
    }
}
