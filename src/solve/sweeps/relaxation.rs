//! The over-relaxation factor, given or chosen from the measured rate.
//!
//! While a factor below the best is used, the changes of successive sweeps fall in a steady ratio
//! `r`, from which Young's relation `r + omega - 1 = omega s sqrt(r)` gives the Jacobi rate `s` and
//! with it the best factor `2 / (1 + sqrt(1 - s²))`; above the best one the ratio is about
//! `omega - 1` whatever the problem. So the factor is raised as long as the ratio says so. If the
//! changes stop falling, which under Coulomb's law a large factor can cause, it is lowered for good.

/// Chooses the factor while sweeps go on.
#[derive(Clone, Debug)]
pub struct Relaxation {
    /// The factor to use in the next sweep.
    pub omega: f64,
    adaptive: bool,
    largest: f64,
    changes: Vec<f64>,
    least_change: f64,
    since_least: usize,
    patience: usize,
}

/// Sweeps without a new least change after which the factor is too large, and more of them for
/// each unknown: contact zones grow by a few unknowns per sweep, and changes grow with them.
const PATIENCE: usize = 80;
const PATIENCE_PER_UNKNOWN: f64 = 0.4;

/// The part of `omega - 1` that stays after the factor was found too large.
const REDUCTION: f64 = 0.6;

/// The exponent on `omega - 1` above which a measured rate counts as that of a factor below the best:
/// at the best factor the rate is `omega - 1` itself, and the measured one differs from it by some per
/// cent.
const BELOW_BEST: f64 = 0.8;

/// Sweeps in a window of the measured rate, besides those that an error takes to settle.
const WINDOW: usize = 4;

impl Relaxation {
    /// `omega` as given, or chosen between 1 and `largest` if it is 0, for so many unknowns.
    pub fn new(omega: f64, largest: f64, unknowns: usize) -> Self {
        let adaptive = omega == 0.0;
        Relaxation {
            omega: if adaptive { 1.0 } else { omega },
            adaptive,
            largest,
            changes: Vec::new(),
            least_change: f64::INFINITY,
            since_least: 0,
            patience: PATIENCE + (PATIENCE_PER_UNKNOWN * unknowns as f64) as usize,
        }
    }

    /// Resets the history: the problem has changed.
    pub fn restart(&mut self) {
        self.changes.clear();
        self.least_change = f64::INFINITY;
        self.since_least = 0;
    }

    /// Takes the size of the last sweep's change, in the norm of the diagonal of `K`.
    pub fn observe(&mut self, change: f64) {
        if !self.adaptive {
            return;
        }
        self.since_least += 1;
        if change < self.least_change {
            self.least_change = change;
            self.since_least = 0;
        }
        if self.since_least >= self.patience && self.omega > 1.0 {
            self.omega = 1.0 + REDUCTION * (self.omega - 1.0);
            self.largest = self.omega;
            self.restart();
            return;
        }
        self.changes.push(change);
        if let Some(rate) = self.steady_rate()
            && rate > (self.omega - 1.0).powf(BELOW_BEST)
        {
            let jacobi = (rate + self.omega - 1.0) / (self.omega * rate.sqrt());
            let best = 2.0 / (1.0 + (1.0 - jacobi.min(1.0).powi(2)).sqrt());
            let raised = best.min(self.largest);
            if raised > self.omega {
                self.omega = raised;
                self.restart();
            }
        }
    }

    /// Mean ratio of the changes over the last window, if that of the window before agrees.
    fn steady_rate(&self) -> Option<f64> {
        // An error at the best factor takes about 1 / (2 - omega) sweeps to settle.
        let window = WINDOW + (2.0 / (2.0 - self.omega)) as usize;
        let last = self.changes.len().checked_sub(1)?;
        let rate = |end: usize, begin: usize| {
            (self.changes[end] / self.changes[begin]).powf(1.0 / window as f64)
        };
        let before = rate(last - window.min(last), last.checked_sub(2 * window)?);
        let now = rate(last, last - window);
        // Two windows agree if the distances of their rates from 1 differ by a factor of two at most.
        let agree = (0.5..2.0).contains(&((1.0 - before) / (1.0 - now)));
        (agree && now < 1.0).then_some(now)
    }
}
