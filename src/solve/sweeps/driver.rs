//! Sweeps until a target is met: over-relaxation, drift and budgets around what is [`Swept`].

use super::relaxation::Relaxation;
use super::swept::Swept;
use crate::linalg::tolerances::{NEGLIGIBLE, ROUNDING};
use crate::linalg::vector::norm_inf;
use crate::monitor::Watch;
use crate::solve::result::{Call, Ending};

/// The driver of projected SOR.
pub struct Driver<'m, 'p> {
    pub problem: Swept<'p>,
    /// The iterate, and its residual, which is carried along.
    pub x: Vec<f64>,
    pub w: Vec<f64>,
    /// Chooses the factor of the next sweep.
    pub relaxation: Relaxation,
    /// Sweeps so far, and the unknowns at the last look at their drift.
    sweeps: u64,
    looked_at: Vec<f64>,
    monitor: &'m dyn Watch,
    /// `eta` when it was last halved, and the sweeps until then.
    milestone: (f64, u64),
    /// Largest force of any iterate.
    largest_force: f64,
    /// `eta` and the unknowns of the best iterate that was measured under the problem's own law.
    best: (f64, Vec<f64>),
}

/// Largest over-relaxation factor chosen: sweeps with a larger one take more than a hundred to forget
/// an error, and the measured rate says nothing meanwhile.
pub const LARGEST_FACTOR: f64 = 1.97;

/// The first look at the drift, a power of two: most problems that have a solution are solved before, and a look costs a
/// dense factorisation. Looks are then spaced at doubling counts, so that their number stays small.
const FIRST_LOOK: u64 = 256;

/// Sweeps after which a standstill is looked for.
const ROUND: u64 = 1000;

/// Where `eta` is below [`NEGLIGIBLE`] and was not halved in so many sweeps, it is at the rounding
/// floor: sweeps that still converge halve it in some hundred.
const STAGNATION: u64 = 5000;

/// Sweeps between two measurements of `eta`, which cost a few operations per unknown each.
const MEASURE: u64 = 4;

impl<'m, 'p> Driver<'m, 'p> {
    /// Starts from `x`, which is admissible; a factor that the settings do not give is chosen below
    /// `largest_factor`.
    pub fn new(call: &Call<'m>, (problem, x): (Swept<'p>, Vec<f64>), largest_factor: f64) -> Self {
        Driver {
            sweeps: 0,
            looked_at: x.clone(),
            relaxation: Relaxation::new(call.settings.omega, largest_factor, x.len()),
            w: problem.residual(&x),
            problem,
            x,
            monitor: call.monitor,
            milestone: (f64::INFINITY, 0),
            largest_force: 0.0,
            best: (f64::INFINITY, Vec::new()),
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
                self.w = self.problem.residual(&self.x);
            }
        }
        Ok(())
    }

    /// `eta` under the problem's own law, from a fresh residual if the carried one meets `tolerance`;
    /// an error if rounding will keep it from being met.
    pub fn measure(&mut self, tolerance: f64) -> Result<f64, Ending> {
        let (eta, sweeps) = (self.note(), self.monitor.iterations());
        if eta <= tolerance {
            self.w = self.problem.residual(&self.x);
            return Ok(self.problem.eta(&self.x, &self.w));
        }
        let force = norm_inf(&self.w);
        self.largest_force = self.largest_force.max(force);
        if force < ROUNDING * self.largest_force && norm_inf(self.problem.load()) == 0.0 {
            return Err(Ending::Stalled("without loads the forces fall to rounding"));
        }
        if 2.0 * eta <= self.milestone.0 {
            self.milestone = (eta, sweeps);
        }
        if eta < NEGLIGIBLE && sweeps > self.milestone.1 + STAGNATION {
            return Err(Ending::Stalled("rounding keeps the sweeps from a better accuracy"));
        }
        Ok(eta)
    }

    /// Sweeps until their own law is met to `target`, nothing moves or `most` sweeps are done. Returns
    /// the change in the last sweep.
    pub fn relax(&mut self, target: f64, most: u64) -> Result<f64, Ending> {
        let mut change = 0.0;
        for sweep in 1..=most {
            self.monitor.step()?;
            change = self.problem.sweep(&mut self.x, &mut self.w, self.relaxation.omega);
            self.relaxation.observe(change);
            if let Some(motion) = self.recession() {
                return Err(Ending::Recession(motion));
            }
            if sweep % MEASURE == 0 || change == 0.0 {
                let eta = self.problem.eta_of_sweeps(&self.x, &self.w);
                self.monitor.measured(eta);
                if eta <= target || change == 0.0 {
                    break;
                }
            }
        }
        Ok(change)
    }

    /// Counts a sweep; if it is time for a look, a recession direction in the drift since the last one.
    fn recession(&mut self) -> Option<Vec<f64>> {
        self.sweeps += 1;
        if self.sweeps < FIRST_LOOK || !self.sweeps.is_power_of_two() {
            return None;
        }
        let parts = self.x.iter().zip(&self.looked_at);
        let drift: Vec<f64> = parts.map(|(x, before)| x - before).collect();
        self.looked_at.copy_from_slice(&self.x);
        self.problem.recession(&drift, self.monitor)
    }

    /// Measures the iterate under the problem's own law and keeps it if it is the best.
    fn note(&mut self) -> f64 {
        let eta = self.problem.eta(&self.x, &self.w);
        if eta < self.best.0 {
            self.best.0 = eta;
            self.best.1.clone_from(&self.x);
        }
        eta
    }

    /// The unknowns of the best iterate, `None` if that is the last one.
    pub fn best(&mut self) -> Option<Vec<f64>> {
        let eta = self.note();
        (eta > self.best.0).then(|| std::mem::take(&mut self.best.1))
    }
}
