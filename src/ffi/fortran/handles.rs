//! Objects known by numbers. Fortran has no pointer type of its own: an address in an INTEGER*8 would be
//! followed whatever it holds, a number that is not here is refused.

use std::any::Any;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::super::guard::Failure;
use super::super::model::SignoriniModel;
use super::super::surface_new::SignoriniSurfacePairs;
use super::arguments::{Given, write};

/// A kind of objects.
pub(super) trait Kind: Any + Send + Sync {
    /// The argument that holds a number of one.
    const NAME: &'static str;
    /// The sentence on a number that is not here goes on so.
    const NONE: &'static str;
}

impl Kind for SignoriniModel {
    const NAME: &'static str = "HANDLE";
    const NONE: &'static str = "there is no such model";
}

impl Kind for SignoriniSurfacePairs {
    const NAME: &'static str = "HSURF";
    const NONE: &'static str = "there are no such pairs";
}

/// The objects that live, and the last number. No number is used twice.
struct Living {
    last: i64,
    by_number: BTreeMap<i64, Arc<dyn Any + Send + Sync>>,
}

/// The upper half of a number is not 0, so that one cut to an INTEGER*4 is never one.
const BEFORE_THE_FIRST: i64 = i64::from_be_bytes(*b"\0\0SG\0\0\0\0");

static LIVING: Mutex<Living> =
    Mutex::new(Living { last: BEFORE_THE_FIRST, by_number: BTreeMap::new() });

type Opened = MutexGuard<'static, Living>;

/// The objects, for this thread alone.
fn open() -> Opened {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    fork::guard();
    locked()
}

fn locked() -> Opened {
    // The map is whole whenever a panic can happen.
    LIVING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Makes an object by a function of C and puts its number into the handle, 0 if there is none.
///
/// # Safety
/// `handle` is NULL or a place of the caller; `make` puts a boxed object where it is told, if it returns 0.
pub(super) unsafe fn create<T: Kind>(
    position: i32,
    handle: *mut i64,
    make: impl FnOnce(*mut *mut T) -> Result<i32, Failure>,
) -> Result<i32, Failure> {
    if handle.is_null() {
        return Err(Failure::argument(position, format!("{} is NULL", T::NAME)));
    }
    // SAFETY: by the caller's contract.
    unsafe { write(handle, 0) };
    let mut boxed = std::ptr::null_mut();
    let status = make(&raw mut boxed)?;
    if status == 0 {
        // SAFETY: a new object, which is ours alone.
        let object: Arc<T> = Arc::from(unsafe { Box::from_raw(boxed) });
        let mut opened = open();
        opened.last += 1;
        let number = opened.last;
        opened.by_number.insert(number, object);
        // SAFETY: by the caller's contract.
        unsafe { write(handle, number) };
    }
    Ok(status)
}

/// The object of a handle, which lives on during the call even if another thread releases it.
pub(super) fn find<T: Kind>(position: i32, handle: Given<i64>) -> Result<Arc<T>, Failure> {
    object(position, handle.read(position, T::NAME)?)
}

fn object<T: Kind>(position: i32, number: i64) -> Result<Arc<T>, Failure> {
    let found = open().by_number.get(&number).cloned();
    let of_this_kind = found.and_then(|found| found.downcast().ok());
    of_this_kind.ok_or_else(|| unknown::<T>(position, number))
}

/// Releases the object of a handle, the first argument, which becomes 0. A handle of 0 is allowed.
///
/// # Safety
/// `handle` is NULL or a number of the caller.
pub(super) unsafe fn free<T: Kind>(handle: *mut i64) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let number = unsafe { Given::of(handle) }.read(1, T::NAME)?;
    if number != 0 {
        object::<T>(1, number)?;
        let released = open().by_number.remove(&number);
        drop(released.ok_or_else(|| unknown::<T>(1, number))?);
    }
    // SAFETY: by the caller's contract.
    unsafe { write(handle, 0) };
    Ok(0)
}

fn unknown<T: Kind>(position: i32, number: i64) -> Failure {
    let message = format!("{} is {number}, {}; is it INTEGER*8?", T::NAME, T::NONE);
    Failure::argument(position, message)
}

/// A child of a fork begins with one thread, and would wait for ever for a lock that another thread of its parent held.
#[cfg(any(target_os = "linux", target_os = "macos"))]
mod fork {
    use libc::c_int;
    use std::cell::UnsafeCell;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    use super::{Opened, locked};

    type Handler = Option<unsafe extern "C" fn()>;

    unsafe extern "C" {
        fn pthread_atfork(before: Handler, in_parent: Handler, in_child: Handler) -> c_int;
    }

    /// The lock, from before a fork to after it.
    struct ForkLock(UnsafeCell<Option<Opened>>);

    // SAFETY: it is used by the thread that has the lock.
    unsafe impl Sync for ForkLock {}

    static KEPT: ForkLock = ForkLock(UnsafeCell::new(None));

    unsafe extern "C" fn lock() {
        let opened = locked();
        // SAFETY: this thread has the lock.
        unsafe { *KEPT.0.get() = Some(opened) };
    }

    unsafe extern "C" fn unlock() {
        // SAFETY: this thread has the lock since before the fork; it is open when the cell is empty.
        let opened = unsafe { (*KEPT.0.get()).take() };
        drop(opened);
    }

    /// From now on a fork waits for the lock, and both processes have it open. Without memory for that it is
    /// as before.
    pub(super) fn guard() {
        static DONE: AtomicBool = AtomicBool::new(false);
        if !DONE.swap(true, Relaxed) {
            // SAFETY: handlers that live as long as this library: the C library forgets them with it.
            unsafe { pthread_atfork(Some(lock), Some(unlock), Some(unlock)) };
        }
    }
}
