//! Locks that a fork waits for. The child begins with one thread, and would wait for ever for a lock that another
//! thread of its parent held.

use std::hint::spin_loop;
use std::sync::atomic::AtomicBool;
use std::sync::atomic::Ordering::{Acquire, Relaxed, Release};

/// A lock that needs no memory, for work of a few steps. A mutex of the standard library may need memory itself.
pub(super) struct ForkLock(AtomicBool);

/// The lock of the objects of Fortran 77.
pub(super) static HANDLES: ForkLock = ForkLock(AtomicBool::new(false));
/// The lock of the blocks that have served; who has it takes no other one.
pub(super) static BLOCKS: ForkLock = ForkLock(AtomicBool::new(false));

/// Opens a lock, however the work ends.
struct Held<'l>(&'l ForkLock);

impl Drop for Held<'_> {
    fn drop(&mut self) {
        self.0.unlock();
    }
}

impl ForkLock {
    /// Runs `work` alone.
    pub(super) fn alone<T>(&self, work: impl FnOnce() -> T) -> T {
        self.lock();
        let _held = Held(self);
        work()
    }

    fn lock(&self) {
        while self.0.compare_exchange_weak(false, true, Acquire, Relaxed).is_err() {
            spin_loop();
        }
    }

    fn unlock(&self) {
        self.0.store(false, Release);
    }
}

/// From now on a fork waits for the locks, and both processes have them open. Without memory for that it is as before.
pub(super) fn wait_at_forks() {
    #[cfg(unix)]
    {
        extern "C" fn lock() {
            HANDLES.lock();
            BLOCKS.lock();
        }
        extern "C" fn unlock() {
            BLOCKS.unlock();
            HANDLES.unlock();
        }
        static IS_SET: AtomicBool = AtomicBool::new(false);
        if !IS_SET.swap(true, Relaxed) {
            // SAFETY: functions that may run at any fork; the system forgets them with the library.
            unsafe { libc::pthread_atfork(Some(lock), Some(unlock), Some(unlock)) };
        }
    }
}
