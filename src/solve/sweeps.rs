//! Sweeps until a target is met: over-relaxation, drift and budgets around `sor`.

use super::Ending;
use super::escape::EscapeWatch;
use super::relaxation::Relaxation;
use super::sor::Iterate;
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
}

/// Largest over-relaxation factor chosen.
pub const LARGEST_FACTOR: f64 = 1.97;

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
        }
    }

    /// Sweeps under the problem's own law until it is met to `tolerance`, or tells why not.
    pub fn solve(&mut self, tolerance: f64) -> Ending {
        let mut stands_still = false;
        while !self.is_solved(tolerance) {
            let stood_still = stands_still;
            match self.relax(self.problem, tolerance, u64::MAX) {
                Ok(change) => stands_still = change == 0.0,
                Err(ending) => return ending,
            }
            if stands_still {
                if stood_still {
                    return Ending::Stalled("the sweeps change nothing any more");
                }
                self.iterate.refresh(self.problem);
            }
        }
        Ending::Done
    }

    /// Whether the problem's own law is met, by the carried force and then by a fresh one.
    pub fn is_solved(&mut self, tolerance: f64) -> bool {
        if self.eta() > tolerance {
            return false;
        }
        self.iterate.refresh(self.problem);
        self.eta() <= tolerance
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

    /// `eta` under the problem's own law.
    pub fn eta(&self) -> f64 {
        self.iterate.eta(self.problem)
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
