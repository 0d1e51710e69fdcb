//! Counters for `cargo bench --features counters --bench mechanisms`: how often each attempt, fallback and special
//! case is asked, and how often it decides. Without the feature [`count`] does nothing and there is nothing else.

#[cfg(feature = "counters")]
pub use counting::take;

/// Counts that number `number` of the mechanisms `name` was asked, and whether it decided.
#[cfg(not(feature = "counters"))]
#[inline(always)]
pub(crate) fn count(_name: &'static str, _number: usize, _decided: bool) {}
#[cfg(feature = "counters")]
pub(crate) use counting::count;

#[cfg(feature = "counters")]
mod counting {
    use std::cell::RefCell;
    use std::collections::BTreeMap;

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
}
