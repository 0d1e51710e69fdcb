//! Threads of a call that asks for them: each has its own reserve and barrier, and all end before the call does.

use std::thread::{Builder, Scope, ScopedJoinHandle, scope};

use super::guard::{self, Failure};
use super::status::SIGNORINI_STATUS_INTERNAL;
use crate::shortage;

/// Runs `work(0)`, …, `work(count - 1)`, the first on the calling thread and each other one on a thread of its own, or
/// on the calling one too where the system has no more. Returns the results in order, or status codes.
pub(super) fn each<T: Send>(
    count: usize,
    work: &(dyn Fn(usize) -> Result<T, Failure> + Sync),
) -> Vec<Result<T, i32>> {
    let job = |lane: usize| move || guarded(|| work(lane));
    scope(|scope| {
        let others: Vec<_> = (1..count).map(|lane| start(scope, job(lane))).collect();
        let mut results = vec![guarded(|| work(0))];
        for (lane, thread) in (1..).zip(others) {
            results.push(match thread {
                // Waits until the thread is gone, with what it kept for itself.
                Some(thread) => thread.join().unwrap_or(Err(SIGNORINI_STATUS_INTERNAL)),
                None => guarded(|| work(lane)),
            });
        }
        results
    })
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

/// Starts a thread that gets no signals: they are the host's.
fn start<'s, T: Send + 's>(
    scope: &'s Scope<'s, '_>,
    job: impl FnOnce() -> T + Send + 's,
) -> Option<ScopedJoinHandle<'s, T>> {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    let _masked = Masked::new();
    Builder::new().spawn_scoped(scope, job).ok()
}

/// The calling thread, and those that it starts, get no signals until it is dropped.
#[cfg(any(target_os = "linux", target_os = "macos"))]
struct Masked(libc::sigset_t);

#[cfg(any(target_os = "linux", target_os = "macos"))]
impl Masked {
    fn new() -> Self {
        // SAFETY: sets of signals, filled before they are read.
        unsafe {
            let (mut all, mut before) = (std::mem::zeroed(), std::mem::zeroed());
            libc::sigfillset(&raw mut all);
            libc::pthread_sigmask(libc::SIG_SETMASK, &raw const all, &raw mut before);
            Masked(before)
        }
    }
}

#[cfg(any(target_os = "linux", target_os = "macos"))]
impl Drop for Masked {
    fn drop(&mut self) {
        // SAFETY: the set that `new` has read.
        unsafe {
            libc::pthread_sigmask(libc::SIG_SETMASK, &raw const self.0, std::ptr::null_mut());
        }
    }
}
