//! From pointers to slices: NULL, alignment, size and overlap are checked before any access.

use libc::c_char;
use std::cell::RefCell;
use std::ffi::CStr;
use std::iter::repeat;
use std::ops::Deref;
use std::path::Path;

use super::guard::{self, Failure, Outcome};
use super::place::Place;
use super::status::{
    SIGNORINI_STATUS_CANCELLED, SIGNORINI_STATUS_FILE, SIGNORINI_STATUS_MEMORY_LIMIT,
    SIGNORINI_STATUS_OUT_OF_MEMORY, SIGNORINI_STATUS_TIME_LIMIT,
};
use crate::error::{Argument, Error, Limit};
use crate::linalg::matrix::required_length;
use crate::problem;

/// Runs the body of an entry, a closure of the arrays of the call.
macro_rules! c_entry {
    (|$arrays:ident| $body:block) => {
        $crate::ffi::guard::call(|| {
            // SAFETY: the header's contract.
            let $arrays = &unsafe { $crate::ffi::args::Arrays::of_call() };
            $body
        })
    };
}
pub(super) use c_entry;

/// Bytes that a call holds in reserve for each byte of the host's arrays: of copies, of what is
/// worked out from them, and of holes between.
const IN_RESERVE: usize = 16;

/// The memory of the host that a call may use, of which outputs overlap nothing.
///
/// It stands for the contract of the header, which [`Self::of_call`] asks for once: the methods of [`At`] turn the
/// pointers of the call into slices, structures and outputs after checking them.
pub(super) struct Arrays {
    ranges: RefCell<Vec<Range>>,
    /// The numbers of arguments that the library knows by these names.
    known: RefCell<Vec<(Argument, i32)>>,
}

struct Range {
    place: Place,
    begin: usize,
    end: usize,
    written: bool,
}

/// An argument of the call, or an array in its structure.
#[derive(Clone, Copy)]
pub(super) struct At<'a> {
    arrays: &'a Arrays,
    place: Place,
    /// Bytes held in reserve for each byte of the array.
    in_reserve: usize,
}

/// An array of the caller that results go to at the end of the call.
pub(super) struct Output<T> {
    pointer: *mut T,
    length: usize,
}

impl Arrays {
    /// The arrays of a call, before any is known.
    ///
    /// # Safety
    /// Every pointer that a method of [`At`] is given is an argument of the call, or stands in a structure of its
    /// arguments. It is NULL, or has as many elements as the header demands: initialised ones, if the call reads them,
    /// which nobody writes to during the call; ones that nobody else accesses, if the call writes them.
    pub(super) unsafe fn of_call() -> Self {
        // So many arrays have most calls.
        Arrays {
            ranges: RefCell::new(Vec::with_capacity(16)),
            known: RefCell::new(Vec::with_capacity(8)),
        }
    }

    /// The argument number `position`.
    pub(super) fn at(&self, position: i32, name: &'static str) -> At<'_> {
        At { arrays: self, place: Place::of(position, name), in_reserve: IN_RESERVE }
    }

    /// Dimension, pairs and unknowns, from two arguments with these numbers.
    pub(super) fn sizes(&self, at: [i32; 2], dim: i32, pairs: i64) -> Outcome<[usize; 3]> {
        let dim = problem::checked_dim(dim).map_err(self.refused(at[0]))?;
        let pairs = self.at(at[1], "pairs").size(pairs)?;
        Ok([dim, pairs, problem::unknowns(dim, pairs).map_err(self.refused(at[1]))?])
    }

    /// Why the call ends at an error of the library, which is about the argument that is [said](At::is) to be the one
    /// that it names, else about the argument number `otherwise`.
    pub(super) fn refused(&self, otherwise: i32) -> impl Fn(Error) -> Failure {
        move |error| {
            let message = error.message();
            let code = match error {
                Error::Invalid { argument, .. } => {
                    let known = self.known.borrow();
                    let found = known.iter().find(|(known, _)| *known == argument);
                    -found.map_or(otherwise, |(_, position)| *position)
                }
                Error::OutOfMemory(_) => SIGNORINI_STATUS_OUT_OF_MEMORY,
                Error::Stopped { limit: Limit::Memory, .. } => SIGNORINI_STATUS_MEMORY_LIMIT,
                Error::Stopped { limit: Limit::Time, .. } => SIGNORINI_STATUS_TIME_LIMIT,
                Error::Stopped { limit: Limit::Cancelled, .. } => SIGNORINI_STATUS_CANCELLED,
                Error::File(_) => SIGNORINI_STATUS_FILE,
            };
            Failure { code, message }
        }
    }

    /// Refuses an output that shares memory with another array.
    pub(super) fn check_overlap(&self) -> Outcome<()> {
        let ranges = self.ranges.borrow();
        for (index, one) in ranges.iter().enumerate() {
            for two in &ranges[..index] {
                let overlap = one.begin < two.end && two.begin < one.end;
                if overlap && (one.written || two.written) {
                    let (one, two) = (one.place, two.place);
                    let message = format!("{one} overlaps {two}: arrays must not share memory");
                    return Err(Failure::argument(one.position, message));
                }
            }
        }
        Ok(())
    }
}

impl Deref for At<'_> {
    type Target = Place;

