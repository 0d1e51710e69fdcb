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
use super::growth::Growth;
use super::on_flexibility::OnFlexibility;
use super::rounds::{Found, InSeries, rounds, solve as solve_by_rounds};
use super::step::{of_forces, stopped};
use crate::error::{Argument, Error};
use crate::law::{Contact, pressing};
use crate::linalg::vector::norm_inf;
use crate::monitor::Monitor;
use crate::problem::{Flexibility, FlexibilityProblem};
use crate::settings::{Method, Settings};
use crate::solve::result::{Solution, Solve, Status};

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
    let takes_newton = matches!(settings.method, Method::Auto | Method::Newton);
    if takes_newton && is_definite(problem.relation(), monitor) == Ok(true) {
        let mut equations = OnFlexibility::new(contact, None, true);
        let begin = equations.coordinates(&force);
        let found = equations.solve(begin, settings.tolerance, monitor);
        let effort = (&found.ending, found.systems);
        let solution = of_forces(contact, &found.force, settings, effort);
        if solution.status != Status::Stalled {
            return Ok(solution);
        }
    }
    let mut by_rounds =
        |problem: &FlexibilityProblem<'_>, settings: &Settings, start: Option<&[f64]>| {
            let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
            let found = from_forces(problem, (settings, solve), (&force, false), monitor)?;
            if found.solution.status != Status::Stalled || settings.method != Method::Auto {
                return Ok(found);
            }
            // Newton's method in softer springs leads elsewhere: each round has a solution whatever the friction.
            let again = from_forces(problem, (settings, solve), (&force, true), monitor)?;
            Ok(if again.solution.status == Status::Stalled { found } else { again })
        };
    let (found, proof) = solve_by_rounds(problem, number, (settings, start), &mut by_rounds)?;
    let (mut solution, growth) = (found.solution, found.growth);
    if let Some(mut forces) = proof {
        forces = pressing(problem.dim(), &forces);
        let largest = norm_inf(&forces);
        forces.iter_mut().for_each(|force| *force /= largest);
        solution.status = Status::NoEquilibrium;
        solution.recession = Some(forces);
    } else if solution.status == Status::Stalled
        && growth.pattern().is_none()
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

/// Rounds from contact forces `force`, with the first springs; each `by_all_means` of the default method, or as far as
/// Newton's method solves it.
fn from_forces(
    problem: &FlexibilityProblem<'_>,
    (settings, solve): (&Settings, Solve),
    (force, by_all_means): (&[f64], bool),
    monitor: &mut Monitor<'_>,
) -> Result<Found, Error> {
    let relation = problem.relation();
    match Springs::new(relation, monitor) {
        Ok(springs) => {
            let springs = springs.ok_or_else(|| {
                Error::invalid(
                    Argument::Matrix,
                    "W is not positive semi-definite: a force has negative flexibility",
                )
            })?;
            let mut bodies = Bodies { relation, springs, by_all_means };
            rounds(problem, &mut bodies, force.to_vec(), (settings, solve), monitor)
        }
        Err(stop) => {
            let d = relation.relative(force);
            let solution = stopped(&Contact::new(problem), (d, force), settings, stop);
            Ok(Found { solution, growth: Growth::default() })
        }
    }
}

/// Bodies of a flexibility, with springs.
struct Bodies<'p> {
    relation: &'p Flexibility<'p>,
    springs: Springs,
    /// No round is left to softer springs.
    by_all_means: bool,
}

impl InSeries for Bodies<'_> {
    fn compliance(&self) -> f64 {
        self.springs.compliance()
    }

    fn displacements(&self, force: &[f64]) -> Vec<f64> {
        self.relation.relative(force)
    }

    fn stiffness(&self) -> &[f64] {
        self.springs.stiffness()
    }

    fn load(&mut self, force: &[f64]) -> Vec<f64> {
        force.iter().map(|force| -force).collect()
    }

    fn soften(&mut self, monitor: &mut Monitor<'_>) {
        self.springs.soften(self.relation, monitor);
    }

    fn stiffen(&mut self, monitor: &mut Monitor<'_>) {
        self.springs.stiffen(self.relation, monitor);
    }

    fn are_softest(&self) -> bool {
        self.by_all_means || self.springs.are_softest()
    }
}
