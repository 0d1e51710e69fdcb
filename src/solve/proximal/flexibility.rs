//! The flexibility form `d = W F + q`, with a `W` that may be singular.
//!
//! A definite `W` is left to Newton's method on `W` itself ([`super::on_flexibility`]). Where that fails, and where `W` is
//! singular, rounds follow; and where they end without a solution a few pairs are solved from points that are drawn
//! ([`super::drawn`]).
//!
//! Forces that `W` does not feel are not determined by displacements. So each pair gets a soft spring in
//! series:
//!
//! ```text
//! d = W F + q + e D⁻¹ (F - F_k)
//! ```
//!
//! With it the other methods solve for the step `d - W F_k - q` on the stiffness `(W + e D⁻¹)⁻¹`, in
//! [`super::rounds`]. Slip makes the flexibility that forces feel unsymmetric, and it may be negative in a pattern of
//! them: rounds with an `e` of its size run away from the solution, and harder springs may leave Newton's method
//! without one.

use super::compliant::{Springs, is_definite, is_indefinite};
use super::drawn::drawn;
use super::on_flexibility::{LawPoint, OnFlexibility};
use super::rounds::{RoundsFound, rounds, solve as solve_by_rounds};
use super::step::ended;
use crate::error::{Argument, Error};
use crate::law::{Contact, pressing};
use crate::linalg::vector::normalise;
use crate::monitor::Monitor;
use crate::problem::{Flexibility, FlexibilityProblem};
use crate::settings::{Method, Settings};
use crate::solve::newton::NewtonOutcome;
use crate::solve::result::{Ending, Solution, Solve, Status};

/// The sentence on a `W` that the first springs make definite.
const INDEFINITE: &str = "no solution was found: W is not positive semi-definite, its negative eigenvalues are \
                          larger than rounding";

/// Solves the problem; `start` are contact forces, `number` tells which pair of the host a pair is, and `solve` solves
/// each round.
pub fn solve(
    problem: &FlexibilityProblem<'_>,
    (settings, solve): (&Settings, Solve),
    start: Option<&[f64]>,
    number: &dyn Fn(usize) -> usize,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let contact = &Contact::new(problem);
    let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    if let Some(found) = on_itself(contact, settings, &force, monitor) {
        let solution = found.solution(contact, settings);
        if solution.status != Status::Stalled {
            return Ok(solution);
        }
    }
    let with_start = (settings, start);
    let (found, proof) =
        solve_by_rounds(problem, number, with_start, |problem, settings, start| {
            let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
            let found = from_forces(problem, (settings, solve), (&force, false), monitor)?;
            if found.solution.status != Status::Stalled || settings.method != Method::Auto {
                return Ok(found);
            }
            // Newton's method in softer springs leads elsewhere: each round has a solution whatever the friction.
            let again = from_forces(problem, (settings, solve), (&force, true), monitor)?;
            Ok(if again.solution.status == Status::Stalled { found } else { again })
        })?;
    let RoundsFound { mut solution, pattern } = found;
    if let Some(mut forces) = proof {
        forces = pressing(problem.dim(), &forces);
        normalise(&mut forces);
        solution.status = Status::NoEquilibrium;
        solution.recession = Some(forces);
    } else if solution.status == Status::Stalled
        && pattern.is_none()
        && is_indefinite(problem.relation(), monitor)
    {
        let eta = solution.certificate.eta;
        solution.message =
            format!("{INDEFINITE}, and forces do not settle (eta is {eta:.1e})").into();
    }
    if solution.status == Status::Stalled
        && settings.method == Method::Auto
        && let Some(found) = drawn(contact, settings, &force, monitor)
    {
        return Ok(found);
    }
    Ok(solution)
}

/// What Newton's method makes of a definite `W` from contact forces `force`; `None` where `W` is not definite, another
/// method is chosen, or there is no time.
pub fn on_itself(
    contact: &Contact<'_, Flexibility<'_>>,
    settings: &Settings,
    force: &[f64],
    monitor: &mut Monitor<'_>,
) -> Option<NewtonOutcome<LawPoint>> {
    if !takes_newton(settings) || !is_definite(contact.problem().relation(), monitor) {
        return None;
    }
    let mut equations = OnFlexibility::new(contact, true);
    let begin = equations.coordinates(force);
    Some(equations.solve(begin, settings.tolerance, monitor))
}

/// True if Newton's method is chosen, or left to the default.
pub fn takes_newton(settings: &Settings) -> bool {
    matches!(settings.method, Method::Auto | Method::Newton)
}

/// Rounds from contact forces `force`, with the first springs; each `by_all_means` of the default method, or as far as
/// Newton's method solves it.
fn from_forces(
    problem: &FlexibilityProblem<'_>,
    (settings, solve): (&Settings, Solve),
    (force, by_all_means): (&[f64], bool),
    monitor: &mut Monitor<'_>,
) -> Result<RoundsFound, Error> {
    let relation = problem.relation();
    match Springs::new(relation, by_all_means, monitor) {
        Ok(springs) => {
            let mut springs = springs.ok_or_else(|| {
                Error::invalid(
                    Argument::Matrix,
                    "W is not positive semi-definite: a force has negative flexibility",
                )
            })?;
            rounds(problem, &mut springs, force.to_vec(), (settings, solve), monitor)
        }
        Err(stop) => {
            let (d, how) = (relation.relative(force), (settings.method, &Ending::Stopped(stop), 0));
            let solution = ended(&Contact::new(problem), (d, force), settings, how);
            Ok(RoundsFound { solution, pattern: None })
        }
    }
}
