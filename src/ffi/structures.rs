//! The caller's structures, which begin with their size: `struct_size`, in bytes.

use std::ptr::null_mut;

use super::args::At;
use super::guard::Outcome;
use super::numbers::Numbered;

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

impl<'a> At<'a> {
    /// A copy of the caller's structure; fields that an older program does not have are the defaults, and all are if it
    /// is NULL.
    pub(super) fn copy<T: Structure>(self, pointer: *const T) -> Outcome<T> {
        let mut copy = T::default_one();
        if !pointer.is_null() {
            let size = self.read_size(pointer)?;
            let is_known = size >= size_of::<T>() || T::OLDER.contains(&size);
            if !(T::OLDER.is_empty() || is_known) {
                return self.refuse_size::<T, _>(size);
            }
            self.note(pointer.cast::<u8>(), size, false)?;
            let (source, target) = (pointer.cast::<u8>(), (&raw mut copy).cast::<u8>());
            // SAFETY: as many bytes as the first field says, by the contract of the call.
            unsafe { std::ptr::copy_nonoverlapping(source, target, size.min(size_of::<T>())) }
        }
        Ok(copy)
    }

    /// As [`Self::copy`], of a structure that must be there.
    pub(super) fn required_copy<T: Structure>(self, pointer: *const T) -> Outcome<T> {
        self.check_place(pointer)?;
        self.copy(pointer)
    }

    /// The caller's structure in place, of a kind that has no older form.
    pub(super) fn whole<T>(self, pointer: *const T) -> Outcome<&'a T> {
        let size = self.read_size(pointer)?;
        if size < size_of::<T>() {
            return self.refuse_size::<T, _>(size);
        }
        // SAFETY: not NULL, aligned and large enough (just checked); the caller's by the contract of the call.
        Ok(unsafe { &*pointer })
    }

    /// The structures of the caller's array in place, of a kind that has no older form.
    pub(super) fn all<T>(self, first: *const T, count: usize) -> Outcome<Vec<&'a T>> {
        let stride = self.stride(first, count)?;
        (0..count).map(|i| self.whole(first.wrapping_byte_add(stride * i))).collect()
    }

    /// A structure that the call writes.
    pub(super) fn out_structure<T>(self, pointer: *mut T) -> Outcome<OutStructures<T>> {
        Ok(OutStructures { first: pointer, stride: self.structure_size(pointer)? })
    }

    /// An array of structures that the call writes; NULL: none is wanted.
    pub(super) fn out_structures<T>(self, list: *mut T, count: usize) -> Outcome<OutStructures<T>> {
        if list.is_null() || count == 0 {
            return Ok(OutStructures { first: null_mut(), stride: 0 });
        }
        let stride = self.stride(list, count)?;
        // An overflow is refused with the array, which cannot have so many entries.
        let bytes = stride.saturating_mul(count);
        self.note(list.cast_const().cast::<u8>(), bytes, true)?;
        Ok(OutStructures { first: list, stride })
    }

    /// Fills the caller's structure of `struct_size` bytes, the next argument, with the defaults and the size.
    pub(super) fn fill<T: Structure>(self, pointer: *mut T, struct_size: u32) -> Outcome<i32> {
        let bytes = struct_size as usize;
        self.check_place(pointer)?;
        self.next().check_size::<T>(bytes)?;
        // SAFETY: as many bytes as `struct_size` says, by the contract of the call.
        unsafe {
            pointer.cast::<u32>().write(struct_size);
            write(&T::default_one(), pointer, bytes);
        }
        Ok(0)
    }

    /// The size in the first field of a structure, if a version of this library may have it: an older
    /// one, this one, or a later one.
    fn structure_size<T>(self, pointer: *const T) -> Outcome<usize> {
        self.check_place(pointer)?;
        // SAFETY: not NULL and aligned; it begins with its size, by the contract of the call.
        let size = unsafe { pointer.cast::<u32>().read() } as usize;
        self.check_size::<T>(size)?;
        Ok(size)
    }

    /// The size of a structure that the library reads: all that a later version has beyond ours must be
    /// zero, as it asks for something that this version does not have.
    fn read_size<T>(self, pointer: *const T) -> Outcome<usize> {
        let size = self.structure_size(pointer)?;
        let ours = size_of::<T>();
        let begin = ours.min(size);
        let beyond = pointer.cast::<u8>().wrapping_add(begin);
        // SAFETY: it has as many bytes as it says, by the contract of the call.
        let beyond = unsafe { std::slice::from_raw_parts(beyond, size - begin) };
        if let Some(byte) = beyond.iter().position(|byte| *byte != 0) {
            let byte = ours + byte;
            return self.refuse_part(format!(
                "struct_size is {size}, this version of the library knows {ours} bytes, and byte {byte} is not \
                 zero: leave the fields of a later version at zero, or use its library"
            ));
        }
        Ok(size)
    }

    /// The bytes from one structure of the caller's array of `count` to the next: what the first one
    /// says its size is, which must be that of all.
    fn stride<T>(self, first: *const T, count: usize) -> Outcome<usize> {
        if count == 0 {
            return Ok(0);
        }
        let stride = self.structure_size(first)?;
        for i in 1..count {
            let size = self.structure_size(first.wrapping_byte_add(stride * i))?;
            if size != stride {
                let wrong = format!("struct_size is {size}, not {stride}");
                return self.number(i).refuse_part(wrong);
            }
        }
        Ok(stride)
    }

    /// Refuses a size that no version of a structure has.
    fn check_size<T>(self, size: usize) -> Outcome<()> {
        let may_be = (LEAST..=MOST).contains(&size) && size.is_multiple_of(ALIGNMENT);
        if may_be { Ok(()) } else { self.refuse_size::<T, _>(size) }
    }

    fn refuse_size<T, R>(self, size: usize) -> Outcome<R> {
        let ours = size_of::<T>();
        self.refuse_part(format!("struct_size is {size}, set it to sizeof ({ours})"))
    }

    fn check_place<T>(self, pointer: *const T) -> Outcome<()> {
        self.refuse_null(pointer, 1)?;
        if pointer.is_aligned() { Ok(()) } else { self.refuse("is not aligned") }
    }

    /// Refuses what the field `reserved` holds that this version does not use.
    pub(super) fn check_reserved(self, reserved: i32) -> Outcome<()> {
        if reserved == 0 {
            return Ok(());
        }
        self.refuse_part(format!("reserved is {reserved}, it must be 0"))
    }

    /// The value that the host has chosen in a structure.
    pub(super) fn chosen<T: Numbered>(self, choice: &str, number: i32) -> Outcome<T> {
        let refuse = || self.refuse_part(format!("there is no {choice} {number}"));
        T::numbered(number).map_or_else(refuse, Ok)
    }

    /// The field `index_base` of a structure.
    pub(super) fn index_base(self, base: i32) -> Outcome<i64> {
        match base {
            0 | 1 => Ok(i64::from(base)),
            _ => self.refuse_part(format!("index_base is {base}, it must be 0 or 1")),
        }
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

/// The address of an array that a handle holds, NULL if it has no entries.
pub(super) fn address<T>(values: &[T]) -> *const T {
    if values.is_empty() { std::ptr::null() } else { values.as_ptr() }
}
