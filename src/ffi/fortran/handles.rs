//! Objects known by numbers. Fortran has no pointer type of its own: an address in an INTEGER*8 would be
//! followed whatever it holds, a number that is not here is refused.

use std::any::Any;
use std::cell::UnsafeCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::fork_lock::{HANDLES, wait_at_forks};
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

/// The upper half of a number is not 0, so that one cut to an INTEGER*4 is never one.
const BEFORE_THE_FIRST: i64 = i64::from_be_bytes(*b"\0\0SG\0\0\0\0");

/// The objects that live, by their numbers.
type Objects = BTreeMap<i64, Arc<dyn Any + Send + Sync>>;

/// The last number, which is not used twice, and the objects.
struct Living(UnsafeCell<(i64, Objects)>);

// SAFETY: the objects may be shared, and the map is used under its lock alone.
unsafe impl Sync for Living {}

static LIVING: Living = Living(UnsafeCell::new((BEFORE_THE_FIRST, BTreeMap::new())));

/// Works on the last number and the objects, on this thread alone.
fn with_living<T>(work: impl FnOnce(&mut i64, &mut Objects) -> T) -> T {
    wait_at_forks();
    HANDLES.alone(|| {
        // SAFETY: this thread has the lock.
        let (last, objects) = unsafe { &mut *LIVING.0.get() };
        work(last, objects)
    })
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
        let number = with_living(|last, objects| {
            *last += 1;
            objects.insert(*last, object);
            *last
        });
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
    let found = with_living(|_, objects| objects.get(&number).cloned());
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
        let released = with_living(|_, objects| objects.remove(&number));
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
