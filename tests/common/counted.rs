//! Bytes that the program holds, and the most that it held: `malloc` and its relatives, over those of glibc.
//! The library has the one allocator that Rust allows a program.

use std::ffi::{c_int, c_void};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::sync::{Mutex, MutexGuard, PoisonError};

static NOW: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

static ALONE: Mutex<()> = Mutex::new(());

/// Keeps other tests of the program waiting: the counts are those of all its threads.
pub fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The bytes that are held.
pub fn held() -> usize {
    NOW.load(Relaxed)
}

/// The most bytes that were held at a time while `work` ran, beside those held before, and its result.
pub fn peak<T>(work: impl FnOnce() -> T) -> (usize, T) {
    let before = NOW.load(Relaxed);
    PEAK.store(before, Relaxed);
    let result = work();
    (PEAK.load(Relaxed) - before, result)
}

unsafe extern "C" {
    fn __libc_malloc(size: usize) -> *mut c_void;
    fn __libc_calloc(count: usize, size: usize) -> *mut c_void;
    fn __libc_realloc(old: *mut c_void, size: usize) -> *mut c_void;
    fn __libc_memalign(alignment: usize, size: usize) -> *mut c_void;
    fn __libc_free(memory: *mut c_void);
    fn malloc_usable_size(memory: *mut c_void) -> usize;
}

/// # Safety
/// NULL or a piece that lives.
unsafe fn size_of_piece(memory: *mut c_void) -> usize {
    // SAFETY: the caller's.
    if memory.is_null() { 0 } else { unsafe { malloc_usable_size(memory) } }
}

/// # Safety
/// NULL or a new piece.
unsafe fn noted(memory: *mut c_void) -> *mut c_void {
    // SAFETY: the caller's.
    let size = unsafe { size_of_piece(memory) };
    PEAK.fetch_max(NOW.fetch_add(size, Relaxed) + size, Relaxed);
    memory
}

#[unsafe(no_mangle)]
unsafe extern "C" fn malloc(size: usize) -> *mut c_void {
    // SAFETY: the caller's, as of all here.
    unsafe { noted(__libc_malloc(size)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn calloc(count: usize, size: usize) -> *mut c_void {
    // SAFETY: as above.
    unsafe { noted(__libc_calloc(count, size)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn realloc(old: *mut c_void, size: usize) -> *mut c_void {
    // SAFETY: as above. Both are there while one is copied to the other.
    unsafe {
        let before = size_of_piece(old);
        let new = noted(__libc_realloc(old, size));
        NOW.fetch_sub(before, Relaxed);
        new
    }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn memalign(alignment: usize, size: usize) -> *mut c_void {
    // SAFETY: as above.
    unsafe { noted(__libc_memalign(alignment, size)) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn aligned_alloc(alignment: usize, size: usize) -> *mut c_void {
    // SAFETY: as above.
    unsafe { memalign(alignment, size) }
}

#[unsafe(no_mangle)]
unsafe extern "C" fn posix_memalign(
    place: *mut *mut c_void,
    alignment: usize,
    size: usize,
) -> c_int {
    const NO_MEMORY: c_int = 12;
    // SAFETY: as above.
    unsafe {
        let memory = memalign(alignment, size);
        if memory.is_null() {
            return NO_MEMORY;
        }
        place.write(memory);
    }
    0
}

#[unsafe(no_mangle)]
unsafe extern "C" fn free(memory: *mut c_void) {
    // SAFETY: as above.
    unsafe {
        NOW.fetch_sub(size_of_piece(memory), Relaxed);
        __libc_free(memory);
    }
}
