//! A thread that is cancelled during a call ends after it.
//!
//! Cancellation unwinds as an exception of C++ does, which may not pass through Rust: the process would end.

use libc::c_int;

#[cfg(target_os = "linux")]
const DISABLE: c_int = 1;
#[cfg(target_os = "macos")]
const DISABLE: c_int = 0;

unsafe extern "C" {
    fn pthread_setcancelstate(state: c_int, old: *mut c_int) -> c_int;
}

/// The thread cannot be cancelled until it is dropped.
pub(super) struct Uncancelled {
    before: c_int,
}

impl Uncancelled {
    pub(super) fn new() -> Self {
        let mut before = DISABLE;
        // SAFETY: a state that the system knows, and a place for the old one.
        unsafe { pthread_setcancelstate(DISABLE, &raw mut before) };
        Uncancelled { before }
    }
}

impl Drop for Uncancelled {
    fn drop(&mut self) {
        let mut ours = DISABLE;
        // SAFETY: the state of before.
        unsafe { pthread_setcancelstate(self.before, &raw mut ours) };
    }
}
