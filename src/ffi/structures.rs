//! The caller's structures, which begin with their size: `struct_size`, in bytes.

use std::ptr::null_mut;

use super::args::Arrays;
use super::guard::{self, Failure};
use super::numbers::Numbered;
use crate::error::index;

/// Smallest structure of any version: its size, the first word and a number. Fields that an older
/// program does not have come after it.
const LEAST: usize = 16;

/// Largest structure of any version: a larger number is none that `sizeof` has given.
const MOST: usize = 4096;

/// Sizes of all structures are multiples of that of their widest fields.
const ALIGNMENT: usize = align_of::<i64>();

/// A structure of the header.
///
/// # Safety
/// It begins with its size, and zeros are a value of it: its fields are numbers, pointers and callbacks.
pub(super) unsafe trait Structure: Copy {
    /// Bytes of its older forms; none: a program may know any number of its fields.
    const OLDER: &'static [usize] = &[];

    /// Zeros and NULL, with the size.
    fn zeros() -> Self {
        // SAFETY: by the contract of the trait.
        unsafe {
            let mut zeros: Self = std::mem::zeroed();
            (&raw mut zeros).cast::<u32>().write(size_of::<Self>() as u32);
            zeros
        }
    }

    /// The value for a caller who has set nothing.
    fn default_one() -> Self {
        Self::zeros()
    }
}

/// Structures of the caller that the call writes, one or an array of them; none where the caller wants none.
pub(super) struct OutStructures<T> {
    first: *mut T,
    stride: usize,
}

impl<'h> Arrays<'h> {
    /// A copy of the caller's structure; fields that an older program does not have are the defaults, and all are if it
    /// is NULL.
    pub(super) fn copy<T: Structure>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
    ) -> Result<T, Failure> {
        let mut copy = T::default_one();
        if !pointer.is_null() {
            let size = self.read_size(position, name, pointer)?;
            let is_known = size >= size_of::<T>() || T::OLDER.contains(&size);
            if !(T::OLDER.is_empty() || is_known) {
                return Err(wrong_size::<T>(position, name, size));
            }
            self.note(position, name, pointer.cast::<u8>(), size, false)?;
            let (source, target) = (pointer.cast::<u8>(), (&raw mut copy).cast::<u8>());
            // SAFETY: as many bytes as the first field says, by the contract of the call.
            unsafe { std::ptr::copy_nonoverlapping(source, target, size.min(size_of::<T>())) }
        }
        Ok(copy)
    }

    /// As [`Self::copy`], of a structure that must be there.
    pub(super) fn required_copy<T: Structure>(
        &mut self,
        position: i32,
        name: &'static str,
        pointer: *const T,
    ) -> Result<T, Failure> {
        check_place(position, name, pointer)?;
        self.copy(position, name, pointer)
    }

    /// The caller's structure in place, of a kind that has no older form.
    pub(super) fn whole<T>(
        &self,
        position: i32,
        name: &str,
        pointer: *const T,
    ) -> Result<&'h T, Failure> {
        let size = self.read_size(position, name, pointer)?;
        if size < size_of::<T>() {
            return Err(wrong_size::<T>(position, name, size));
        }
        // SAFETY: not NULL, aligned and large enough (just checked); the caller's by the contract of the call.
        Ok(unsafe { &*pointer })
    }

    /// The structures of the caller's array in place, of a kind that has no older form.
    pub(super) fn all<T>(
        &self,
        position: i32,
        name: &str,
        first: *const T,
        count: usize,
    ) -> Result<Vec<&'h T>, Failure> {
        let stride = self.stride(position, name, first, count)?;
        let at = |i: usize| self.whole(position, name, first.wrapping_byte_add(stride * i));
        (0..count).map(at).collect()
    }

    /// A structure that the call writes.
    pub(super) fn out_structure<T>(
        &self,
        position: i32,
        name: &str,
        pointer: *mut T,
    ) -> Result<OutStructures<T>, Failure> {
        check_place(position, name, pointer)?;
        Ok(OutStructures { first: pointer, stride: self.size(position, name, pointer)? })
    }

    /// An array of structures that the call writes; NULL: none is wanted.
    pub(super) fn out_structures<T>(
        &mut self,
        position: i32,
        name: &'static str,
        first: *mut T,
        count: usize,
    ) -> Result<OutStructures<T>, Failure> {
        if first.is_null() || count == 0 {
            return Ok(OutStructures { first: null_mut(), stride: 0 });
        }
        let stride = self.stride(position, name, first, count)?;
        // An overflow is refused with the array, which cannot have so many entries.
        let bytes = stride.saturating_mul(count);
        self.note(position, name, first.cast_const().cast::<u8>(), bytes, true)?;
        Ok(OutStructures { first, stride })
    }

    /// The size in the first field of a structure, if a version of this library may have it: an older
    /// one, this one, or a later one.
    fn size<T>(&self, position: i32, name: &str, pointer: *const T) -> Result<usize, Failure> {
        check_place(position, name, pointer)?;
        // SAFETY: not NULL and aligned; it begins with its size, by the contract of the call.
        let size = unsafe { pointer.cast::<u32>().read() } as usize;
        check_number::<T>(position, name, size)?;
        Ok(size)
    }

    /// The size of a structure that the library reads: all that a later version has beyond ours must be
    /// zero, as it asks for something that this version does not have.
    fn read_size<T>(&self, position: i32, name: &str, pointer: *const T) -> Result<usize, Failure> {
        let size = self.size(position, name, pointer)?;
        let ours = size_of::<T>();
        let begin = ours.min(size);
        let beyond = pointer.cast::<u8>().wrapping_add(begin);
        // SAFETY: it has as many bytes as it says, by the contract of the call.
        let beyond = unsafe { std::slice::from_raw_parts(beyond, size - begin) };
        if let Some(byte) = beyond.iter().position(|byte| *byte != 0) {
            let byte = ours + byte;
            let message = format!(
                "{name}: struct_size is {size}, this version of the library knows {ours} bytes, and byte {byte} is not \
                 zero: leave the fields of a later version at zero, or use its library"
            );
            return Err(Failure::argument(position, message));
        }
        Ok(size)
    }

    /// The bytes from one structure of the caller's array of `count` to the next: what the first one
    /// says its size is, which must be that of all.
    fn stride<T>(
        &self,
        position: i32,
        name: &str,
        first: *const T,
        count: usize,
    ) -> Result<usize, Failure> {
        if count == 0 {
            return Ok(0);
        }
        let stride = self.size(position, name, first)?;
        for i in 1..count {
            let size = self.size(position, name, first.wrapping_byte_add(stride * i))?;
            if size != stride {
                let message = format!("{name} {}: struct_size is {size}, not {stride}", index(i));
                return Err(Failure::argument(position, message));
            }
        }
        Ok(stride)
    }
}

