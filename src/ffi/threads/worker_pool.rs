//! Threads that share the parts of one work after another. They begin with the first work and end with the call.

use std::any::Any;
use std::cell::RefCell;
use std::hint::spin_loop;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::system_thread::{Job, Thread, processors};
use crate::shortage::{self, Shortage};
use crate::workers::{Workers, locked, with_workers};

/// Most threads: each has working memory, and of more than these none has enough to do.
const MOST: usize = 64;

/// Does `body` with so many threads, the calling one among them, at most one for each processor: more of them wait for
/// each other. Each further one holds `memory` bytes in reserve.
pub(in crate::ffi) fn with_threads<T>(threads: usize, memory: u64, body: impl FnOnce() -> T) -> T {
    let threads = if threads > 1 { threads.min(MOST).min(processors()) } else { 1 };
    if threads == 1 {
        return with_workers(None, body);
    }
    let board = Arc::new(Board { threads, ..Board::default() });
    let job = |number| {
        let board = Arc::clone(&board);
        Job::new(memory, Box::new(move || board.serve(number)))
    };
    let jobs: Box<[_]> = (1..threads).map(job).collect();
    let started = RefCell::new(Vec::with_capacity(jobs.len()));
    with_workers(Some(Rc::new(WorkerPool { board, jobs, started })), body)
}

/// So long a thread looks for what it waits for before it sleeps: to wake it takes about as long, and many works follow
/// each other at once.
const LOOKING: Duration = Duration::from_micros(50);

/// Looks for a condition for a while.
fn look_for(condition: impl Fn() -> bool) {
    let begin = Instant::now();
    while !condition() && begin.elapsed() < LOOKING {
        spin_loop();
    }
}

/// A work whose parts are done.
type Work = dyn Fn(usize, usize) + Sync;

/// A work, as threads see it while they share it.
#[derive(Clone, Copy)]
struct Posted {
    work: *const Work,
    parts: usize,
}

// SAFETY: several threads may use the work behind the pointer, and it lives until all of them have said that they are
// done with it.
unsafe impl Send for Posted {}

/// Messages of the calling thread to the others, and of these to it.
#[derive(Default)]
struct Board {
    threads: usize,
    notes: Mutex<Notes>,
    /// There is another work, or none any more.
    posted: Condvar,
    /// The last thread is done with its work.
    ended: Condvar,
    /// The next part.
    next: AtomicUsize,
    /// Works so far. It changes under the lock of the notes, and so does the next one; who looks for changes needs no lock.
    count: AtomicU64,
    /// Threads that have not ended this work.
    busy: AtomicUsize,
}

/// [`Board::count`] behind the last work, of which it is the number of none.
const OVER: u64 = u64::MAX;

#[derive(Default)]
struct Notes {
    /// `None` behind the end of each work, which the threads of this pool have all ended.
    work: Option<Posted>,
    /// Threads that wait for the next work or are at this one.
    present: usize,
    /// Threads that sleep until there is another work, and if the calling one does until this one has ended.
    asleep: usize,
    is_awaited: bool,
    /// Why a thread has ended its part otherwise than by doing it.
    failure: Option<Box<dyn Any + Send>>,
}

impl Board {
    /// Does parts of each work that is posted, until there is none any more.
    fn serve(&self, thread: usize) {
        let mut seen = 0;
        loop {
            look_for(|| self.count.load(Ordering::Relaxed) != seen);
            let mut notes = locked(&self.notes);
            notes.asleep += 1;
            let waits = |now: &mut Notes| {
                let count = self.count.load(Ordering::Relaxed);
                // A thread that begins late has seen none of the works before, which have ended.
                count != OVER && (count == seen || now.work.is_none())
            };
            let mut notes =
                self.posted.wait_while(notes, waits).unwrap_or_else(PoisonError::into_inner);
            notes.asleep -= 1;
            let Some(Posted { work, parts }) = notes.work else { return };
            seen = self.count.load(Ordering::Relaxed);
            drop(notes);
            // SAFETY: the calling thread keeps the work until this one has said below that it is done.
            let work = unsafe { &*work };
            let result = catch_unwind(AssertUnwindSafe(|| {
                self.share(parts, &|part| work(thread, part), &mut || true);
                shortage::check();
            }));
            let mut notes = locked(&self.notes);
            if let Err(reason) = result {
                self.next.store(parts, Ordering::Relaxed);
                notes.failure = Some(reason);
            }
            let wakes = self.busy.fetch_sub(1, Ordering::Relaxed) == 1 && notes.is_awaited;
            drop(notes);
            if wakes {
                self.ended.notify_one();
            }
        }
    }

    /// There is no work any more: who looks for the next one, or sleeps, finds it out.
    fn end(&self) {
        let notes = locked(&self.notes);
        self.count.store(OVER, Ordering::Relaxed);
        drop(notes);
        self.posted.notify_all();
    }

