//! The beginning and the end of a handle.

use super::args::At;
use super::guard::{self, Outcome};
use super::status::keeping_sentence;
use crate::shortage;

/// The caller's place for a new handle; NULL until there is one.
pub(super) struct OutPointer<T>(*mut *mut T);

impl At<'_> {
    /// The place for a new handle, which holds NULL from now on.
    pub(super) fn out_pointer<T>(self, place: *mut *mut T) -> Outcome<OutPointer<T>> {
        if place.is_null() || !place.is_aligned() {
            return self.refuse("is NULL or not aligned");
        }
        // SAFETY: not NULL and aligned; the caller's place, by the contract of the call.
        unsafe { place.write(std::ptr::null_mut()) };
        Ok(OutPointer(place))
    }
}

impl<T> OutPointer<T> {
    /// Hands over a new object.
    pub(super) fn fill(self, object: impl Into<T>) -> Outcome<i32> {
        let handle = Box::new(object.into());
        // The reserve of a call holds nothing that outlives it.
        shortage::check();
        // SAFETY: the caller's place.
        unsafe { self.0.write(Box::into_raw(handle)) };
        Ok(0)
    }
}

/// Releases a handle; NULL is allowed. The sentence of the call before stays, so that a host may
/// release first and ask then.
///
/// # Safety
/// NULL or a handle that this library has made by `Box::into_raw`, once.
pub(super) unsafe fn release<T>(handle: *mut T) {
    keeping_sentence(|| {
        guard::call(|| {
            if !handle.is_null() {
                // SAFETY: by the caller's contract.
                drop(unsafe { Box::from_raw(handle) });
            }
            Ok(0)
        });
    });
}
