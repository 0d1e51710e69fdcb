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
//! lowered; where a round fails with a small `e`, it is raised again.

mod springs;

use super::dependent::{Growth, contradicts, measured, sentence, step};
use super::outcome::{Solution, Status};
use crate::error::{Argument, Error};
use crate::law::{Contact, pressing, without_friction};
use crate::linalg::vector::norm_inf;
use crate::monitor::Monitor;
use crate::problem::{Flexibility, FlexibilityProblem};
use crate::settings::{Method, SMALLEST_TOLERANCE, Settings};
use springs::Springs;

/// Most rounds.
const ROUNDS: usize = 60;

/// Part of the tolerance that a round is solved to, as far as that can be had.
const INNER: f64 = 0.1;

/// Part of the error before a round that is enough for the round.
const ROUGH: f64 = 1e-3;

/// What of the least error is left where a round has made progress.
const HALF: f64 = 0.5;

/// What of the error is left where rounds are slow, so that softer springs are tried.
const SLOW: f64 = 0.1;

/// So many rounds that do not halve the least error show that rounding is reached.
const IDLE_ROUNDS: usize = 12;

/// Solves the problem; `start` are contact forces.
pub fn solve(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
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
        solution.message = sentence(problem, pattern.as_deref(), proved, eta).into();
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

/// Whether a result takes the place of the best one before it.
fn is_better(found: &Solution, best: &Solution) -> bool {
    let is_solved = |result: &Solution| result.status == Status::Solved;
    match (is_solved(found), is_solved(best)) {
        (true, false) => true,
        (false, true) => false,
        _ => {
            let stops = !matches!(found.status, Status::Solved | Status::Stalled);
            stops || found.certificate.eta < best.certificate.eta
        }
    }
}

/// The best result of all rounds, one more than a solution needs as it is cheap and adds digits, and how the forces have grown.
fn rounds(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<(Solution, Growth), Error> {
    let relation: &Flexibility<'_> = problem.relation();
    let contact = Contact::new(problem);
    let mut springs = Springs::new(relation).ok_or_else(|| {
        Error::invalid(
            Argument::Matrix,
            "W is not positive semi-definite: a force has negative flexibility",
        )
    })?;
    let mut force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    let mut growth = Growth::default();
    let mut best: Option<Solution> = None;
    let (mut last, mut least, mut idle) = (springs.compliance(), f64::INFINITY, 0);
    for _ in 0..ROUNDS {
        let wanted = (INNER * settings.tolerance).max(ROUGH * last.min(springs.compliance()));
        let inner = Settings { tolerance: wanted.max(SMALLEST_TOLERANCE), ..settings.clone() };
        let load: Vec<f64> = force.iter().map(|force| -force).collect();
        let system = (springs.stiffness(), &load[..]);
        let round = step(problem, system, &relation.relative(&force), &inner, monitor)?;
        if matches!(round.status, Status::Solved | Status::Stalled) {
            let change = round.certificate.force.iter().zip(&force).map(|(a, b)| a - b);
            growth.add(change.map(|change| springs.compliance() * change).collect());
            force.clone_from(&round.certificate.force);
        }
        let failed = round.status != Status::Solved;
        let found = measured(&contact, round, (relation.relative(&force), &force), settings);
        let before = std::mem::replace(&mut last, found.certificate.eta);
        idle = if last < HALF * least { 0 } else { idle + 1 };
        least = least.min(last);
        let was_solved = best.as_ref().is_some_and(|best| best.status == Status::Solved);
        let stops = !matches!(found.status, Status::Solved | Status::Stalled);
        if best.as_ref().is_none_or(|best| is_better(&found, best)) {
            best = Some(found);
        }
        if was_solved || stops || growth.pattern().is_some() || idle >= IDLE_ROUNDS {
            break;
        }
        if failed {
            springs.stiffen(relation);
        } else if last > SLOW * before && !growth.is_steady() {
            springs.soften(relation);
        }
    }
    let best = best.ok_or(Error::OutOfMemory("a round of the flexibility form"))?;
    Ok((best, growth))
}
