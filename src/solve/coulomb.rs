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

use super::Candidate;
use super::Ending;
use super::sweeps::{LARGEST_FACTOR, Sweeps};
use crate::linalg::small::{largest, norm};
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, FrictionLaw};
use crate::settings::Settings;

/// Accuracy of an inner problem relative to that of the threshold.
const INNER: f64 = 0.1;

/// Sweeps after which the threshold is updated even if the inner problem, which may have no
/// solution of its own on a semi-definite `K`, is not solved.
const INNER_SWEEPS: u64 = 500;

/// Least damping chosen: enough for `mu |beta|` up to 6.
const LEAST_DAMPING: f64 = 0.027;

/// Solves with given thresholds, or with Coulomb's updated inside the sweep. There the factor is
/// bounded by a fit to where the sweeps stop converging on the bar on the plane: 1.8 at `mu = 0.3`,
/// 1.6 at 1, 1.35 at 3.
pub fn single(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let largest_factor = match problem.law() {
        FrictionLaw::Coulomb(mu) => LARGEST_FACTOR.min(1.0 + 0.95 / (1.0 + 0.55 * largest(mu))),
        FrictionLaw::Frictionless | FrictionLaw::Tresca(_) => LARGEST_FACTOR,
    };
    let mut sweeps = Sweeps::new(problem, settings, start, largest_factor, monitor);
    let ending = sweeps.solve(settings.tolerance).err().unwrap_or(Ending::Done);
    Candidate { omega: sweeps.omega(), ..ended(sweeps, ending) }
}

/// Solves Coulomb's problem as a sequence of Tresca problems.
pub fn nested(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let mut sweeps = Sweeps::new(problem, settings, start, LARGEST_FACTOR, monitor);
    let mut damping = Damping::new(settings.damping);
    let mut thresholds = sweeps.thresholds();
    let mut outer_iterations = 0;
    let ending = loop {
        let target = match sweeps.measure(settings.tolerance) {
            Ok(eta) if eta <= settings.tolerance => break Ending::Done,
            Ok(eta) => INNER * eta,
            Err(ending) => break ending,
        };
        let tresca = problem.with_law(FrictionLaw::Tresca(&thresholds));
        sweeps.restart();
        if let Err(ending) = sweeps.relax(&tresca, target, INNER_SWEEPS) {
            break ending;
        }
        outer_iterations += 1;
        let change: Vec<f64> =
            sweeps.thresholds().iter().zip(&thresholds).map(|(new, old)| new - old).collect();
        let theta = damping.observe(norm(&change));
        for (threshold, change) in thresholds.iter_mut().zip(&change) {
            *threshold += theta * change;
        }
    };
    Candidate {
        outer_iterations,
        damping: damping.theta,
        omega: sweeps.omega(),
        ..ended(sweeps, ending)
    }
}

/// The last iterate if it is the solution, the best one otherwise.
fn ended(sweeps: Sweeps<'_, '_, '_>, ending: Ending) -> Candidate {
    let d = if ending == Ending::Done { sweeps.d().to_vec() } else { sweeps.best() };
    Candidate::ended(d, ending)
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
