//! One thread at a time uses the handles, also across a fork: a child begins with one thread, and would wait for
//! ever for a lock that another thread of its parent held.

use std::sync::{Mutex, MutexGuard, PoisonError};

static GATE: Mutex<()> = Mutex::new(());

/// The right to use the handles.
pub(super) type Pass = MutexGuard<'static, ()>;

/// Lets this thread through, alone.
pub(super) fn pass() -> Pass {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    fork::guard();
    locked()
}

fn locked() -> Pass {
    GATE.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
mod fork {
    use libc::c_int;
    use std::cell::UnsafeCell;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    use super::{Pass, locked};

    type Handler = Option<unsafe extern "C" fn()>;

    unsafe extern "C" {
        fn pthread_atfork(before: Handler, in_parent: Handler, in_child: Handler) -> c_int;
    }

    /// The lock, from before a fork to after it.
    struct Kept(UnsafeCell<Option<Pass>>);

    // SAFETY: it is used by the thread that has the lock.
    unsafe impl Sync for Kept {}

    static KEPT: Kept = Kept(UnsafeCell::new(None));

    unsafe extern "C" fn lock() {
        let pass = locked();
        // SAFETY: this thread has the lock.
        unsafe { *KEPT.0.get() = Some(pass) };
    }

    unsafe extern "C" fn unlock() {
        // SAFETY: this thread has the lock since before the fork; it is open when the cell is empty.
        let pass = unsafe { (*KEPT.0.get()).take() };
        drop(pass);
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
