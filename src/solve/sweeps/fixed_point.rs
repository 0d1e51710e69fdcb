//! Friction by projected SOR: given thresholds, and Coulomb's law in two forms.
//!
//! *Nested*: a sequence of Tresca problems, `g <- (1 - theta) g + theta mu |F_n|` (paper, section
//! 2.1), each solved to 0.1 of the accuracy of the threshold. Without damping the error falls by
//! `rho = mu |beta|` each time, `beta` Dundurs' constant, and grows if that exceeds 1;
//! `theta = 1 / (1 + rho²)` makes it fall by `rho / sqrt(1 + rho²)` for every `mu`, since the
//! eigenvalues of the undamped map are close to imaginary. `rho` is measured.
//!
//! *Diagonal*: the threshold follows the pressure inside each sweep. Often fewer sweeps, no
//! guarantee.

use super::driver::{Driver, LARGEST_FACTOR};
use super::swept::Swept;
use crate::linalg::vector::{largest_of, norm};
use crate::solve::result::{Call, Candidate, Effort, Ending};

/// Accuracy of an inner problem relative to that of the threshold.
const INNER: f64 = 0.1;

/// Sweeps after which the threshold is updated even if the inner problem, which may have no
/// solution of its own on a semi-definite `K`, is not solved.
const INNER_SWEEPS: u64 = 500;

/// Least damping chosen: enough for `mu |beta|` up to 6.
const LEAST_DAMPING: f64 = 0.027;

/// The largest factor with which sweeps under Coulomb's law converge, `1 + RANGE / (1 + SLOPE mu)`: a
/// fit to where they stop converging on the bar on the plane, 1.8 at `mu = 0.3`, 1.6 at 1, 1.35 at 3.
/// On other structures [`super::relaxation`] lowers a factor that is too large.
const RANGE: f64 = 0.95;
const SLOPE: f64 = 0.55;

/// Solves with given thresholds, or with Coulomb's updated inside the sweep.
pub fn single(call: &Call<'_>) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let steepest = largest_of(contact.bounds().map(|bound| bound.slope));
    let largest_factor = if contact.is_coupled() {
        LARGEST_FACTOR.min(1.0 + RANGE / (1.0 + SLOPE * steepest))
    } else {
        LARGEST_FACTOR
    };
    let mut driver = Driver::new(call, begin(call), largest_factor);
    let ending = driver.solve(settings.tolerance).err().unwrap_or(Ending::Done);
    let effort = Effort { omega: driver.relaxation.omega, ..Effort::default() };
    ended(driver, ending, effort)
}

/// Solves Coulomb's problem as a sequence of Tresca problems.
pub fn nested(call: &Call<'_>) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let mut driver = Driver::new(call, begin(call), LARGEST_FACTOR);
    let mut damping = Damping::new(settings.damping);
    let mut thresholds = contact.thresholds(&driver.w);
    let mut outer_iterations = 0;
    let ending = loop {
        let target = match driver.measure(settings.tolerance) {
            Ok(eta) if eta <= settings.tolerance => break Ending::Done,
            Ok(eta) => INNER * eta,
            Err(ending) => break ending,
        };
        driver.problem.working.get_or_insert_with(|| contact.clone()).set_thresholds(&thresholds);
        driver.relaxation.restart();
        if let Err(ending) = driver.relax(target, INNER_SWEEPS) {
            break ending;
        }
        outer_iterations += 1;
        let updated = contact.thresholds(&driver.w);
        let change: Vec<f64> =
            updated.iter().zip(&thresholds).map(|(new, old)| new - old).collect();
        let theta = damping.observe(norm(&change));
        for (threshold, change) in thresholds.iter_mut().zip(&change) {
            *threshold += theta * change;
        }
    };
    let (omega, damping) = (driver.relaxation.omega, damping.theta);
    let effort = Effort { outer_iterations, omega, damping, ..Effort::default() };
    ended(driver, ending, effort)
}

/// The problem with its own law, and where sweeps begin.
fn begin<'c>(call: &Call<'c>) -> (Swept<'c>, Vec<f64>) {
    let contact = call.contact;
    let swept = Swept { contact, working: None, clearances: None };
    (swept, contact.admissible(&call.start_or_zero()))
}

/// The last iterate if it is the solution, the best one otherwise.
fn ended(mut driver: Driver<'_, '_>, ending: Ending, effort: Effort) -> Candidate {
    if ending != Ending::Done
        && let Some(best) = driver.best()
    {
        let contact = driver.problem.contact;
        return Candidate::of_displacements(contact, best, ending).with_effort(effort);
    }
    Candidate::new(driver.x, driver.w, ending, effort)
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
            // With a half or less the fixed point converges fast enough as it is.
            if 2.0 * square > 1.0 && 2.0 * rho_square > 1.0 {
                self.theta = (1.0 / (1.0 + rho_square)).clamp(LEAST_DAMPING, self.theta);
                self.steps.clear();
            }
        }
        self.theta
    }
}
