//! The caller's structures, which begin with their size: `struct_size`, in bytes.

use super::guard::{self, Failure};
use super::status::forget;
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

/// The size in the first field of a structure, if a version of this library may have it: an older
/// one, this one, or a later one.
///
/// # Safety `pointer` has at least 4 readable bytes.
pub(super) unsafe fn checked_size<T>(
    position: i32,
    name: &str,
    pointer: *const T,
) -> Result<usize, Failure> {
    if !pointer.is_aligned() {
        return Err(Failure::argument(position, format!("{name} is not aligned")));
    }
    // SAFETY: by the caller's contract, and aligned.
    let size = unsafe { pointer.cast::<u32>().read() } as usize;
    check_number::<T>(position, name, size)?;
    Ok(size)
}

/// Refuses a size that no version of a structure has.
fn check_number<T>(position: i32, name: &str, size: usize) -> Result<(), Failure> {
    if (LEAST..=MOST).contains(&size) && size.is_multiple_of(ALIGNMENT) {
        return Ok(());
    }
    let ours = size_of::<T>();
    let message = format!("{name}: struct_size is {size}, set it to sizeof ({ours})");
    Err(Failure::argument(position, message))
}

/// The size of a structure that the library reads: all that a later version has beyond ours must be
/// zero, as it asks for something that this version does not have.
///
/// # Safety `pointer` is not NULL and has as many readable bytes as its first field says.
unsafe fn read_size<T>(position: i32, name: &str, pointer: *const T) -> Result<usize, Failure> {
    let ours = size_of::<T>();
    // SAFETY: by the caller's contract.
    let (size, beyond) = unsafe {
        let size = checked_size(position, name, pointer)?;
        let begin = ours.min(size);
        (size, std::slice::from_raw_parts(pointer.cast::<u8>().add(begin), size - begin))
    };
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

/// A copy of the caller's structure; fields that an older program does not have are the defaults, and all are if it is
/// NULL.
///
/// # Safety
/// A pointer that is not NULL has as many readable bytes as its first field says.
pub(super) unsafe fn read<T: Structure>(
    position: i32,
    name: &str,
    pointer: *const T,
) -> Result<T, Failure> {
    let mut copy = T::default_one();
    if !pointer.is_null() {
        // SAFETY: the caller's structure begins with its size.
        unsafe {
            let bytes = read_size(position, name, pointer)?.min(size_of::<T>());
            let target = (&raw mut copy).cast::<u8>();
            std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), target, bytes);
        }
    }
    Ok(copy)
}

/// The caller's structure in place, of a kind that has no older form.
///
/// # Safety
/// NULL, or a structure of the caller that begins with its size.
pub(super) unsafe fn whole<'a, T>(
    position: i32,
    name: &str,
    pointer: *const T,
) -> Result<&'a T, Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    // SAFETY: by the caller's contract.
    let given = unsafe { read_size(position, name, pointer)? };
    if given < size_of::<T>() {
        let message =
            format!("{name}: struct_size is {given}, set it to sizeof ({})", size_of::<T>());
        return Err(Failure::argument(position, message));
    }
    // SAFETY: not NULL, aligned and large enough (just checked).
    Ok(unsafe { &*pointer })
}

/// The field `index_base` of a structure.
pub(super) fn index_base(position: i32, name: &str, base: i32) -> Result<i64, Failure> {
    if base != 0 && base != 1 {
        let message = format!("{name}: index_base is {base}, it must be 0 or 1");
        return Err(Failure::argument(position, message));
    }
    Ok(i64::from(base))
}

/// The bytes from one structure of the caller's array of `count` to the next: what the first one
/// says its size is, which must be that of all.
///
/// # Safety NULL, or an array of `count` structures that begin with their size.
pub(super) unsafe fn stride<T>(
    position: i32,
    name: &str,
    first: *const T,
    count: usize,
) -> Result<usize, Failure> {
    if count == 0 {
        return Ok(0);
    }
    if first.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    // SAFETY: by the caller's contract, as in the loop.
    let stride = unsafe { checked_size(position, name, first)? };
    for i in 1..count {
        // SAFETY: as above.
        let size = unsafe { checked_size(position, name, first.wrapping_byte_add(stride * i))? };
        if size != stride {
            let message = format!("{name} {}: struct_size is {size}, not {stride}", index(i));
            return Err(Failure::argument(position, message));
        }
    }
    Ok(stride)
}

/// The structures of the caller's array in place, of a kind that has no older form.
///
/// # Safety
/// NULL, or an array of `count` structures that begin with their size.
pub(super) unsafe fn all<'a, T>(
    position: i32,
    name: &str,
    first: *const T,
    count: usize,
) -> Result<Vec<&'a T>, Failure> {
    // SAFETY: by the caller's contract.
    let stride = unsafe { stride(position, name, first, count)? };
    // SAFETY: as above.
    let at = |i: usize| unsafe { whole(position, name, first.wrapping_byte_add(stride * i)) };
    (0..count).map(at).collect()
}

/// Writes as much of `value` as the caller's structure holds, and zero beyond it; keeps its `struct_size`.
///
/// # Safety
/// `pointer` was accepted by [`checked_size`] and has as many bytes as its first field says.
pub(super) unsafe fn write<T>(value: &T, pointer: *mut T) {
    const WORD: usize = size_of::<u32>();
    // SAFETY: by the caller's contract.
    unsafe {
        let bytes = pointer.cast::<u32>().read() as usize;
        let known = bytes.min(size_of::<T>());
        let source = std::ptr::from_ref(value).cast::<u8>();
        let target = pointer.cast::<u8>();
        std::ptr::copy_nonoverlapping(source.add(WORD), target.add(WORD), known - WORD);
        std::ptr::write_bytes(target.add(known), 0, bytes - known);
    }
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
            write(&T::default_one(), pointer);
        }
        Ok(0)
    })
}

/// Writes what a handle holds to the caller's structure, the second argument of the call.
///
/// # Safety
/// NULL, or a structure of the caller that begins with its size.
pub(super) unsafe fn tell<T>(value: &T, pointer: *mut T) -> Result<i32, Failure> {
    check_place(2, "data", pointer)?;
    // SAFETY: by the caller's contract.
    unsafe {
        checked_size(2, "data", pointer.cast_const())?;
        write(value, pointer);
    }
    Ok(0)
}

/// Shows what a handle holds in the caller's structure. It takes no memory unless an argument is
/// wrong.
///
/// # Safety NULL or a handle of this library; NULL or a structure of the caller that begins with its
/// size.
pub(super) unsafe fn show<H, T>(
    name: &str,
    handle: *const H,
    data: *mut T,
    shown: impl FnOnce(&H) -> T,
) -> i32 {
    // SAFETY: by the caller's contract.
    let told = match unsafe { handle.as_ref() } {
        // SAFETY: by the caller's contract.
        Some(handle) => unsafe { tell(&shown(handle), data) },
        None => Err(Failure::argument(1, format!("{name} is NULL"))),
    };
    match told {
        Ok(code) => {
            forget();
            code
        }
        Err(failure) => guard::call(|| Err(failure)),
    }
}

fn check_place<T>(position: i32, name: &str, pointer: *mut T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Failure::argument(position, format!("{name} is not aligned")));
    }
    Ok(())
}

/// The address of an array that a handle holds, NULL if it has no entries.
pub(super) fn address<T>(values: &[T]) -> *const T {
    if values.is_empty() { std::ptr::null() } else { values.as_ptr() }
}
