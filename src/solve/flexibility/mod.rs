//! The flexibility form `d = W F + q`, with a `W` that may be singular.
//!
//! Forces that `W` does not feel are not determined by displacements. So each pair gets a soft spring in
//! series, of stiffness `D / e`, which the force of the round before has stretched:
//!
//! ```text
//! d = W F + q + e D⁻¹ (F - F_k)
//! ```
//!
//! With it the other methods solve for the step `d - W F_k - q` on the stiffness `(W + e D⁻¹)⁻¹`: the proximal
//! iteration of [`super::dependent`] on the forces. From `F_0 = 0` it takes, where states do not change on
//! the way, the smallest of the forces that redundant pairs leave open, in the norm of `D⁻¹`.
//!
//! A round divides the error in a pattern of forces by its flexibility over `e`. Where that is slow, `e` is
//! lowered, and after the first solution rounds go on until forces settle. Where Newton's method does not solve a
//! round, `e` is raised: a larger one is an easier problem nearer to the forces at hand. With the largest, the
//! default method has all its means.
//!
//! Slip makes the flexibility that forces feel unsymmetric, and it may be negative in a pattern of them: rounds with
//! an `e` of its size run away from the solution, and harder springs may leave Newton's method without one. Where
//! rounds come to rest without a solution, they begin again at the best forces, and the default method has all its
//! means with harder springs too.

mod islands;
mod springs;

use super::dependent::{Growth, contradicts, measured, named, sentence, settles, step, stopped};
use super::result::{Solution, Status};
use crate::error::{Argument, Error};
use crate::law::{Contact, pressing, without_friction};
use crate::linalg::vector::norm_inf;
use crate::monitor::Monitor;
use crate::problem::{Flexibility, FlexibilityProblem};
use crate::settings::{Method, SMALLEST_TOLERANCE, Settings};
pub use islands::{largest_island, solve as solve_islands};
use springs::{Springs, is_indefinite};

/// Most rounds.
const ROUNDS: usize = 100;

/// Part of the tolerance that a round is solved to, as far as that can be had.
const INNER: f64 = 0.1;

/// Part of the error before a round that is enough for the round.
const ROUGH: f64 = 1e-3;

/// Part of the least error that is left where a round has made progress.
const HALF: f64 = 0.5;

/// Part of the error that is left where rounds are slow, so that less compliant springs are tried.
const SLOW: f64 = 0.1;

/// So many rounds that do not halve the least error show that rounding is reached.
const IDLE_ROUNDS: usize = 12;

/// Least `e` with which the default method has all its means where rounds begin again: a path with harder springs
/// takes hundreds of times as long, and rounds that come so near to a solution leave it to Newton's method.
const ALL_MEANS: f64 = 5e-6;

/// Most rounds after the first solution, until the forces settle: `eta` feels an error in a pattern of forces by its
/// flexibility alone, and is small before forces of nearly redundant pairs are right. A flexibility of `1e-8` beside
/// that of the pairs takes five.
const LAST_ROUNDS: usize = 8;

/// The sentence on a `W` that the first springs make definite.
const INDEFINITE: &str = "no solution was found: W is not positive semi-definite, its negative eigenvalues are \
                          larger than rounding";

/// Solves the problem; `start` are contact forces, `number` tells which pair of the host a pair is.
pub fn solve(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    number: &dyn Fn(usize) -> usize,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let (mut solution, growth) = rounds(problem, settings, start, monitor)?;
    if solution.status == Status::Stalled {
        let mut pattern = growth.pattern().map(<[f64]>::to_vec);
        let mut proved = pattern.as_deref().is_some_and(|pattern| contradicts(problem, pattern));
        if !proved && let Some(found) = contradiction(problem, settings, monitor)? {
            (pattern, proved) = (Some(found), true);
        }
        let eta = solution.certificate.eta;
        solution.message = if pattern.is_none() && is_indefinite(problem.relation(), monitor) {
            format!("{INDEFINITE}, and forces do not settle (eta is {eta:.1e})").into()
        } else {
            sentence(problem, pattern.as_deref(), proved, eta, number).into()
        };
        if proved {
            solution.status = Status::NoEquilibrium;
            solution.recession = pattern.map(|pattern| proof(problem.dim(), &pattern));
        }
    }
    Ok(solution)
}

/// The pressing forces of a pattern, the largest of them 1.
fn proof(dim: usize, pattern: &[f64]) -> Vec<f64> {
    let mut forces = pressing(dim, pattern);
    let largest = norm_inf(&forces);
    forces.iter_mut().for_each(|force| *force /= largest);
    forces
}

