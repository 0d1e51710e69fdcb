//! Solvers: each a plain function of (problem, settings, start, monitor) that returns a candidate.
//! What is called a solution is decided in `candidate`, by the certificate alone.
//!
//! ```text
//! outcome ← candidate ← condense ← rigid_balance ← sweeps ← active_set ← lemke ← uniqueness ← auto ← mod
//!                                                                          └──── lcp ────────────┘
//! ```
//!
//! Each imports from those to its left only. One algorithm is one folder; what others may use of it is
//! what its `mod.rs` names.

mod active_set;
mod auto;
mod candidate;
mod condense;
mod lcp;
mod lemke;
mod outcome;
mod rigid_balance;
mod sweeps;
mod uniqueness;

use crate::error::{Argument, Error, entry};
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::{Method, Search, Settings};

pub(crate) use candidate::NO_EQUILIBRIUM;
use candidate::{Candidate, Ending, certified};
pub use lcp::{LcpSolution, solve_lcp};
pub use outcome::{Fallback, SecondSolution, Solution, Status, Uniqueness};

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
    check_start(&contact, start)?;
    // Where d = 0 is the solution, other starts only approach it.
    let start = start.filter(|_| !contact.is_at_rest());
    let mut solution = match settings.method {
        Method::Auto => auto::solve(&contact, settings, start, monitor)?,
        method => {
            let candidate = run(method, &contact, settings, start, monitor)?;
            certified(&contact, settings, method, &candidate)
        }
    };
    uniqueness::by_orientation(&contact, &mut solution);
    if settings.search == Search::Others {
        uniqueness::examine(&contact, settings, &mut solution, monitor)?;
    }
    solution.iterations = monitor.iterations();
    Ok(solution)
}

/// Runs one method, which fits the problem.
fn run(
    method: Method,
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    if contact.pairs().is_empty() {
        return Ok(Candidate::without_displacements(contact, Ending::Done));
    }
    let start_or_zero = || start.map_or_else(|| vec![0.0; contact.unknowns()], <[f64]>::to_vec);
    Ok(match (method, contact.is_frictionless()) {
        (Method::Lemke, true) => lemke::frictionless(contact, settings, monitor)?,
        (Method::Lemke, false) => lemke::friction_2d(contact, settings, monitor)?,
        (Method::Newton, _) => active_set::newton(contact, settings, start, monitor),
        (Method::BlockPivoting, _) => {
            let chosen = settings.method == Method::BlockPivoting;
            let most = if chosen { u64::MAX } else { active_set::enough(contact.pairs().len()) };
            active_set::contact(contact, settings, start, most, monitor)
        }
        (_, true) => sweeps::frictionless(contact, settings, &start_or_zero(), monitor),
        // Thresholds that do not depend on the pressure need no updates.
        (Method::SorNested, false) if contact.is_coupled() => {
            sweeps::nested(contact, settings, start_or_zero(), monitor)
        }
        _ => sweeps::single(contact, settings, start_or_zero(), monitor),
    })
}

fn check_method(contact: &Contact<'_>, method: Method) -> Result<(), Error> {
    let refuse = |message: &str| Err(Error::invalid(Argument::Settings, message));
    let frictionless = contact.is_frictionless();
    let planar = contact.dim() == 2;
    match method {
        Method::Lemke if !frictionless && !planar => {
            refuse("settings: Lemke's method is for frictionless contact, and for friction in 2D")
        }
        Method::BlockPivoting if !frictionless => refuse(if contact.is_coupled() {
            "settings: block pivoting is for frictionless contact: the law must be frictionless, \
             or every mu must be 0"
        } else {
            "settings: block pivoting is for frictionless contact: the law must be frictionless, \
             or every g must be 0"
        }),
        Method::Newton if !planar => refuse("settings: Newton's method is for 2D"),
        Method::SorDiagonal if !frictionless && !contact.is_coupled() => refuse(
            "settings: the diagonal method updates thresholds, and here they are given: use the \
             nested one",
        ),
        _ => Ok(()),
    }
}

fn check_start(contact: &Contact<'_>, start: Option<&[f64]>) -> Result<(), Error> {
    let n = contact.unknowns();
    let Some(start) = start else { return Ok(()) };
    if start.len() != n {
        let message = format!("the start has {} entries, it must have {n}", start.len());
        return Err(Error::invalid(Argument::Start, message));
    }
    match start.iter().position(|d| !d.is_finite()) {
        Some(i) => {
            let message = format!("the start {} is not finite", entry("d", [i]));
            Err(Error::invalid(Argument::Start, message))
        }
        None => Ok(()),
    }
}
