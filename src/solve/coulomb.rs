//! Friction by projected SOR: given thresholds, and Coulomb's law in two forms.
//!
//! *Nested*: a sequence of Tresca problems, `g <- (1 - theta) g + theta mu |F_n|` (paper, section
//! 2.1), each solved only ten times more accurately than the threshold is known. Without damping
//! the error falls by `rho = mu |beta|` each time, `beta` Dundurs' constant, and grows if that
//! exceeds 1; `theta = 1 / (1 + rho²)` makes it fall by `rho / sqrt(1 + rho²)` for every `mu`,
//! since the eigenvalues of the undamped map are close to imaginary. `rho` is measured.
//!
//! *Diagonal*: the threshold follows the pressure inside each sweep. Often fewer sweeps, no
//! guarantee.

use super::escape::EscapeWatch;
use super::relaxation::Relaxation;
use super::sor::Iterate;
use super::{Candidate, Ending};
use crate::linalg::small::norm;
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, Friction};
use crate::settings::Settings;

/// Accuracy of an inner problem relative to that of the threshold.
const INNER: f64 = 0.1;

/// Sweeps after which the threshold is updated even if the inner problem, which may have no
/// solution of its own on a semi-definite `K`, is not solved.
const INNER_SWEEPS: u64 = 500;

/// Largest factor chosen for a Tresca problem.
const CAP: f64 = 1.97;

/// Largest factor chosen when the threshold follows inside the sweep: above it the sweeps of
/// `mu >= 1` diverge on the bar on the plane.
const DIAGONAL_CAP: f64 = 1.3;

/// Least damping chosen: enough for `mu |beta|` up to 6.
const LEAST_DAMPING: f64 = 0.027;

/// Solves with given thresholds, or with Coulomb's updated inside the sweep.
pub fn single(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let coulomb = matches!(problem.friction(), Friction::Coulomb(_));
    let cap = if coulomb && !problem.friction().is_zero() { DIAGONAL_CAP } else { CAP };
    let mut run = Sweeps::new(problem, settings, start, cap, monitor);
    let ended = loop {
        if run.is_solved() {
            break Ending::Done;
        }
        if let Err(ending) = run.relax(problem, settings.tolerance, u64::MAX) {
            break ending;
        }
    };
    run.candidate(ended)
}

/// Solves Coulomb's problem as a sequence of Tresca problems.
pub fn nested(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let mut run = Sweeps::new(problem, settings, start, CAP, monitor);
    let mut damping = Damping::new(settings.damping);
    let mut thresholds = run.thresholds();
    let mut outer = 0;
    let ended = loop {
        if run.is_solved() {
            break Ending::Done;
        }
        let target = INNER * run.iterate.eta(problem);
        let tresca = problem.with_friction(Friction::Tresca(&thresholds));
        if let Err(ending) = run.relax(&tresca, target, INNER_SWEEPS) {
            break ending;
        }
        outer += 1;
        let change: Vec<f64> =
            run.thresholds().iter().zip(&thresholds).map(|(new, old)| new - old).collect();
        let theta = damping.observe(norm(&change));
        for (threshold, change) in thresholds.iter_mut().zip(&change) {
            *threshold += theta * change;
        }
    };
    Candidate { outer_iterations: outer, damping: damping.theta, ..run.candidate(ended) }
}

/// Projected SOR on one problem under changing thresholds.
struct Sweeps<'p, 'm, 'c> {
    problem: &'p ContactProblem<'p>,
    tolerance: f64,
    iterate: Iterate,
    relaxation: Relaxation,
    escape: EscapeWatch,
    monitor: &'m mut Monitor<'c>,
}

/// Sweeps between two measurements of `eta`, which cost a few operations per unknown each.
const MEASURE: u64 = 4;

impl<'p, 'm, 'c> Sweeps<'p, 'm, 'c> {
    fn new(
        problem: &'p ContactProblem<'p>,
        settings: &Settings,
        start: Vec<f64>,
        cap: f64,
        monitor: &'m mut Monitor<'c>,
    ) -> Self {
        let iterate = Iterate::new(problem, start);
        Sweeps {
            problem,
            tolerance: settings.tolerance,
            escape: EscapeWatch::new(&iterate.d),
            iterate,
            relaxation: Relaxation::new(settings.omega, cap),
            monitor,
        }
    }

    /// Whether the problem's own law is met, by the carried force and then by a fresh one.
    fn is_solved(&mut self) -> bool {
        if self.iterate.eta(self.problem) > self.tolerance {
            return false;
        }
        self.iterate.refresh(self.problem);
        self.iterate.eta(self.problem) <= self.tolerance
    }

    /// `mu |F_n|` of the iterate.
    fn thresholds(&self) -> Vec<f64> {
        let force = self.iterate.force.chunks_exact(self.problem.dim());
        force
            .enumerate()
            .map(|(i, force)| self.problem.threshold(i, (-force[0]).max(0.0)))
            .collect()
    }

    /// Sweeps under `law` until `eta <= target`, nothing moves or `most` sweeps are done.
    fn relax(&mut self, law: &ContactProblem<'_>, target: f64, most: u64) -> Result<(), Ending> {
        for sweep in 1..=most {
            self.monitor.step().map_err(Ending::Interrupted)?;
            let change = self.iterate.sweep(law, self.relaxation.omega());
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
        Ok(())
    }

    fn candidate(self, ending: Ending) -> Candidate {
        let omega = self.relaxation.omega();
        Candidate { omega, ..Candidate::ended(self.iterate.d, ending) }
    }
}

/// Damping of the threshold update, given or chosen from the measured rate.
struct Damping {
    theta: f64,
    adaptive: bool,
    steps: Vec<f64>,
}

impl Damping {
    fn new(theta: f64) -> Self {
        let adaptive = theta == 0.0;
        Damping { theta: if adaptive { 1.0 } else { theta }, adaptive, steps: Vec::new() }
    }

    /// Takes the size of the undamped step and returns the factor to use with it.
    fn observe(&mut self, step: f64) -> f64 {
        self.steps.push(step);
        // Over two steps, since the map turns the error by about a right angle in each.
        if self.adaptive
            && let [.., before, _, now] = self.steps[..]
            && before > 0.0
        {
            let square = now / before;
            let keep = 1.0 - self.theta;
            let rho_square = (square - keep * keep) / (self.theta * self.theta);
            if square > 0.5 && rho_square > 0.5 {
                self.theta = (1.0 / (1.0 + rho_square)).clamp(LEAST_DAMPING, self.theta);
                self.steps.clear();
            }
        }
        self.theta
    }
}
