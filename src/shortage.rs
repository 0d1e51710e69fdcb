//! Memory that the system has refused to the calling thread.
//!
//! Stable Rust ends the process where a vector cannot grow, and thousands of vectors grow with a problem, in
//! other crates too. The C interface therefore serves what the system refuses from a reserve
//! (`ffi/allocator.rs`), and notes it here. Long work asks [`check`] between two steps: the call then
//! unwinds, which releases everything, and ends as out of memory.

use std::cell::Cell;
use std::panic::resume_unwind;

thread_local! {
    static REFUSED: Cell<usize> = const { Cell::new(0) };
}

/// The reason with which a call unwinds that has no memory to go on.
pub struct Shortage {
    /// Bytes of the first request that the system refused.
    pub bytes: usize,
}

/// The system has refused so many bytes, and the reserve has served them.
#[cfg(c_library)]
pub fn note(bytes: usize) {
    // At the end of a thread there may be none to tell.
    let _ = REFUSED.try_with(|refused| {
        if refused.get() == 0 {
            refused.set(bytes);
        }
    });
}

/// Forgets what was noted: a call begins or ends.
#[cfg(c_library)]
pub fn forget() {
    REFUSED.set(0);
}

/// `true` if the reserve has served the call.
pub fn is_noted() -> bool {
    REFUSED.get() != 0
}

/// Ends the call if the reserve has served it. No panic hook is called.
pub fn check() {
    let bytes = REFUSED.get();
    if bytes != 0 {
        resume_unwind(Box::new(Shortage { bytes }));
    }
}
