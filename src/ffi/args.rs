//! From pointers to slices: NULL, alignment, size and overlap are checked before any access.

use libc::c_char;
use std::ffi::CStr;
use std::path::Path;

use super::guard::{self, Failure};
use super::structures::checked_size;
use crate::error::Argument;
use crate::linalg::matrix;
use crate::problem;

/// Bytes that a call holds in reserve for each byte of the host's arrays: of copies, of what is
/// worked out from them, and of holes between. For matrices, of which a call makes few copies, it
/// counts by itself.
const IN_RESERVE: usize = 16;

/// The arrays of one call, collected to check that outputs overlap nothing.
#[derive(Default)]
pub(super) struct Arrays {
    ranges: Vec<Range>,
}

struct Range {
    position: i32,
    name: &'static str,
    begin: usize,
    end: usize,
    written: bool,
}

/// An array of the caller that results go to at the end of the call.
pub(super) struct Output<T> {
    pointer: *mut T,
    length: usize,
}

impl Arrays {
    /// An array to read, which must not be NULL unless it has no elements.
    ///
    /// # Safety
    /// A pointer that is not NULL has `length` initialised elements, as the header demands, which
    /// nobody writes to during the call.
    pub(super) unsafe fn required<'a, T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
    ) -> Result<&'a [T], Failure> {
        refuse_null(position, name, pointer, length)?;
        // SAFETY: by the caller's contract.
        let values = unsafe { self.optional(position, name, pointer, length)? };
        Ok(values.unwrap_or_default())
    }

    /// A matrix to read, for which the call holds memory in reserve by itself.
    ///
    /// # Safety
    /// As for [`Self::required`].
    pub(super) unsafe fn matrix<'a>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const f64,
        length: usize,
    ) -> Result<&'a [f64], Failure> {
        refuse_null(position, name, pointer, length)?;
        // SAFETY: by the caller's contract.
        let values = unsafe { self.matrix_or_null(position, name, pointer, length)? };
        Ok(values.unwrap_or_default())
    }

    /// As [`Self::matrix`], `None` if it is NULL or has no elements.
    ///
    /// # Safety
    /// As for [`Self::required`].
    pub(super) unsafe fn matrix_or_null<'a>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const f64,
        length: usize,
    ) -> Result<Option<&'a [f64]>, Failure> {
        let present = self.note(position, name, pointer, length, false)?;
        // SAFETY: as in `optional`.
        Ok(present.then(|| unsafe { std::slice::from_raw_parts(pointer, length) }))
    }

    /// An array to read, `None` if it is NULL or has no elements.
    ///
    /// # Safety
    /// As for [`Self::required`].
    pub(super) unsafe fn optional<'a, T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
    ) -> Result<Option<&'a [T]>, Failure> {
        let present = self.add(position, name, pointer, length, false)?;
        // SAFETY: not NULL and aligned (just checked); long enough by the caller's contract.
        Ok(present.then(|| unsafe { std::slice::from_raw_parts(pointer, length) }))
    }

    /// An array to write at the end, which must not be NULL unless it has no elements.
    pub(super) fn output<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *mut T,
        length: usize,
    ) -> Result<Output<T>, Failure> {
        refuse_null(position, name, pointer, length)?;
        self.optional_output(position, name, pointer, length)
    }

    /// As [`Self::output`], of a matrix that is there already.
    pub(super) fn output_matrix(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *mut f64,
        length: usize,
    ) -> Result<Output<f64>, Failure> {
        refuse_null(position, name, pointer, length)?;
        let present = self.note(position, name, pointer.cast_const(), length, true)?;
        Ok(Output { pointer, length: if present { length } else { 0 } })
    }

    /// An array to write at the end; writing to NULL does nothing.
    pub(super) fn optional_output<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *mut T,
        length: usize,
    ) -> Result<Output<T>, Failure> {
        let present = self.add(position, name, pointer.cast_const(), length, true)?;
        Ok(Output { pointer, length: if present { length } else { 0 } })
    }

    /// A structure of the caller, to be checked for overlap only: as large as it says.
    ///
    /// # Safety
    /// NULL, or a structure that begins with its size.
    pub(super) unsafe fn structure<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        written: bool,
    ) -> Result<(), Failure> {
        if pointer.is_null() {
            return Ok(());
        }
        // SAFETY: by the caller's contract. An older program's structure is smaller than ours.
        let bytes = unsafe { checked_size(position, name, pointer)? };
        self.structures(position, name, pointer, bytes, written)
    }

    /// An array of structures of `bytes` bytes in all.
    pub(super) fn structures<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        bytes: usize,
        written: bool,
    ) -> Result<(), Failure> {
        self.add(position, name, pointer.cast::<u8>(), bytes, written).map(drop)
    }

    /// Refuses an output that shares memory with another array.
    pub(super) fn check_overlap(&self) -> Result<(), Failure> {
        for (index, one) in self.ranges.iter().enumerate() {
            for two in &self.ranges[..index] {
                let overlap = one.begin < two.end && two.begin < one.end;
                if overlap && (one.written || two.written) {
                    return Err(Failure::argument(
                        one.position,
                        format!("{} overlaps {}: arrays must not share memory", one.name, two.name),
                    ));
                }
            }
        }
        Ok(())
    }

    /// Notes an array, and holds memory in reserve for it; false if there is nothing to access.
    fn add<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
        written: bool,
    ) -> Result<bool, Failure> {
        let present = self.note(position, name, pointer, length, written)?;
        if present {
            guard::reserve(IN_RESERVE.saturating_mul(length).saturating_mul(size_of::<T>()))?;
        }
        Ok(present)
    }

    /// Checks and notes an array; false if there is nothing to access.
    fn note<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
        written: bool,
    ) -> Result<bool, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        if length == 0 || pointer.is_null() {
            return Ok(false);
        }
        if !pointer.is_aligned() {
            return refuse(format!("{name} is not aligned to {} bytes", align_of::<T>()));
        }
        let begin = pointer.addr();
        let end = length
            .checked_mul(size_of::<T>())
            .filter(|bytes| *bytes <= isize::MAX as usize)
            .and_then(|bytes| begin.checked_add(bytes));
        let Some(end) = end else {
            return refuse(format!("{name} cannot have {length} entries"));
        };
        self.ranges.push(Range { position, name, begin, end, written });
        Ok(true)
    }
}