impl<T> OutStructures<T> {
    /// Writes as much of `value` as the `i`-th structure holds, and zero beyond it; keeps its `struct_size`.
    pub(super) fn write(&self, i: usize, value: &T) {
        if !self.first.is_null() {
            // SAFETY: made by `Arrays`: a structure of the caller with so many bytes.
            unsafe { write(value, self.first.wrapping_byte_add(self.stride * i), self.stride) }
        }
    }
}

/// Writes as much of `value` as `bytes` hold, and zero beyond it, behind the size of the structure.
///
/// # Safety
/// `pointer` has so many bytes, at least those of the size.
unsafe fn write<T>(value: &T, pointer: *mut T, bytes: usize) {
    const WORD: usize = size_of::<u32>();
    let known = bytes.min(size_of::<T>());
    let (source, target) = (std::ptr::from_ref(value).cast::<u8>(), pointer.cast::<u8>());
    // SAFETY: by the caller's contract.
    unsafe {
        std::ptr::copy_nonoverlapping(source.add(WORD), target.add(WORD), known - WORD);
        std::ptr::write_bytes(target.add(known), 0, bytes - known);
    }
}

/// Refuses a size that no version of a structure has.
fn check_number<T>(position: i32, name: &str, size: usize) -> Result<(), Failure> {
    if (LEAST..=MOST).contains(&size) && size.is_multiple_of(ALIGNMENT) {
        return Ok(());
    }
    Err(wrong_size::<T>(position, name, size))
}

fn wrong_size<T>(position: i32, name: &str, size: usize) -> Failure {
    let ours = size_of::<T>();
    Failure::argument(position, format!("{name}: struct_size is {size}, set it to sizeof ({ours})"))
}

fn check_place<T>(position: i32, name: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Failure::argument(position, format!("{name} is not aligned")));
    }
    Ok(())
}

/// Refuses what a field holds that this version does not use.
pub(super) fn check_reserved(position: i32, name: &str, reserved: i32) -> Result<(), Failure> {
    if reserved == 0 {
        return Ok(());
    }
    let message = format!("{name}: reserved is {reserved}, it must be 0");
    Err(Failure::argument(position, message))
}

/// The value that the host has chosen, in a structure called `name`.
pub(super) fn chosen<T: Numbered>(
    position: i32,
    (name, choice): (&str, &str),
    number: i32,
) -> Result<T, Failure> {
    let wrong = || Failure::argument(position, format!("{name}: there is no {choice} {number}"));
    T::numbered(number).ok_or_else(wrong)
}

/// The field `index_base` of a structure.
pub(super) fn index_base(position: i32, name: &str, base: i32) -> Result<i64, Failure> {
    if base != 0 && base != 1 {
        let message = format!("{name}: index_base is {base}, it must be 0 or 1");
        return Err(Failure::argument(position, message));
    }
    Ok(i64::from(base))
}

/// The call that fills the caller's structure of `struct_size` bytes, its second argument, with the defaults and the
/// size.
///
/// # Safety
/// NULL, or `struct_size` writable bytes.
pub(super) unsafe fn fill<T: Structure>(name: &str, pointer: *mut T, struct_size: u32) -> i32 {
    guard::call(|| {
        check_place(1, name, pointer)?;
        check_number::<T>(2, name, struct_size as usize)?;
        // SAFETY: as many bytes as `struct_size` says by contract.
        unsafe {
            pointer.cast::<u32>().write(struct_size);
            write(&T::default_one(), pointer, struct_size as usize);
        }
        Ok(0)
    })
}

/// The address of an array that a handle holds, NULL if it has no entries.
pub(super) fn address<T>(values: &[T]) -> *const T {
    if values.is_empty() { std::ptr::null() } else { values.as_ptr() }
}
