//! The caller's structures, which begin with their size: `struct_size`, in bytes.

use super::guard::Failure;

/// Smallest structure of any version: its size, the first word and a number. Fields that an older
/// program does not have come after it.
const LEAST: usize = 16;

/// The size in the first field of a structure, if it is one that a version of this library has.
///
/// # Safety
/// `pointer` has at least 4 readable bytes.
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

/// Sizes of all structures are multiples of that of their widest fields.
const ALIGNMENT: usize = align_of::<i64>();

/// Refuses a size that no version of a structure has.
fn check_number<T>(position: i32, name: &str, size: usize) -> Result<(), Failure> {
    let ours = size_of::<T>();
    if size > ours {
        let message = format!(
            "{name}: struct_size is {size}, this version of the library knows {ours} bytes"
        );
        return Err(Failure::argument(position, message));
    }
    if size < LEAST || !size.is_multiple_of(ALIGNMENT) {
        let message = format!("{name}: struct_size is {size}, set it to sizeof ({ours})");
        return Err(Failure::argument(position, message));
    }
    Ok(())
}

/// A copy of the caller's structure; fields that an older program does not have are those of
/// `default`.
///
/// # Safety
/// `pointer` is not NULL and has as many readable bytes as its first field says.
pub(super) unsafe fn read<T: Copy>(
    position: i32,
    name: &str,
    pointer: *const T,
    mut default: T,
) -> Result<T, Failure> {
    // SAFETY: the caller's structure begins with its size, which is at most ours.
    unsafe {
        let bytes = checked_size(position, name, pointer)?;
        let target = (&raw mut default).cast::<u8>();
        std::ptr::copy_nonoverlapping(pointer.cast::<u8>(), target, bytes);
    }
    Ok(default)
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
    let given = unsafe { checked_size(position, name, pointer)? };
    if given != size_of::<T>() {
        let message =
            format!("{name}: struct_size is {given}, set it to sizeof ({})", size_of::<T>());
        return Err(Failure::argument(position, message));
    }
    // SAFETY: not NULL, aligned and of the right size (just checked).
    Ok(unsafe { &*pointer })
}

/// Writes as much of `value` as the caller's structure holds, and keeps its `struct_size`.
///
/// # Safety
/// `pointer` was accepted by [`checked_size`] and has as many bytes as its first field says.
pub(super) unsafe fn write<T>(value: &T, pointer: *mut T) {
    const WORD: usize = size_of::<u32>();
    // SAFETY: by the caller's contract.
    unsafe {
        let bytes = pointer.cast::<u32>().read() as usize;
        let source = std::ptr::from_ref(value).cast::<u8>();
        let target = pointer.cast::<u8>();
        std::ptr::copy_nonoverlapping(source.add(WORD), target.add(WORD), bytes - WORD);
    }
}

/// Fills the caller's structure of `struct_size` bytes, the second argument of the call, with its
/// defaults and its size.
///
/// # Safety
/// NULL, or `struct_size` writable bytes.
pub(super) unsafe fn fill<T>(
    name: &str,
    pointer: *mut T,
    struct_size: u32,
    default: &T,
) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(1, format!("{name} is NULL")));
    }
    if !pointer.is_aligned() {
        return Err(Failure::argument(1, format!("{name} is not aligned")));
    }
    check_number::<T>(2, name, struct_size as usize)?;
    // SAFETY: as many bytes as `struct_size` says by contract, at most ours as just checked.
    unsafe {
        pointer.cast::<u32>().write(struct_size);
        write(default, pointer);
    }
    Ok(())
}