/// Normal forces which prove that the gaps contradict each other, from the problem without friction: with
/// friction they may hide behind forces that wedge.
fn contradiction(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Option<Vec<f64>>, Error> {
    let problem = &without_friction(problem);
    let settings = Settings { method: Method::Auto, ..settings.clone() };
    let (_, growth) = rounds(problem, &settings, None, monitor)?;
    let pattern = growth.pattern().filter(|pattern| contradicts(problem, pattern));
    Ok(pattern.map(<[f64]>::to_vec))
}

/// The best result of all rounds, at least one more than a solution needs as it is cheap and adds digits, and how
/// the forces have grown.
fn rounds(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<(Solution, Growth), Error> {
    let contact = Contact::new(problem);
    let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    let springs = match Springs::new(problem.relation(), monitor) {
        Ok(springs) => springs.ok_or_else(|| {
            Error::invalid(
                Argument::Matrix,
                "W is not positive semi-definite: a force has negative flexibility",
            )
        })?,
        Err(stop) => {
            let d = problem.relation().relative(&force);
            let stopped = stopped(&contact, (d, &force), settings, stop);
            return Ok((stopped, Growth::default()));
        }
    };
    let mut rounds = Rounds {
        problem,
        contact,
        last: springs.compliance(),
        springs,
        force,
        changes: [f64::INFINITY; 2],
        growth: Growth::default(),
        best: None,
        least: f64::INFINITY,
        idle: 0,
        solved: 0,
        again: false,
    };
    for _ in 0..ROUNDS {
        if rounds.ends_with_next(settings, monitor)? && !rounds.begin_again(settings, monitor) {
            break;
        }
    }
    let best = rounds.best.ok_or(Error::OutOfMemory("a round of the flexibility form"))?;
    Ok((best, rounds.growth))
}

/// The iteration.
struct Rounds<'p> {
    problem: &'p FlexibilityProblem<'p>,
    contact: Contact<'p, Flexibility<'p>>,
    springs: Springs,
    /// Contact forces of the round before.
    force: Vec<f64>,
    /// The largest changes of a force by the last two rounds.
    changes: [f64; 2],
    growth: Growth,
    best: Option<Solution>,
    /// `eta` of the round before, and the least of all.
    last: f64,
    least: f64,
    /// Rounds since `least` was halved.
    idle: usize,
    /// Rounds since the first solution.
    solved: usize,
    /// True if they have begun again.
    again: bool,
}

impl Rounds<'_> {
    /// Makes a round; whether it is the last one.
    fn ends_with_next(
        &mut self,
        settings: &Settings,
        monitor: &mut Monitor<'_>,
    ) -> Result<bool, Error> {
        let relation = self.problem.relation();
        let round = self.round(settings, monitor)?;
        let force = match round.status {
            Status::Solved | Status::Stalled => round.certificate.force.clone(),
            _ => self.force.clone(),
        };
        let failed = round.status == Status::Stalled;
        let result = (relation.relative(&force), &force[..]);
        let found = measured(&self.contact, round, result, settings);
        let eta = found.certificate.eta;
        if failed && eta >= self.last && !self.springs.are_softest() {
            self.springs.soften(relation, monitor);
            return Ok(false);
        }
        let change: Vec<f64> = force.iter().zip(&self.force).map(|(a, b)| a - b).collect();
        self.changes = [self.changes[1], norm_inf(&change)];
        self.growth.add(change.iter().map(|change| self.springs.compliance() * change).collect());
        self.force = force;
        self.idle = if eta < HALF * self.least { 0 } else { self.idle + 1 };
        self.least = self.least.min(eta);
        let is_slow = match found.status {
            Status::Solved => self.changes[1] > SLOW * self.changes[0],
            _ => eta > SLOW * self.last && !self.growth.is_steady(),
        };
        let settled = settles(self.changes, settings.tolerance * norm_inf(&self.force));
        if !failed && is_slow && !settled {
            self.springs.stiffen(relation, monitor);
        }
        self.last = eta;
        let ends = self.keep(found, settled);
        Ok(ends || self.growth.pattern().is_some() || self.idle >= IDLE_ROUNDS)
    }

    /// Begins again at the best forces, once and where that may help; whether it does.
    fn begin_again(&mut self, settings: &Settings, monitor: &mut Monitor<'_>) -> bool {
        let Some(best) = self.best.as_ref().filter(|best| best.status == Status::Stalled) else {
            return false;
        };
        if self.again || settings.method != Method::Auto || self.growth.pattern().is_some() {
            return false;
        }
        self.force.clone_from(&best.certificate.force);
        self.last = best.certificate.eta;
        self.changes = [f64::INFINITY; 2];
        self.growth = Growth::default();
        (self.idle, self.again) = (0, true);
        self.springs.begin_again(self.problem.relation(), monitor);
        true
    }

    /// Solves the problem with springs. Hard ones are left to softer springs, as far as there are any.
    fn round(&self, settings: &Settings, monitor: &mut Monitor<'_>) -> Result<Solution, Error> {
        let rough = ROUGH * self.last.min(self.springs.compliance());
        let tolerance = rough.max(INNER * settings.tolerance).max(SMALLEST_TOLERANCE);
        let method = match settings.method {
            Method::Auto if self.again && self.springs.compliance() >= ALL_MEANS => Method::Auto,
            Method::Auto if !self.springs.are_softest() => Method::Newton,
            method => method,
        };
        let settings = Settings { tolerance, method, ..settings.clone() };
        let load: Vec<f64> = self.force.iter().map(|force| -force).collect();
        let system = (self.springs.stiffness(), &load[..]);
        step(
            self.problem,
            system,
            &self.problem.relation().relative(&self.force),
            &settings,
            monitor,
        )
    }

    /// Keeps a result if it is the best, of solutions the last one until the forces are `settled`; whether there
    /// will be no better one.
    fn keep(&mut self, found: Solution, settled: bool) -> bool {
        let stops = !matches!(found.status, Status::Solved | Status::Stalled);
        let is_solved = |result: &Solution| result.status == Status::Solved;
        let was_solved = self.best.as_ref().is_some_and(is_solved);
        let is_better = match &self.best {
            Some(best) if is_solved(&found) == was_solved => {
                let unsettled = was_solved && !settled;
                stops || unsettled || found.certificate.eta < best.certificate.eta
            }
            best => best.is_none() || !was_solved,
        };
        if is_better {
            self.best = Some(found);
        }
        self.solved += usize::from(was_solved);
        stops || was_solved && (settled || self.solved >= LAST_ROUNDS)
    }
}
