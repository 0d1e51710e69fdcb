//! The models that live, by number, also across a fork: a child begins with one thread, and would wait for ever
//! for a lock that another thread of its parent held.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::super::model_new::SignoriniModel;

/// The models that live. Fortran has no pointer type of its own: an address in an INTEGER*8 would
/// be followed whatever it holds, a number that is not here is refused.
pub(super) struct Models {
    next: i64,
    living: BTreeMap<i64, Arc<SignoriniModel>>,
}

/// The upper half of a handle is "SG" in ASCII, the lower half counts from 1: neither is 0, so that a
/// handle cut to an INTEGER*4 is never one.
const FIRST: i64 = (0x5347 << 32) + 1;

static MODELS: Mutex<Models> = Mutex::new(Models { next: FIRST, living: BTreeMap::new() });

/// The models, for this thread alone.
pub(super) fn models() -> MutexGuard<'static, Models> {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    fork::guard();
    locked()
}

fn locked() -> MutexGuard<'static, Models> {
    // The map is whole whenever a panic can happen.
    MODELS.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Models {
    /// Keeps a model, and tells its number, which no other model has before or after it.
    pub(super) fn add(&mut self, model: Arc<SignoriniModel>) -> i64 {
        let number = self.next;
        self.next += 1;
        self.living.insert(number, model);
        number
    }

    /// The model of this number.
    pub(super) fn find(&self, number: i64) -> Option<Arc<SignoriniModel>> {
        self.living.get(&number).cloned()
    }

    /// Gives up the model of this number, which lives on in calls that have found it.
    pub(super) fn remove(&mut self, number: i64) -> Option<Arc<SignoriniModel>> {
        self.living.remove(&number)
    }
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
mod fork {
    use libc::c_int;
    use std::cell::UnsafeCell;
    use std::sync::MutexGuard;
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    use super::{Models, locked};

    type Handler = Option<unsafe extern "C" fn()>;

    unsafe extern "C" {
        fn pthread_atfork(before: Handler, in_parent: Handler, in_child: Handler) -> c_int;
    }

    /// The lock, from before a fork to after it.
    struct Kept(UnsafeCell<Option<MutexGuard<'static, Models>>>);

    // SAFETY: it is used by the thread that has the lock.
    unsafe impl Sync for Kept {}

    static KEPT: Kept = Kept(UnsafeCell::new(None));

    unsafe extern "C" fn lock() {
        let guard = locked();
        // SAFETY: this thread has the lock.
        unsafe { *KEPT.0.get() = Some(guard) };
    }

    unsafe extern "C" fn unlock() {
        // SAFETY: this thread has the lock since before the fork; it is open when the cell is empty.
        let guard = unsafe { (*KEPT.0.get()).take() };
        drop(guard);
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