    /// Does parts that nobody has begun.
    fn share(&self, parts: usize, work: &dyn Fn(usize), go_on: &mut dyn FnMut() -> bool) {
        while go_on() {
            let part = self.next.fetch_add(1, Ordering::Relaxed);
            if part >= parts {
                return;
            }
            work(part);
        }
        self.next.store(parts, Ordering::Relaxed);
    }
}

/// The calling thread and the others.
struct WorkerPool {
    board: Arc<Board>,
    jobs: Box<[Job]>,
    started: RefCell<Vec<Thread>>,
}

impl WorkerPool {
    fn start(&self) {
        let mut started = self.started.borrow_mut();
        if !started.is_empty() {
            return;
        }
        for job in &self.jobs {
            // SAFETY: the pool owns the job, and joins the thread when it is dropped.
            let Some(thread) = (unsafe { Thread::start(job) }) else { return };
            started.push(thread);
            locked(&self.board.notes).present += usize::from(job.is_prepared());
        }
    }
}

impl Workers for WorkerPool {
    fn threads(&self) -> usize {
        self.board.threads
    }

    fn run(
        &self,
        parts: usize,
        work: &(dyn Fn(usize, usize) + Sync),
        go_on: &mut dyn FnMut() -> bool,
    ) {
        self.start();
        let board = &*self.board;
        // SAFETY: only the lifetime changes; no thread uses the work when this function ends, however it does.
        let lasting = unsafe {
            std::mem::transmute::<*const (dyn Fn(usize, usize) + Sync + '_), *const Work>(work)
        };
        let mut notes = locked(&board.notes);
        board.next.store(0, Ordering::Relaxed);
        notes.work = Some(Posted { work: lasting, parts });
        board.busy.store(notes.present, Ordering::Relaxed);
        board.count.fetch_add(1, Ordering::Relaxed);
        let wakes = notes.asleep > 0;
        drop(notes);
        if wakes {
            board.posted.notify_all();
        }
        let own =
            catch_unwind(AssertUnwindSafe(|| board.share(parts, &|part| work(0, part), go_on)));
        board.next.store(parts, Ordering::Relaxed);
        look_for(|| board.busy.load(Ordering::Relaxed) == 0);
        let mut notes = locked(&board.notes);
        notes.is_awaited = true;
        let waits = |_: &mut Notes| board.busy.load(Ordering::Relaxed) > 0;
        let mut notes =
            board.ended.wait_while(notes, waits).unwrap_or_else(PoisonError::into_inner);
        notes.is_awaited = false;
        notes.work = None;
        let failure = notes.failure.take();
        drop(notes);
        if let Err(reason) = own {
            resume_unwind(reason);
        }
        match failure {
            Some(reason) if reason.is::<Shortage>() => resume_unwind(reason),
            Some(_) => panic!("a further thread of the call has failed"),
            None => {}
        }
    }
}

impl Drop for WorkerPool {
    fn drop(&mut self) {
        self.board.end();
        for thread in self.started.get_mut().drain(..) {
            thread.join();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;

    use super::*;
    use crate::ffi::guard;
    use crate::ffi::status::SIGNORINI_STATUS_INTERNAL;
    use crate::workers::{share, threads};

    /// A thread that the system has refused for the first work, and grants for the second one, waits for that.
    #[test]
    fn a_thread_that_begins_late_waits_for_the_next_work() {
        let board = Board::default();
        board.count.store(1, Ordering::Relaxed);
        std::thread::scope(|scope| {
            let late = scope.spawn(|| board.serve(1));
            std::thread::sleep(100 * LOOKING);
            let is_gone = late.is_finished();
            board.end();
            assert!(!is_gone);
        });
    }

    /// A panic of the last thread, beside others that are at parts of their own, ends the call as one of the calling thread
    /// does: the works of the next call have all of their parts done.
    #[test]
    fn a_panic_on_a_further_thread_ends_the_call_alone() {
        let call = |fails: bool| {
            guard::call(|| {
                with_threads(4, 0, || {
                    let (last, done) = (threads() - 1, AtomicUsize::new(0));
                    let meeting = Barrier::new(last + 1);
                    for _ in 0..3 {
                        let part = |thread: usize, _: usize| {
                            // Each thread comes here once, as none goes on alone.
                            meeting.wait();
                            assert!(thread < last || !fails, "a part fails");
                            done.fetch_add(1, Ordering::Relaxed);
                        };
                        share(last + 1, f64::INFINITY, &part, &mut || true);
                    }
                    assert_eq!(done.into_inner(), 3 * (last + 1));
                    Ok(0)
                })
            })
        };
        for _ in 0..20 {
            assert_eq!(call(true), SIGNORINI_STATUS_INTERNAL);
            assert_eq!(call(false), 0);
        }
    }
}
