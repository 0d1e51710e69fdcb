//! The end of a handle.

use super::guard;
use super::status::keeping_sentence;

/// Releases a handle; NULL is allowed. The sentence of the call before stays, so that a host may
/// release first and ask then.
///
/// # Safety NULL or a handle that this library has made by `Box::into_raw`, once.
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