impl<T: Copy> Output<T> {
    /// Writes the results.
    ///
    /// # Safety
    /// The pointer has `length` elements, as the header demands, which nobody else accesses.
    pub(super) unsafe fn write(&self, values: &[T]) {
        if self.length > 0 {
            debug_assert_eq!(self.length, values.len());
            // SAFETY: not NULL and aligned (checked when it was made), not overlapping ours.
            unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), self.pointer, self.length) }
        }
    }

    /// A range of it; a range of an empty output is empty.
    pub(super) fn part(&self, begin: usize, length: usize) -> Self {
        let length = if self.length > 0 { length } else { 0 };
        Output { pointer: self.pointer.wrapping_add(begin), length }
    }

    /// A copy of what the array holds now.
    ///
    /// # Safety
    /// As for [`Self::write`]; the elements are initialised.
    pub(super) unsafe fn read(&self) -> Vec<T> {
        if self.length == 0 {
            return Vec::new();
        }
        // SAFETY: as above.
        unsafe { std::slice::from_raw_parts(self.pointer, self.length) }.to_vec()
    }
}

fn refuse_null<T>(
    position: i32,
    name: &str,
    pointer: *const T,
    length: usize,
) -> Result<(), Failure> {
    if length > 0 && pointer.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    Ok(())
}

/// A size that must not be negative.
pub(super) fn size(position: i32, name: &str, value: i64) -> Result<usize, Failure> {
    usize::try_from(value).map_err(|_| {
        Failure::argument(position, format!("{name} is {value}, it must not be negative"))
    })
}

/// Dimension, pairs and unknowns, from the arguments number `first` and `first + 1` of a call.
pub(super) fn sizes(first: i32, dim: i32, pairs: i64) -> Result<(usize, usize, usize), Failure> {
    let place = |argument| first + i32::from(argument == Argument::Size);
    let from_error = |error| Failure::from_error(error, place);
    let dim = problem::checked_dim(dim).map_err(from_error)?;
    let pairs = size(first + 1, "pairs", pairs)?;
    Ok((dim, pairs, problem::unknowns(dim, pairs).map_err(from_error)?))
}

/// Elements of a column-major matrix with `n` rows and columns.
pub(super) fn matrix_length(
    position: i32,
    name: &str,
    n: usize,
    leading: usize,
) -> Result<usize, Failure> {
    matrix::required_length(name, n, leading)
        .map_err(|message| Failure::argument(position, message))
}

/// The name of a file: any bytes on Unix, UTF-8 elsewhere.
///
/// # Safety
/// NULL or a text that ends with a zero and lives as long as the name is used.
pub(super) unsafe fn path<'a>(position: i32, pointer: *const c_char) -> Result<&'a Path, Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(position, "path is NULL"));
    }
    // SAFETY: by the caller's contract.
    let bytes = unsafe { CStr::from_ptr(pointer) }.to_bytes();
    if bytes.is_empty() {
        return Err(Failure::argument(position, "path is empty"));
    }
    #[cfg(unix)]
    let path = Some(<std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(bytes));
    #[cfg(not(unix))]
    let path = std::str::from_utf8(bytes).ok();
    let path = path.ok_or_else(|| Failure::argument(position, "path is not UTF-8"))?;
    Ok(Path::new(path))
}

/// A text, `None` if it is NULL.
///
/// # Safety
/// NULL or a text that ends with a zero and lives as long as it is used.
pub(super) unsafe fn text<'a>(
    position: i32,
    name: &str,
    pointer: *const c_char,
) -> Result<Option<&'a str>, Failure> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: by the caller's contract.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    text.map(Some).map_err(|_| Failure::argument(position, format!("{name} is not UTF-8")))
}