    fn deref(&self) -> &Place {
        &self.place
    }
}

impl<'a> At<'a> {
    /// The same argument under another name.
    pub(super) fn named(self, name: &'static str) -> Self {
        At { place: Place::of(self.position, name), ..self }
    }

    /// The library's errors about `argument` are about this one.
    pub(super) fn is(self, argument: Argument) -> Self {
        self.arrays.known.borrow_mut().push((argument, self.position));
        self
    }

    /// Why the call ends at an error of the library about something in this argument.
    pub(super) fn refused(self) -> impl Fn(Error) -> Failure + use<'a> {
        self.arrays.refused(self.position)
    }

    /// A field of the argument, a structure.
    pub(super) fn field(self, field: &'static str) -> Self {
        At { place: Place { field, ..self.place }, ..self }
    }

    /// A structure of an array of them.
    pub(super) fn number(self, number: usize) -> Self {
        At { place: Place { number: Some(number), ..self.place }, ..self }
    }

    /// It is a matrix. A call makes few copies of one, and holds memory in reserve for them by itself.
    pub(super) fn matrix(self) -> Self {
        At { in_reserve: 0, ..self }
    }

    /// The next argument, of the same name.
    pub(super) fn next(self) -> Self {
        At { place: Place { position: self.position + 1, ..self.place }, ..self }
    }

    /// An array to read, which must not be NULL unless it has no elements.
    pub(super) fn required<T>(self, pointer: *const T, length: usize) -> Outcome<&'a [T]> {
        self.refuse_null(pointer, length)?;
        Ok(self.optional(pointer, length)?.unwrap_or_default())
    }

    /// An array to read, `None` if it is NULL or has no elements.
    pub(super) fn optional<T>(self, pointer: *const T, length: usize) -> Outcome<Option<&'a [T]>> {
        let present = self.note(pointer, length, false)?;
        // SAFETY: not NULL and aligned (just checked); long enough by the contract of the call.
        Ok(present.then(|| unsafe { std::slice::from_raw_parts(pointer, length) }))
    }

    /// A matrix of `n` columns with its leading dimension, the next argument.
    pub(super) fn square(
        self,
        pointer: *const f64,
        (ld_name, ld): (&'static str, i64),
        n: usize,
    ) -> Outcome<(&'a [f64], usize)> {
        let at_ld = self.next().named(ld_name);
        let ld = at_ld.size(ld)?;
        let length = required_length(self.name, n, ld)
            .map_err(|message| Failure::argument(at_ld.position, message))?;
        Ok((self.matrix().required(pointer, length)?, ld))
    }

    /// An array of indices that count from `base`, counted from 0.
    pub(super) fn indices(self, list: *const i64, count: usize, base: i64) -> Outcome<Vec<usize>> {
        self.shifted(self.required(list, count)?, base)
    }

    /// Indices that count from `base`, counted from 0.
    pub(super) fn shifted(self, values: &[i64], base: i64) -> Outcome<Vec<usize>> {
        let shift = |(i, value): (usize, &i64)| {
            let shifted = value.checked_sub(base).and_then(|value| usize::try_from(value).ok());
            let remedy = if base > 0 { ", add 1 to those that count from 0" } else { "" };
            let refuse = || {
                let wrong = format!("is {value}, less than {base}");
                self.refuse_entry(
                    i,
                    format!("{wrong}: indices of this call count from {base}{remedy}"),
                )
            };
            shifted.map_or_else(refuse, Ok)
        };
        values.iter().enumerate().map(shift).collect()
    }

    /// An array to write at the end, which must not be NULL unless it has no elements.
    pub(super) fn output<T>(self, pointer: *mut T, length: usize) -> Outcome<Output<T>> {
        self.refuse_null(pointer, length)?;
        self.optional_output(pointer, length)
    }

    /// An array to write at the end; writing to NULL does nothing.
    pub(super) fn optional_output<T>(self, pointer: *mut T, length: usize) -> Outcome<Output<T>> {
        let present = self.note(pointer.cast_const(), length, true)?;
        Ok(Output { pointer, length: if present { length } else { 0 } })
    }

    /// An object of this library, by its handle.
    pub(super) fn handle<T>(self, handle: *const T) -> Outcome<&'a T> {
        self.refuse_null(handle, 1)?;
        // SAFETY: not NULL; an object that lives, by the contract of the call.
        Ok(unsafe { &*handle })
    }

    /// The name of a file: any bytes on Unix, UTF-8 elsewhere.
    pub(super) fn path(self, pointer: *const c_char) -> Outcome<&'a Path> {
        self.refuse_null(pointer, 1)?;
        // SAFETY: not NULL; a text that ends with a zero, by the contract of the call.
        let bytes = unsafe { CStr::from_ptr(pointer) }.to_bytes();
        if bytes.is_empty() {
            return self.refuse("is empty");
        }
        #[cfg(unix)]
        let path = Some(<std::ffi::OsStr as std::os::unix::ffi::OsStrExt>::from_bytes(bytes));
        #[cfg(not(unix))]
        let path = std::str::from_utf8(bytes).ok();
        path.map_or_else(|| self.refuse("is not UTF-8"), |path| Ok(Path::new(path)))
    }

    /// A text, `None` if it is NULL.
    pub(super) fn text(self, pointer: *const c_char) -> Outcome<Option<&'a str>> {
        if pointer.is_null() {
            return Ok(None);
        }
        // SAFETY: not NULL; a text that ends with a zero, by the contract of the call.
        let text = unsafe { CStr::from_ptr(pointer) }.to_str();
        text.map(Some).or_else(|_| self.refuse("is not UTF-8"))
    }

    /// Checks and notes an array, and holds memory in reserve for it; false if there is nothing to access.
    pub(super) fn note<T>(self, pointer: *const T, length: usize, written: bool) -> Outcome<bool> {
        if length == 0 || pointer.is_null() {
            return Ok(false);
        }
        if !pointer.is_aligned() {
            return self.refuse(format!("is not aligned to {} bytes", align_of::<T>()));
        }
        let begin = pointer.addr();
        let bytes =
            length.checked_mul(size_of::<T>()).filter(|bytes| *bytes <= isize::MAX as usize);
        let Some((bytes, end)) = bytes.and_then(|bytes| Some((bytes, begin.checked_add(bytes)?)))
        else {
            return self.refuse(format!("cannot have {length} entries"));
        };
        self.arrays.ranges.borrow_mut().push(Range { place: self.place, begin, end, written });
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The language has no memory of more than half of all addresses: a length beyond is a mistake of the host.
    #[test]
    fn no_array_is_longer_than_half_of_all_addresses() {
        // SAFETY: nothing is read.
        let arrays = unsafe { Arrays::of_call() };
        let most = isize::MAX as usize / size_of::<f64>();
        for (length, exists) in [(most, true), (most + 1, false)] {
            // Nothing is held in reserve for matrices.
            let noted = arrays.at(1, "x").matrix().note(&1.0_f64, length, false);
            assert_eq!(noted.is_ok(), exists);
        }
    }
}
