//! Sweeps until a target is met: over-relaxation, drift and budgets around `sor`.

use super::Ending;
use super::escape::EscapeWatch;
use super::relaxation::Relaxation;
use super::sor::Iterate;
use crate::linalg::small::largest;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Projected SOR on one problem, under its own law or under given thresholds.
pub struct Sweeps<'p, 'm, 'c> {
    problem: &'p ContactProblem<'p>,
    iterate: Iterate,
    relaxation: Relaxation,
    escape: EscapeWatch,
    monitor: &'m mut Monitor<'c>,
    /// Accuracy when it was last halved, and the sweep count then.
    halved: (f64, u64),
    /// Largest force of any iterate.
    largest_force: f64,
    /// The best iterate that was measured under the problem's own law, with its `eta`.
    best: (f64, Vec<f64>),
}

/// Largest over-relaxation factor chosen.
pub const LARGEST_FACTOR: f64 = 1.97;

/// Sweeps after which it is looked whether the iteration stagnates.
const ROUND: u64 = 1000;

/// An accuracy better than this may be as good as rounding allows: it is, if it was not halved in
/// so many sweeps.
const AT_ROUNDING: f64 = 1e-11;
const STAGNATION: u64 = 5000;

/// Forces this small beside earlier ones, without load, only fade on.
const DEAD: f64 = 1e-14;

/// Sweeps between two measurements of `eta`, which cost a few operations per unknown each.
const MEASURE: u64 = 4;

impl<'p, 'm, 'c> Sweeps<'p, 'm, 'c> {
    /// Starts from `start`; a factor that is not given is chosen below `largest_factor`.
    pub fn new(
        problem: &'p ContactProblem<'p>,
        settings: &Settings,
        start: Vec<f64>,
        largest_factor: f64,
        monitor: &'m mut Monitor<'c>,
    ) -> Self {
        let iterate = Iterate::new(problem, start);
        Sweeps {
            problem,
            escape: EscapeWatch::new(&iterate.d),
            iterate,
            relaxation: Relaxation::new(settings.omega, largest_factor, problem.unknowns()),
            monitor,
            halved: (f64::INFINITY, 0),
            largest_force: 0.0,
            best: (f64::INFINITY, Vec::new()),
        }
    }

    /// Sweeps under the problem's own law until it is met to `tolerance`, or tells why not.
    pub fn solve(&mut self, tolerance: f64) -> Result<(), Ending> {
        let mut stands_still = false;
        while self.measure(tolerance)? > tolerance {
            let stood_still = stands_still;
            stands_still = self.relax(self.problem, tolerance, ROUND)? == 0.0;
            if stands_still {
                if stood_still {
                    return Err(Ending::Stalled("the sweeps change nothing any more"));
                }
                self.iterate.refresh(self.problem);
            }
        }
        Ok(())
    }

    /// `eta` under the problem's own law, from a fresh force if the carried one meets `tolerance`; an
    /// error if rounding will keep it from being met.
    pub fn measure(&mut self, tolerance: f64) -> Result<f64, Ending> {
        let (eta, sweeps) = (self.note(), self.monitor.iterations());
        if eta <= tolerance {
            self.iterate.refresh(self.problem);
            return Ok(self.iterate.eta(self.problem));
        }
        let force = largest(&self.iterate.force);
        self.largest_force = self.largest_force.max(force);
        if force < DEAD * self.largest_force && largest(self.problem.load()) == 0.0 {
            return Err(Ending::Stalled("without load the forces die out"));
        }
        if eta <= 0.5 * self.halved.0 {
            self.halved = (eta, sweeps);
        }
        if eta < AT_ROUNDING && sweeps > self.halved.1 + STAGNATION {
            return Err(Ending::Stalled("rounding keeps the sweeps from a better accuracy"));
        }
        Ok(eta)
    }

    /// Sweeps under `law` until `eta <= target`, nothing moves or `most` sweeps are done. Returns
    /// the change in the last sweep.
    pub fn relax(
        &mut self,
        law: &ContactProblem<'_>,
        target: f64,
        most: u64,
    ) -> Result<f64, Ending> {
        let mut change = 0.0;
        for sweep in 1..=most {
            self.monitor.step().map_err(Ending::Interrupted)?;
            change = self.iterate.sweep(law, self.relaxation.omega());
            self.relaxation.observe(change);
            if let Some(motion) = self.escape.observe(self.problem, &self.iterate.d) {
                return Err(Ending::Escape(motion));
            }
            if sweep % MEASURE == 0 || change == 0.0 {
                let eta = self.iterate.eta(law);
                self.monitor.measured(eta);
                if eta <= target || change == 0.0 {
                    break;
                }
            }
        }
        Ok(change)
    }

    /// Tells that another law follows: its rate is measured anew.
    pub fn restart(&mut self) {
        self.relaxation.restart();
    }

    /// Thresholds of the problem's law at the pressures of the iterate.
    pub fn thresholds(&self) -> Vec<f64> {
        let forces = self.iterate.force.chunks_exact(self.problem.dim());
        forces
            .enumerate()
            .map(|(pair, force)| self.problem.threshold(pair, (-force[0]).max(0.0)))
            .collect()
    }

    /// Measures the iterate under the problem's own law and keeps it if it is the best.
    fn note(&mut self) -> f64 {
        let eta = self.iterate.eta(self.problem);
        if eta < self.best.0 {
            self.best.0 = eta;
            self.best.1.clone_from(&self.iterate.d);
        }
        eta
    }

    /// The best iterate.
    pub fn best(mut self) -> Vec<f64> {
        match self.note() {
            eta if eta > self.best.0 => self.best.1,
            _ => self.iterate.d,
        }
    }

    /// The iterate.
    pub fn d(&self) -> &[f64] {
        &self.iterate.d
    }

    /// The factor of the next sweep.
    pub fn omega(&self) -> f64 {
        self.relaxation.omega()
    }
}
