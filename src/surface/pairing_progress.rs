//! The host's callback and clock while surfaces are paired.

use std::cell::Cell;
use std::time::{Duration, Instant};

use crate::error::Error;
use crate::monitor::{Monitor, Watch};

/// They are asked this often.
const PAUSE: Duration = Duration::from_millis(10);

/// How far a pairing is.
pub(super) struct PairingProgress<'m> {
    monitor: &'m dyn Watch,
    asked: Cell<Option<Instant>>,
    /// Grows by an eighth of its range in each call: the clock, which costs as much as a small face, is read where it is 0 again.
    calls: Cell<u8>,
    done: Cell<usize>,
    steps: Cell<usize>,
}

impl<'m> PairingProgress<'m> {
    pub(super) fn new(monitor: &'m Monitor<'_>) -> PairingProgress<'m> {
        let (asked, calls) = (Cell::default(), Cell::default());
        let (done, steps) = (Cell::default(), Cell::new(1));
        PairingProgress { monitor: monitor.shared(), asked, calls, done, steps }
    }

    /// So many steps are to come.
    pub(super) fn expects(&self, steps: usize) {
        self.steps.update(|all| all + steps);
    }

    /// One step is done.
    ///
    /// # Errors
    /// As [`Self::goes_on`].
    pub(super) fn step(&self) -> Result<(), Error> {
        self.done.update(|done| done + 1);
        self.goes_on()
    }

    /// To be called often.
    ///
    /// # Errors
    /// [`Error::Stopped`]: the time limit is used up, or the callback cancels.
    pub(super) fn goes_on(&self) -> Result<(), Error> {
        let calls = self.calls.replace(self.calls.get().wrapping_add(u8::MAX / 8 + 1));
        if calls > 0 || self.asked.get().is_some_and(|asked| asked.elapsed() < PAUSE) {
            return Ok(());
        }
        self.asked.set(Some(Instant::now()));
        self.monitor.pairing(self.done.get() as f64 / self.steps.get() as f64)
    }
}
