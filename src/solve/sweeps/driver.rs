//! Sweeps until a target is met: over-relaxation, drift and budgets around an [`Iterate`].

use super::Iterate;
use super::drift::DriftDetector;
use super::relaxation::Relaxation;
use crate::linalg::tolerances::{NEGLIGIBLE, ROUNDING};
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::result::Ending;

/// The driver of projected SOR.
pub struct Driver<'m, 'c, I> {
    iterate: I,
    relaxation: Relaxation,
    drift: DriftDetector,
    monitor: &'m mut Monitor<'c>,
    /// When `eta` was last halved.
    milestone: Measured,
    /// Largest force of any iterate.
    largest_force: f64,
    /// The best iterate that was measured under the problem's own law.
    best: Best,
}

struct Measured {
    eta: f64,
    sweeps: u64,
}

struct Best {
    eta: f64,
    unknowns: Vec<f64>,
}

/// Largest over-relaxation factor chosen: sweeps with a larger one take more than a hundred to forget
/// an error, and the measured rate says nothing meanwhile.
pub const LARGEST_FACTOR: f64 = 1.97;

/// Sweeps after which a standstill is looked for.
const ROUND: u64 = 1000;

/// Where `eta` is below [`NEGLIGIBLE`] and was not halved in so many sweeps, it is at the rounding
/// floor: sweeps that still converge halve it in some hundred.
const STAGNATION: u64 = 5000;

/// Progress that moves the milestone of stagnation.
const HALF: f64 = 0.5;

/// Sweeps between two measurements of `eta`, which cost a few operations per unknown each.
const MEASURE: u64 = 4;

impl<'m, 'c, I: Iterate> Driver<'m, 'c, I> {
    /// Starts from `iterate`; a factor that the settings do not give is chosen below
    /// `largest_factor`.
    pub fn new(
        iterate: I,
        settings: &Settings,
        largest_factor: f64,
        monitor: &'m mut Monitor<'c>,
    ) -> Self {
        let unknowns = iterate.unknowns().len();
        Driver {
            drift: DriftDetector::new(iterate.unknowns()),
            iterate,
            relaxation: Relaxation::new(settings.omega, largest_factor, unknowns),
            monitor,
            milestone: Measured { eta: f64::INFINITY, sweeps: 0 },
            largest_force: 0.0,
            best: Best { eta: f64::INFINITY, unknowns: Vec::new() },
        }
    }

    /// Sweeps until the problem's own law is met to `tolerance`, or returns the reason why not.
    pub fn solve(&mut self, tolerance: f64) -> Result<(), Ending> {
        let mut stands_still = false;
        while self.measure(tolerance)? > tolerance {
            let stood_still = stands_still;
            stands_still = self.relax(tolerance, ROUND)? == 0.0;
            if stands_still {
                if stood_still {
                    return Err(Ending::Stalled("the sweeps no longer change the displacements"));
                }
                self.iterate.refresh();
            }
        }
        Ok(())
    }

    /// `eta` under the problem's own law, from a fresh residual if the carried one meets `tolerance`;
    /// an error if rounding will keep it from being met.
    pub fn measure(&mut self, tolerance: f64) -> Result<f64, Ending> {
        let (eta, sweeps) = (self.note(), self.monitor.iterations());
        if eta <= tolerance {
            self.iterate.refresh();
            return Ok(self.iterate.eta());
        }
        let force = self.iterate.largest_force();
        self.largest_force = self.largest_force.max(force);
        if force < ROUNDING * self.largest_force && self.iterate.is_unloaded() {
            return Err(Ending::Stalled("without loads the forces fall to rounding"));
        }
        if eta <= HALF * self.milestone.eta {
            self.milestone = Measured { eta, sweeps };
        }
        if eta < NEGLIGIBLE && sweeps > self.milestone.sweeps + STAGNATION {
            return Err(Ending::Stalled("rounding keeps the sweeps from a better accuracy"));
        }
        Ok(eta)
    }

    /// Sweeps until their own law is met to `target`, nothing moves or `most` sweeps are done. Returns
    /// the change in the last sweep.
    pub fn relax(&mut self, target: f64, most: u64) -> Result<f64, Ending> {
        let mut change = 0.0;
        for sweep in 1..=most {
            self.monitor.step().map_err(Ending::Stopped)?;
            change = self.iterate.sweep(self.relaxation.omega());
            self.relaxation.observe(change);
            if let Some(motion) = self.drift.observe(&self.iterate, self.monitor) {
                return Err(Ending::Recession(motion));
            }
            if sweep % MEASURE == 0 || change == 0.0 {
                let eta = self.iterate.eta_of_sweeps();
                self.monitor.measured(eta);
                if eta <= target || change == 0.0 {
                    break;
                }
            }
        }
        Ok(change)
    }

    /// Resets the measured rate: the law of the sweeps has changed.
    pub fn restart(&mut self) {
        self.relaxation.restart();
    }

    /// Measures the iterate under the problem's own law and keeps it if it is the best.
    fn note(&mut self) -> f64 {
        let eta = self.iterate.eta();
        if eta < self.best.eta {
            self.best.eta = eta;
            self.best.unknowns.clear();
            self.best.unknowns.extend_from_slice(self.iterate.unknowns());
        }
        eta
    }

    /// The unknowns of the best iterate, `None` if that is the last one.
    pub fn best(&mut self) -> Option<Vec<f64>> {
        let eta = self.note();
        (eta > self.best.eta).then(|| std::mem::take(&mut self.best.unknowns))
    }

    /// The iterate.
    pub fn iterate(&mut self) -> &mut I {
        &mut self.iterate
    }

    /// Ends the sweeps.
    pub fn into_iterate(self) -> I {
        self.iterate
    }

    /// The unknowns of the iterate.
    pub fn unknowns(&self) -> &[f64] {
        self.iterate.unknowns()
    }

    /// The factor of the next sweep.
    pub fn omega(&self) -> f64 {
        self.relaxation.omega()
    }
}
