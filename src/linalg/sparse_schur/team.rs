//! Threads that share a factorisation, and whether it goes on.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use super::failure::Failure;
use super::watch::{Watch, answered};
use crate::workers::{Alone, Workers};

/// Nothing is asked before so many multiplications more are done: some milliseconds.
const BETWEEN: f64 = 3e8;

/// Fewer multiplications than these are not worth the waking of a thread, which takes about a tenth of their time.
const FEW: f64 = 1e7;

/// Multiplications that are done, by all threads.
#[derive(Default)]
pub struct Done(AtomicU64);

impl Done {
    /// So many more.
    pub fn add(&self, operations: usize) {
        self.0.fetch_add(operations as u64, Ordering::Relaxed);
    }
}

/// Who works, and who is asked whether to go on.
pub struct Team<'w> {
    workers: &'w dyn Workers,
    watch: &'w mut dyn Watch,
    done: &'w Done,
    all: f64,
    asked: f64,
}

impl<'w> Team<'w> {
    /// For `all` multiplications, counted in `done`.
    pub fn new(
        workers: &'w dyn Workers,
        watch: &'w mut dyn Watch,
        done: &'w Done,
        all: f64,
    ) -> Self {
        Team { workers, watch, done, all: all.max(1.0), asked: 0.0 }
    }

    /// Does the parts of a work of so many `operations`, on one thread if they are few.
    ///
    /// # Errors
    /// It was ended; parts may be missing.
    pub fn share(
        &mut self,
        parts: usize,
        operations: f64,
        work: &(dyn Fn(usize, usize) + Sync),
    ) -> Result<(), Failure> {
        let workers = if operations < FEW { &Alone } else { self.workers };
        let mut answer = Ok(());
        workers.run(parts, work, &mut || {
            answer = self.ask();
            answer.is_ok()
        });
        answer
    }

    /// Asks now and then.
    fn ask(&mut self) -> Result<(), Failure> {
        let done = self.done.0.load(Ordering::Relaxed) as f64;
        if done - self.asked < BETWEEN {
            return Ok(());
        }
        self.asked = done;
        answered(self.watch.step((done / self.all).min(1.0)))
    }
}

/// What a mutex holds that threads only lock while nobody else wants it.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
