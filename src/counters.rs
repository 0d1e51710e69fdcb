//! Counters for `cargo bench --features counters`: how often each attempt, fallback and special case is asked, and how
//! often it decides (`mechanisms`); how long threads share works (`solve_threads`). Without the feature there is no count.

#[cfg(feature = "counters")]
pub use counting::{take, take_shared};

/// Counts that number `number` of the mechanisms `name` was asked, and whether it decided.
#[cfg(not(feature = "counters"))]
#[inline(always)]
pub(crate) fn count(_name: &'static str, _number: usize, _decided: bool) {}

/// Does a work whose parts threads share, and counts the time that it takes.
#[cfg(not(feature = "counters"))]
#[inline(always)]
pub(crate) fn shared(work: impl FnOnce()) {
    work();
}
#[cfg(feature = "counters")]
pub(crate) use counting::{count, shared};

#[cfg(feature = "counters")]
mod counting {
    use std::cell::RefCell;
    use std::collections::BTreeMap;
    use std::sync::atomic::{AtomicU64, Ordering};
    use std::time::{Duration, Instant};

    thread_local! {
        static COUNTS: RefCell<BTreeMap<(&'static str, usize), [u64; 2]>> = RefCell::default();
    }

    pub(crate) fn count(name: &'static str, number: usize, decided: bool) {
        COUNTS.with_borrow_mut(|counts| {
            let [asked, decisive] = counts.entry((name, number)).or_default();
            *asked += 1;
            *decisive += u64::from(decided);
        });
    }

    /// The counts of this thread since the last call, by name and number: how often asked, how often decisive.
    pub fn take() -> BTreeMap<(&'static str, usize), [u64; 2]> {
        COUNTS.take()
    }

    /// Nanoseconds of shared works.
    static SHARED: AtomicU64 = AtomicU64::new(0);

    pub(crate) fn shared(work: impl FnOnce()) {
        let begin = Instant::now();
        work();
        SHARED.fetch_add(begin.elapsed().as_nanos() as u64, Ordering::Relaxed);
    }

    /// The time since the last call that works took whose parts threads shared.
    pub fn take_shared() -> Duration {
        Duration::from_nanos(SHARED.swap(0, Ordering::Relaxed))
    }
}
