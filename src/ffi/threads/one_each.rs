//! A thread for each part of a work.

use std::sync::{Mutex, PoisonError};

use super::system_thread::{Job, Run, Thread, guarded};
use crate::ffi::guard::Failure;
use crate::ffi::status::SIGNORINI_STATUS_INTERNAL;

/// Runs `work(0)`, …, `work(count - 1)`, the first on the calling thread and each other one on a thread of its own, or
/// on the calling one too where the system has no more. Returns the results in order, or status codes.
pub(in crate::ffi) fn on_each<T: Send>(
    count: usize,
    work: &(dyn Fn(usize) -> Result<T, Failure> + Sync),
) -> Vec<Result<T, i32>> {
    let jobs: Vec<_> = (1..count).map(|k| Job::new(Part::new(k, work))).collect();
    // Room for all beforehand: nothing unwinds while there are threads.
    let (mut threads, mut results) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for job in &jobs {
        // SAFETY: the jobs live until all threads are joined below, and nothing in between unwinds.
        threads.push(unsafe { Thread::start(job) });
    }
    results.push(guarded(|| work(0)));
    for (job, thread) in jobs.iter().zip(threads) {
        match thread {
            // Waits until the thread is gone, with what it kept for itself.
            Some(thread) => thread.join(),
            None => job.work.run(Ok(())),
        }
        results.push(job.work.result());
    }
    results
}

/// One part, and its result.
struct Part<'w, T> {
    number: usize,
    work: &'w (dyn Fn(usize) -> Result<T, Failure> + Sync),
    result: Mutex<Option<Result<T, i32>>>,
}

impl<'w, T> Part<'w, T> {
    fn new(number: usize, work: &'w (dyn Fn(usize) -> Result<T, Failure> + Sync)) -> Self {
        Part { number, work, result: Mutex::new(None) }
    }

    fn result(&self) -> Result<T, i32> {
        let result = self.result.lock().unwrap_or_else(PoisonError::into_inner).take();
        result.unwrap_or(Err(SIGNORINI_STATUS_INTERNAL))
    }
}

impl<T: Send> Run for Part<'_, T> {
    fn run(&self, prepared: Result<(), i32>) {
        let result = prepared.and_then(|()| guarded(|| (self.work)(self.number)));
        *self.result.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
    }
}
