//! The flexibility form `d = W F + q`, with a `W` that may be singular.
//!
//! A definite `W` is left to Newton's method on `W` itself ([`super::on_flexibility`]) as long as its systems, which are those of
//! closed pairs, take no more operations than `W⁻¹` and a solution on it; then to all methods on the stiffness `W⁻¹`, from whose forces Newton's method on `W`
//! goes on. Where that fails, and where `W` is singular, rounds follow; and where they end without a solution a few
//! pairs are solved from points that are drawn ([`super::drawn`]).
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

use super::compliant::{Springs, is_definite, is_indefinite, stiffness};
use super::drawn::drawn;
use super::growth::sentence;
use super::on_flexibility::{DEAR, LawPoint, OnFlexibility};
use super::rounds::{RoundsFound, first_or_soft, rounds, solve as solve_by_rounds};
use super::step::{Means, ended, step};
use crate::error::{Argument, Error};
use crate::law::{Contact, bounded, exceed_gaps};
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::normalise;
use crate::monitor::Watch;
use crate::problem::{Flexibility, FlexibilityProblem, Stiffness};
use crate::settings::{Method, Settings};
use crate::solve::newton::NewtonOutcome;
use crate::solve::result::{Ending, Solution, Status};

/// The cause where the first springs make `W` definite.
const INDEFINITE: &str =
    "W is not positive semi-definite, its negative eigenvalues are larger than rounding, and ";

/// Solves the problem; `start` are contact forces, `number` tells which pair of the host a pair is, and `means` solve
/// each round.
pub fn solve(
    problem: &FlexibilityProblem<'_>,
    means: Means<'_>,
    start: Option<&[f64]>,
    number: &dyn Fn(usize) -> usize,
) -> Result<Solution, Error> {
    let (contact, settings) = (&Contact::new(problem), means.settings);
    let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    if let Some(found) = without_springs(contact, means, &force)? {
        return Ok(found);
    }
    let with_start = (settings, start);
    let (found, proof) =
        solve_by_rounds(problem, number, with_start, |problem, settings, start| {
            let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
            first_or_soft(problem, settings, |compliance, settings| {
                from_forces(problem, Means { settings, ..means }, (&force, compliance))
            })
        })?;
    if found.solution.status != Status::Stalled {
        return Ok(found.solution);
    }
    Ok(unsettled(contact, means, (found, proof), (&force, number)))
}

/// What rounds that do not settle leave from the start `force`: rest, a proof that there is no solution, one from points
/// that are drawn, or why there is none.
#[inline(never)] // rounds need the stack
fn unsettled(
    contact: &Contact<'_, Flexibility<'_>>,
    means: Means<'_>,
    (found, proof): (RoundsFound, Option<Vec<f64>>),
    (force, number): (&[f64], &dyn Fn(usize) -> usize),
) -> Solution {
    let (problem, settings) = (contact.problem(), means.settings);
    let RoundsFound { mut solution, pattern } = found;
    if let Some(rest) = at_rest(contact, settings, &solution) {
        return rest;
    }
    let eta = solution.certificate.eta;
    if let Some(proof) = proof.or_else(|| at_a_wall(problem)) {
        solution.message = sentence(problem, &proof, true, number).into();
        let mut forces = bounded(problem, &proof);
        normalise(&mut forces);
        solution.status = Status::NoEquilibrium;
        solution.recession = Some(forces);
        return solution;
    }
    if pattern.is_none()
        && let Some(cause) = cause(problem.relation(), means.monitor)
    {
        let said = format!("no solution was found: {cause}forces do not settle (eta is {eta:.1e})");
        solution.message = said.into();
    }
    if settings.method == Method::Auto
        && let Some(found) = drawn(contact, means, force)
    {
        return found;
    }
    solution
}

/// What Newton's method on `W` itself, and methods on its inverse, make of the problem, if that is the end.
#[inline(never)] // rounds need the stack
fn without_springs(
    contact: &Contact<'_, Flexibility<'_>>,
    means: Means<'_>,
    force: &[f64],
) -> Result<Option<Solution>, Error> {
    let settings = means.settings;
    let equations = on_itself(contact, means);
    let is_definite = equations.is_some();
    let mut equations =
        equations.unwrap_or_else(|| OnFlexibility::new(contact, true, means.monitor)).while_cheap();
    let (tolerance, begin) = (settings.tolerance, equations.coordinates(force));
    let found = is_definite.then(|| equations.solve(begin, tolerance));
    if let Some(ended) = found.as_ref().and_then(|found| settled(contact, settings, found)) {
        return Ok(Some(ended));
    }
    // A stiffness that is hardly told from rounding is left to Newton's method.
    let method = match settings.method {
        Method::Auto if !is_definite => Method::Newton,
        method => method,
    };
    let settings = &Settings { method, ..settings.clone() };
    let on_inverse = on_stiffness(contact.problem(), Means { settings, ..means })?;
    let mut equations = equations.at_any_cost();
    let from_inverse = |found: &Solution| equations.coordinates(&found.certificate.force);
    let begins = [
        on_inverse.as_ref().map(from_inverse),
        found.filter(|found| found.ending == DEAR).map(|found| found.point.y),
    ];
    for begin in begins.into_iter().flatten() {
        let again = equations.solve(begin, tolerance);
        if let Some(mut ended) = settled(contact, settings, &again) {
            if let Some(on_inverse) = on_inverse {
                ended.method = on_inverse.method;
                ended.factorisations += on_inverse.factorisations;
            }
            return Ok(Some(ended));
        }
    }
    Ok(None)
}

