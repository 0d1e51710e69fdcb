//! From pointers to slices: NULL, alignment, size and overlap are checked before any access.

use libc::c_char;
use std::ffi::CStr;
use std::iter::repeat;
use std::marker::PhantomData;
use std::path::Path;

use super::guard::{self, Failure};
use crate::error::Argument;
use crate::linalg::matrix::required_length;
use crate::problem;

/// Runs the body of an entry, a closure of the arrays of the call.
macro_rules! c_entry {
    ($body:expr) => {
        $crate::ffi::guard::call(|| {
            // SAFETY: the header's contract.
            let mut arrays = unsafe { $crate::ffi::args::Arrays::of_call() };
            $crate::ffi::args::on_arrays(&mut arrays, $body)
        })
    };
}
pub(super) use c_entry;

/// Runs the body of an entry: the arrays' lifetime is that of what is made of them.
pub(super) fn on_arrays<'h>(
    arrays: &mut Arrays<'h>,
    body: impl FnOnce(&mut Arrays<'h>) -> Result<i32, Failure>,
) -> Result<i32, Failure> {
    body(arrays)
}

/// Bytes that a call holds in reserve for each byte of the host's arrays: of copies, of what is
/// worked out from them, and of holes between. For matrices, of which a call makes few copies, it
/// counts by itself.
const IN_RESERVE: usize = 16;

/// The memory of the host that a call may use, of which outputs overlap nothing.
///
/// It stands for the contract of the header, which [`Self::of_call`] asks for once: its methods turn the pointers of
/// the call into slices, structures and outputs after checking them.
pub(super) struct Arrays<'h> {
    ranges: Vec<Range>,
    /// Bytes held in reserve for each byte of what is noted next.
    in_reserve: usize,
    host: PhantomData<&'h [u8]>,
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

impl<'h> Arrays<'h> {
    /// The arrays of a call, before any is known.
    ///
    /// # Safety
    /// Every pointer that a method is given is an argument of the call, or stands in a structure of its arguments. It
    /// is NULL, or has as many elements as the header demands: initialised ones, if the call reads them, which nobody
    /// writes to during the call; ones that nobody else accesses, if the call writes them.
    pub(super) unsafe fn of_call() -> Self {
        // So many arrays have most calls.
        Arrays { ranges: Vec::with_capacity(16), in_reserve: IN_RESERVE, host: PhantomData }
    }

