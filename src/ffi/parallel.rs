//! Threads of a call that asks for them: each has its own reserve and barrier, and all end before the call does.

use std::sync::{Barrier, Mutex, PoisonError};

use super::guard::{self, Failure};
use super::status::SIGNORINI_STATUS_INTERNAL;
use super::thread::{Run, Thread};
use crate::shortage;

/// Runs `work(0)`, …, `work(count - 1)`, the first on the calling thread and each other one on a thread of its own, or
/// on the calling one too where the system has no more. Returns the results in order, or status codes.
pub(super) fn each<T: Send>(
    count: usize,
    work: &(dyn Fn(usize) -> Result<T, Failure> + Sync),
) -> Vec<Result<T, i32>> {
    let jobs: Vec<Job<'_, T>> = (1..count).map(|lane| Job::new(lane, work)).collect();
    // Room for all beforehand: nothing unwinds while there are threads.
    let (mut threads, mut results) = (Vec::with_capacity(count), Vec::with_capacity(count));
    for job in &jobs {
        // SAFETY: the jobs live until all threads are joined below, and nothing in between unwinds.
        let thread = unsafe { Thread::start(job) };
        if thread.is_some() {
            job.ready.wait();
        }
        threads.push(thread);
    }
    results.push(guarded(|| work(0)));
    for (job, thread) in jobs.iter().zip(threads) {
        match thread {
            // Waits until the thread is gone, with what it kept for itself.
            Some(thread) => thread.join(),
            None => job.work(),
        }
        results.push(job.result());
    }
    results
}

/// What a further thread does.
struct Job<'w, T> {
    lane: usize,
    work: &'w (dyn Fn(usize) -> Result<T, Failure> + Sync),
    /// Where the caller waits until the thread has what it keeps for itself. The C library ends the process if it has
    /// no memory to note that: nobody else asks for memory meanwhile.
    ready: Barrier,
    result: Mutex<Option<Result<T, i32>>>,
}

impl<'w, T> Job<'w, T> {
    fn new(lane: usize, work: &'w (dyn Fn(usize) -> Result<T, Failure> + Sync)) -> Self {
        Job { lane, work, ready: Barrier::new(2), result: Mutex::new(None) }
    }

    fn work(&self) {
        self.keep(guarded(|| (self.work)(self.lane)));
    }

    fn keep(&self, result: Result<T, i32>) {
        *self.result.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
    }

    fn result(&self) -> Result<T, i32> {
        let result = self.result.lock().unwrap_or_else(PoisonError::into_inner).take();
        result.unwrap_or(Err(SIGNORINI_STATUS_INTERNAL))
    }
}

impl<T: Send> Run for Job<'_, T> {
    fn run(&self) {
        let prepared = guarded(guard::prepare_thread);
        self.ready.wait();
        match prepared {
            Ok(()) => self.work(),
            Err(code) => self.keep(Err(code)),
        }
    }
}

/// What an entry does around its body.
fn guarded<T>(body: impl FnOnce() -> Result<T, Failure>) -> Result<T, i32> {
    let mut result = None;
    let code = guard::call(|| {
        result = Some(body()?);
        // Nothing that lives on may stand in the reserve of the thread.
        shortage::check();
        Ok(0)
    });
    match result {
        Some(result) if code == 0 => Ok(result),
        _ => Err(code),
    }
}