/// The result of Newton's method on `W`, or rest, if that is the end.
fn settled(
    contact: &Contact<'_, Flexibility<'_>>,
    settings: &Settings,
    found: &NewtonOutcome<LawPoint>,
) -> Option<Solution> {
    let solution = found.solution(contact, settings);
    match solution.status {
        Status::Stalled => at_rest(contact, settings, &solution),
        _ => Some(solution),
    }
}

/// Why forces do not settle, of a definite `W` nothing. `None`: the sentence of the rounds stands.
fn cause(relation: &Flexibility<'_>, monitor: &dyn Watch) -> Option<&'static str> {
    if is_definite(relation, monitor) {
        return Some("");
    }
    is_indefinite(relation, monitor).then_some(INDEFINITE)
}

/// No forces, if they are the solution where a method has `stalled`. Without loads `eta` is relative to the forces
/// themselves, and no iterate gets below their rounding.
fn at_rest(
    contact: &Contact<'_, Flexibility<'_>>,
    settings: &Settings,
    stalled: &Solution,
) -> Option<Solution> {
    if !contact.is_unloaded() {
        return None;
    }
    let zero = vec![0.0; contact.unknowns()];
    let how = (stalled.method, &Ending::Done, stalled.factorisations);
    let rest = ended(contact, (zero.clone(), &zero), settings, how);
    (rest.status == Status::Solved).then_some(rest)
}

/// The force on a pair that nothing moves along its normal, and whose free displacement exceeds its gap: it proves that
/// there is no solution. Beside other pairs that do not settle, rounds do not find it.
fn at_a_wall(problem: &FlexibilityProblem<'_>) -> Option<Vec<f64>> {
    let (dim, relation) = (problem.dim(), problem.relation());
    let normals = (0..problem.unknowns()).step_by(dim);
    let mut walls = normals.filter(|&n| relation.matrix().at(n, n) == 0.0);
    walls.find_map(|n| {
        let mut forces = vec![0.0; problem.unknowns()];
        forces[n] = -1.0;
        exceed_gaps(problem, &forces, relation.free).then_some(forces)
    })
}

/// The equations of a definite `W` for Newton's method; `None` where `W` is not definite, another method is chosen, or there is
/// no time.
pub fn on_itself<'c, 'p>(
    contact: &'c Contact<'p, Flexibility<'p>>,
    means: Means<'c>,
) -> Option<OnFlexibility<'c, 'p>> {
    let fits =
        takes_newton(means.settings) && is_definite(contact.problem().relation(), means.monitor);
    fits.then(|| OnFlexibility::new(contact, true, means.monitor))
}

/// The solution on the stiffness `K = W⁻¹`, with the load `K q`. `None` if there is none, or no stiffness.
fn on_stiffness(
    problem: &FlexibilityProblem<'_>,
    means: Means<'_>,
) -> Result<Option<Solution>, Error> {
    let relation = problem.relation();
    let Ok(Some(stiffness)) = stiffness(relation, 0.0, means.monitor) else { return Ok(None) };
    let size = problem.unknowns();
    let stiffness = Matrix::new(size, &stiffness, size.max(1));
    let load = stiffness.product(relation.free);
    let form = Stiffness::new(stiffness, &load, problem.dim());
    let found = step(problem, form, &vec![0.0; size], means)?;
    Ok(Some(found).filter(|found| found.status == Status::Solved))
}

/// True if Newton's method is chosen, or left to the default.
pub fn takes_newton(settings: &Settings) -> bool {
    matches!(settings.method, Method::Auto | Method::Newton)
}

/// Rounds from contact forces `force`, with springs of a compliance at first.
fn from_forces(
    problem: &FlexibilityProblem<'_>,
    means: Means<'_>,
    (force, compliance): (&[f64], f64),
) -> Result<RoundsFound, Error> {
    let (relation, settings) = (problem.relation(), means.settings);
    match Springs::new(relation, compliance, means.monitor) {
        Ok(springs) => {
            let mut springs = springs.ok_or_else(|| {
                Error::invalid(
                    Argument::Matrix,
                    "W is not positive semi-definite: a force has negative flexibility",
                )
            })?;
            rounds(problem, &mut springs, force.to_vec(), means)
        }
        Err(stop) => {
            let (d, how) = (relation.relative(force), (settings.method, &Ending::Stopped(stop), 0));
            let solution = ended(&Contact::new(problem), (d, force), settings, how);
            Ok(RoundsFound { solution, pattern: None })
        }
    }
}