    /// An array to read, which must not be NULL unless it has no elements.
    pub(super) fn required<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
    ) -> Result<&'h [T], Failure> {
        refuse_null(position, name, pointer, length)?;
        Ok(self.optional(position, name, pointer, length)?.unwrap_or_default())
    }

    /// Notes matrices, for which the call holds memory in reserve by itself.
    pub(super) fn matrices<T>(
        &mut self,
        note: impl FnOnce(&mut Self) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        self.in_reserve = 0;
        let noted = note(self);
        self.in_reserve = IN_RESERVE;
        noted
    }

    /// A matrix of `n` columns, argument number `position`, with its leading dimension, the next one: both with names.
    pub(super) fn square(
        &mut self,
        position: i32,
        (name, pointer): (&'static str, *const f64),
        (ld_name, ld): (&str, i64),
        n: usize,
    ) -> Result<(&'h [f64], usize), Failure> {
        let ld = size(position + 1, ld_name, ld)?;
        let length = required_length(name, n, ld)
            .map_err(|message| Failure::argument(position + 1, message))?;
        let matrix = self.matrices(|arrays| arrays.required(position, name, pointer, length))?;
        Ok((matrix, ld))
    }

    /// An array to read, `None` if it is NULL or has no elements.
    pub(super) fn optional<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
        length: usize,
    ) -> Result<Option<&'h [T]>, Failure> {
        let present = self.note(position, name, pointer, length, false)?;
        // SAFETY: not NULL and aligned (just checked); long enough by the contract of the call.
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

    /// An array to write at the end; writing to NULL does nothing.
    pub(super) fn optional_output<T>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *mut T,
        length: usize,
    ) -> Result<Output<T>, Failure> {
        let present = self.note(position, name, pointer.cast_const(), length, true)?;
        Ok(Output { pointer, length: if present { length } else { 0 } })
    }

    /// An object of this library, by its handle.
    pub(super) fn handle<T>(
        &self,
        position: i32,
        name: &str,
        handle: *const T,
    ) -> Result<&'h T, Failure> {
        refuse_null(position, name, handle, 1)?;
        // SAFETY: not NULL; an object that lives, by the contract of the call.
        Ok(unsafe { &*handle })
    }

    /// The name of a file: any bytes on Unix, UTF-8 elsewhere.
    pub(super) fn path(&self, position: i32, pointer: *const c_char) -> Result<&'h Path, Failure> {
        refuse_null(position, "path", pointer, 1)?;
        // SAFETY: not NULL; a text that ends with a zero, by the contract of the call.
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
    pub(super) fn text(
        &self,
        position: i32,
        name: &str,
        pointer: *const c_char,
    ) -> Result<Option<&'h str>, Failure> {
        if pointer.is_null() {
            return Ok(None);
        }
        // SAFETY: not NULL; a text that ends with a zero, by the contract of the call.
        let text = unsafe { CStr::from_ptr(pointer) }.to_str();
        text.map(Some).map_err(|_| Failure::argument(position, format!("{name} is not UTF-8")))
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

    /// Checks and notes an array, and holds memory in reserve for it; false if there is nothing to access.
    pub(super) fn note<T>(
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
        let bytes =
            length.checked_mul(size_of::<T>()).filter(|bytes| *bytes <= isize::MAX as usize);
        let Some((bytes, end)) = bytes.and_then(|bytes| Some((bytes, begin.checked_add(bytes)?)))
        else {
            return refuse(format!("{name} cannot have {length} entries"));
        };
        self.ranges.push(Range { position, name, begin, end, written });
        guard::reserve(self.in_reserve.saturating_mul(bytes))?;
        Ok(true)
    }
}

impl<T: Copy> Output<T> {
    /// Writes the results.
    pub(super) fn write(&self, values: &[T]) {
        if self.length > 0 {
            debug_assert_eq!(self.length, values.len());
            // SAFETY: made by `Arrays`: not NULL, aligned, so many elements that overlap none of ours.
            unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), self.pointer, self.length) }
        }
    }

    /// Writes the results; `None`: `nothing` in each place.
    pub(super) fn write_or(&self, values: Option<&Vec<T>>, nothing: T) {
        match values {
            Some(values) => self.write(values),
            None => self.write_each(repeat(nothing)),
        }
    }

    /// Writes results that are made one by one.
    pub(super) fn write_each(&self, values: impl Iterator<Item = T>) {
        for (i, value) in (0..self.length).zip(values) {
            // SAFETY: as above.
            unsafe { self.pointer.add(i).write(value) };
        }
    }

    /// A range of it; a range of an empty output is empty.
    pub(super) fn part(&self, begin: usize, length: usize) -> Self {
        let length = if self.length > 0 { length } else { 0 };
        Output { pointer: self.pointer.wrapping_add(begin), length }
    }

    /// A copy of the elements that the caller has put there.
    pub(super) fn read(&self) -> Vec<T> {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The language has no memory of more than half of all addresses: a length beyond is a mistake of the host.
    #[test]
    fn no_array_is_longer_than_half_of_all_addresses() {
        // SAFETY: nothing is read.
        let mut arrays = unsafe { Arrays::of_call() };
        let most = isize::MAX as usize / size_of::<f64>();
        for (length, exists) in [(most, true), (most + 1, false)] {
            // Of matrices, nothing is held in reserve.
            let noted = arrays.matrices(|arrays| arrays.note(1, "x", &1.0_f64, length, false));
            assert_eq!(noted.is_ok(), exists);
        }
    }
}
