//! Objects known by numbers. Fortran has no pointer type of its own: an address in an INTEGER*8 would be
//! followed whatever it holds, a number that is not here is refused.

use std::any::Any;
use std::cell::UnsafeCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::super::fork_lock::{HANDLES, wait_at_forks};
use super::super::guard::Outcome;
use super::super::model::SignoriniModel;
use super::super::surface_new::SignoriniSurfacePairs;
use super::arguments::{Argument, write};

/// A kind of objects.
pub(super) trait Kind: Any + Send + Sync {
    /// The sentence on a number that is not here goes on so.
    const NONE: &'static str;
}

impl Kind for SignoriniModel {
    const NONE: &'static str = "there is no such model";
}

impl Kind for SignoriniSurfacePairs {
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
/// `make` puts a boxed object where it is told, if it returns 0.
pub(super) unsafe fn create<T: Kind>(
    handle: Argument<*mut i64>,
    make: impl FnOnce(*mut *mut T) -> Outcome<i32>,
) -> Outcome<i32> {
    if handle.pointer.is_null() {
        return handle.refuse("is NULL");
    }
    // SAFETY: a place of the caller.
    unsafe { write(handle.pointer, 0) };
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
        // SAFETY: as above.
        unsafe { write(handle.pointer, number) };
    }
    Ok(status)
}

/// The object of a handle, which lives on during the call even if another thread releases it.
pub(super) fn find<T: Kind>(handle: Argument<*const i64>) -> Outcome<Arc<T>> {
    let number = handle.read()?;
    let found = with_living(|_, objects| objects.get(&number).cloned());
    let of_this_kind = found.and_then(|found| found.downcast().ok());
    of_this_kind.map_or_else(|| unknown::<T, _>(handle, number), Ok)
}

/// Releases the object of a handle, which becomes 0. A handle of 0 is allowed.
pub(super) fn free<T: Kind>(handle: Argument<*mut i64>) -> Outcome<i32> {
    let given = handle.constant();
    let number = given.read()?;
    if number != 0 {
        let released = with_living(|_, objects| {
            let is_known = objects.get(&number).is_some_and(|object| (**object).is::<T>());
            if is_known { objects.remove(&number) } else { None }
        });
        if released.is_none() {
            return unknown::<T, _>(given, number);
        }
    }
    // SAFETY: a place of the caller.
    unsafe { write(handle.pointer, 0) };
    Ok(0)
}

fn unknown<T: Kind, R>(handle: Argument<*const i64>, number: i64) -> Outcome<R> {
    handle.refuse(format!("is {number}, {}; is it INTEGER*8?", T::NONE))
}
