//! Threads that do the parts of a work: the calling one, or several that the C interface starts.
//!
//! A thread has its workers while [`with_workers`] lasts, and long works below share their parts among these. A part does
//! the same on any thread, and what is a part does not depend on how many there are: the results of the library do not
//! depend on them. A part that shares in its turn does so alone.

use std::cell::Cell;
use std::mem::ManuallyDrop;
use std::rc::Rc;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::counters::shared;

/// A work of fewer multiplications stays on the calling thread: to wake another one takes about a tenth of their time.
const FEW: f64 = 1e6;

/// Threads that share the parts of a work.
pub trait Workers {
    /// Most parts that are done at once, at least 1.
    fn threads(&self) -> usize;

    /// Does `work(thread, part)` for each part from 0 to `parts - 1`, once each, and returns when all that began have
    /// ended. Parts that are done at once have different threads, each below [`Self::threads`]. `go_on` is asked on the
    /// calling thread between parts; once it says `false` no further part begins.
    fn run(
        &self,
        parts: usize,
        work: &(dyn Fn(usize, usize) + Sync),
        go_on: &mut dyn FnMut() -> bool,
    );
}

type Own = Option<Rc<dyn Workers>>;

thread_local! {
    /// The workers of this thread. They need no destructor, for which the system would have to have memory.
    static OWN: Cell<Option<ManuallyDrop<Rc<dyn Workers>>>> = const { Cell::new(None) };
}

fn replaced(by: Own) -> Own {
    OWN.replace(by.map(ManuallyDrop::new)).map(ManuallyDrop::into_inner)
}

/// The workers that this thread has again when it is dropped.
struct Before(Own);

impl Drop for Before {
    fn drop(&mut self) {
        replaced(self.0.take());
    }
}

/// Does `body`, in which `workers` share the works of this thread; `None`: it does them alone.
pub fn with_workers<T>(workers: Option<Rc<dyn Workers>>, body: impl FnOnce() -> T) -> T {
    let _before = Before(replaced(workers));
    body()
}

/// Most parts of a work of this thread that are done at once.
pub fn threads() -> usize {
    let own = Before(replaced(None));
    own.0.as_ref().map_or(1, |own| own.threads())
}

/// Does the parts of a work of so many multiplications, as [`Workers::run`].
pub fn share(
    parts: usize,
    multiplications: f64,
    work: &(dyn Fn(usize, usize) + Sync),
    go_on: &mut dyn FnMut() -> bool,
) {
    if multiplications >= FEW && parts > 1 {
        let own = Before(replaced(None));
        if let Some(workers) = &own.0 {
            return shared(|| workers.run(parts, work, go_on));
        }
    }
    for part in 0..parts {
        if !go_on() {
            return;
        }
        work(0, part);
    }
}

/// Does `work` with each of `items`, in a work of so many multiplications; `false` if `go_on` has ended it.
pub fn each_while<T: Send>(
    items: impl Iterator<Item = T>,
    multiplications: f64,
    work: impl Fn(T) + Sync,
    go_on: &mut dyn FnMut() -> bool,
) -> bool {
    let mut goes_on = true;
    let mut asked = || {
        goes_on = go_on();
        goes_on
    };
    if multiplications < FEW {
        items.take_while(|_| asked()).for_each(work);
        return goes_on;
    }
    let items: Vec<_> = items.map(|item| Mutex::new(Some(item))).collect();
    let work = |_: usize, part: usize| {
        if let Some(item) = locked(&items[part]).take() {
            work(item);
        }
    };
    share(items.len(), multiplications, &work, &mut asked);
    goes_on
}

/// As [`each_while`] to the end.
pub fn each<T: Send>(
    items: impl Iterator<Item = T>,
    multiplications: f64,
    work: impl Fn(T) + Sync,
) {
    each_while(items, multiplications, work, &mut || true);
}

/// Does `work` with pieces of `values`, of all arrays alike, each with the place of its first one. What a value becomes
/// must not depend on the pieces: they are chosen by the number of threads.
pub fn pieces<T: Send, const N: usize>(
    values: [&mut [T]; N],
    multiplications: f64,
    work: impl Fn(usize, [&mut [T]; N]) + Sync,
) {
    let threads = if multiplications < FEW { 1 } else { threads() };
    if threads == 1 {
        return work(0, values);
    }
    // A thread that begins late takes fewer of them.
    let count = 2 * threads;
    let length = values[0].len().div_ceil(count).max(1);
    let mut left = values.map(|values| values.chunks_mut(length));
    let pieces = (0..count).map_while(|k| {
        let piece = left.each_mut().map(|left| left.next().unwrap_or_default());
        (!piece[0].is_empty()).then_some((k, piece))
    });
    each(pieces, multiplications, |(k, piece)| work(length * k, piece));
}

/// Multiplications of matrix products that take the time of so many numbers read from memory.
pub fn reading(numbers: usize) -> f64 {
    (numbers * size_of::<f64>()) as f64
}

/// The least number of columns of so many rows that threads read together, even if half of them are left out; all, if
/// there is one thread.
pub fn columns_to_share(rows: usize) -> usize {
    if threads() == 1 { usize::MAX } else { (2.0 * FEW / reading(rows.max(1))).ceil() as usize }
}

/// The value of a mutex, also after a panic of a thread that had locked it.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
