//! Solvers: each a plain function of (problem, settings, start, monitor) that returns a candidate.
//! What is called a solution is decided in `candidate`, by the certificate alone.
//!
//! ```text
//! outcome ← candidate ← condense ← rigid_balance ← smallest_lift ← sweeps ← normal_map ← krylov ← active_set ← path ← lemke ← uniqueness ← dispatch ← auto ← escape_motion ← far_obstacles ← dependent ← existence ← mod
//!                                                                                   └──── lcp ────────────────────────┘
//! ```
//!
//! Each imports from those to its left only. One algorithm is one folder; what others may use of it is
//! what its `mod.rs` names.

mod active_set;
mod auto;
mod candidate;
mod condense;
mod dependent;
mod dispatch;
mod escape_motion;
mod existence;
mod far_obstacles;
mod krylov;
mod lcp;
mod lemke;
mod normal_map;
mod outcome;
mod path;
mod rigid_balance;
mod smallest_lift;
mod sweeps;
mod uniqueness;

use crate::error::{Argument, Error, entry};
use crate::law::Contact;
use crate::linalg::vector::first_not_finite;
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, DependentRows};
use crate::settings::{Search, Settings};

pub(crate) use candidate::NO_EQUILIBRIUM;
use dispatch::check_method;
pub(crate) use krylov::{
    Case as UnformedCase, certify as certify_unformed, solve as solve_unformed,
};
pub use lcp::{LcpSolution, solve_lcp};
pub use outcome::{
    Errors, Escape, Existence, Fallback, SecondSolution, Solution, Status, Uniqueness,
};

/// Solves a contact problem whose rows depend on each other, as [`solve()`] does another one. Contact forces
/// are not unique then, nor is any solution called the only one.
///
/// # Errors
/// As [`solve()`].
pub(crate) fn solve_dependent(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    settings.validate()?;
    check_start(problem.unknowns(), start)?;
    let mut solution = dependent::solve(problem, settings, start, monitor)?;
    solution.iterations = monitor.iterations();
    Ok(solution)
}

/// Solves a contact problem from the displacements `start` (zero if `None`).
///
/// # Errors
/// Settings out of range, a method that does not fit the problem, a start of the wrong length or
/// with entries that are not finite; memory that cannot be had.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    settings.validate()?;
    let contact = Contact::new(problem);
    check_method(&contact, settings.method)?;
    check_start(contact.unknowns(), start)?;
    // Where d = 0 is the solution, other starts only approach it.
    let start = start.filter(|_| !contact.is_at_rest());
    let mut solution = far_obstacles::solve(&contact, settings, start, monitor)?;
    escape_motion::describe(&contact, &mut solution, monitor)?;
    uniqueness::by_orientation(&contact, &mut solution);
    if settings.search == Search::Others {
        uniqueness::examine(&contact, settings, &mut solution, monitor)?;
    }
    if settings.proof {
        existence::examine(&contact, settings, &mut solution);
    }
    solution.iterations = monitor.iterations();
    Ok(solution)
}

pub(crate) fn check_start(n: usize, start: Option<&[f64]>) -> Result<(), Error> {
    let Some(start) = start else { return Ok(()) };
    if start.len() != n {
        let message = format!("the start has {} entries, it must have {n}", start.len());
        return Err(Error::invalid(Argument::Start, message));
    }
    match first_not_finite(start) {
        Some(i) => {
            let message = format!("the start {} is not finite", entry("d", [i]));
            Err(Error::invalid(Argument::Start, message))
        }
        None => Ok(()),
    }
}
