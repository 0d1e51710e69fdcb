//! The host's callback and clock while surfaces are paired.

use std::time::{Duration, Instant};

use crate::error::Error;
use crate::monitor::Monitor;

/// They are asked this often.
const PAUSE: Duration = Duration::from_millis(10);

/// How far a pairing is.
pub(super) struct PairingProgress<'a, 'm> {
    monitor: &'a mut Monitor<'m>,
    asked: Option<Instant>,
    done: usize,
    steps: usize,
}

impl<'a, 'm> PairingProgress<'a, 'm> {
    pub(super) fn new(monitor: &'a mut Monitor<'m>) -> PairingProgress<'a, 'm> {
        PairingProgress { monitor, asked: None, done: 0, steps: 1 }
    }

    /// So many steps are to come.
    pub(super) fn expects(&mut self, steps: usize) {
        self.steps += steps;
    }

    /// One step is done.
    ///
    /// # Errors
    /// As [`Self::goes_on`].
    pub(super) fn step(&mut self) -> Result<(), Error> {
        self.done += 1;
        self.goes_on()
    }

    /// To be called often.
    ///
    /// # Errors
    /// [`Error::Stopped`]: the time limit is used up, or the callback cancels.
    pub(super) fn goes_on(&mut self) -> Result<(), Error> {
        if self.asked.is_some_and(|asked| asked.elapsed() < PAUSE) {
            return Ok(());
        }
        self.asked = Some(Instant::now());
        self.monitor.shared().pairing(self.done as f64 / self.steps as f64)
    }
}
