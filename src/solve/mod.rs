//! Solvers: each a plain function of (problem, settings, start, monitor) that returns a candidate.
//! What is called a solution is decided in `solution`, by the certificate alone.

mod auto;
mod bare;
mod bordered;
mod coulomb;
mod delayed;
mod elimination;
mod equations;
mod escape;
mod factor;
mod friction_lcp;
mod frictional_lemke;
mod frictionless;
mod lemke;
mod newton;
mod pieces;
mod pivot;
mod relaxation;
mod solution;
mod sor;
mod statics;
mod sweeps;
mod tableau;
mod uniqueness;

use crate::error::{Argument, Error};
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, FrictionLaw};
use crate::settings::{Method, Search, Settings};

pub use bare::{LcpSolution, solve_lcp};
use solution::{Candidate, Ending, certified, is_unloaded};
pub use solution::{Fallback, SecondSolution, Solution, Status, Uniqueness};

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
    check_method(problem, settings.method)?;
    let start = checked_start(problem, start)?;
    let mut solution = match settings.method {
        Method::Auto => auto::solve(problem, settings, start.as_deref(), monitor)?,
        method => {
            let candidate = run(method, problem, settings, start.as_deref(), monitor)?;
            certified(problem, settings, method, candidate)
        }
    };
    uniqueness::by_orientation(problem, &mut solution);
    if settings.search == Search::Others {
        uniqueness::examine(problem, settings, &mut solution, monitor)?;
    }
    solution.iterations = monitor.iterations();
    Ok(solution)
}

/// Runs one method, which fits the problem.
fn run(
    method: Method,
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    if problem.pairs() == 0 {
        return Ok(Candidate::ended(Vec::new(), Ending::Done));
    }
    let rest = || start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    Ok(match (method, problem.law()) {
        (Method::Lemke, friction) if friction.is_zero() => {
            frictionless::lemke(problem, settings, monitor)?
        }
        (Method::Lemke, _) => frictional_lemke::solve(problem, settings, monitor)?,
        (Method::Newton, _) => newton::solve(problem, settings, start, monitor),
        (Method::BlockPivoting, _) => {
            let chosen = settings.method == Method::BlockPivoting;
            let most = if chosen { u64::MAX } else { pivot::enough(problem.pairs()) };
            pivot::solve(problem, settings, true, start, most, monitor)
        }
        (_, friction) if friction.is_zero() => {
            frictionless::sor(problem, settings, &rest(), monitor)
        }
        (Method::SorDiagonal, _) | (_, FrictionLaw::Tresca(_)) => {
            coulomb::single(problem, settings, rest(), monitor)
        }
        _ => coulomb::nested(problem, settings, rest(), monitor),
    })
}

fn check_method(problem: &ContactProblem<'_>, method: Method) -> Result<(), Error> {
    let refuse = |message: &str| Err(Error::invalid(Argument::Settings, message));
    let frictionless = problem.law().is_zero();
    let tresca = matches!(problem.law(), FrictionLaw::Tresca(_));
    let planar = problem.dim() == 2;
    match method {
        Method::Lemke if !frictionless && !planar => {
            refuse("settings: Lemke's method is for frictionless contact, and for friction in 2D")
        }
        Method::BlockPivoting if !frictionless => refuse(if tresca {
            "settings: block pivoting is for frictionless contact, every g must be 0"
        } else {
            "settings: block pivoting is for frictionless contact, every mu must be 0"
        }),
        Method::Newton if !planar => refuse("settings: Newton's method is for 2D"),
        Method::SorDiagonal if tresca => refuse(
            "settings: the diagonal method updates thresholds, and here they are given: use the \
             nested one",
        ),
        _ => Ok(()),
    }
}

fn checked_start(
    problem: &ContactProblem<'_>,
    start: Option<&[f64]>,
) -> Result<Option<Vec<f64>>, Error> {
    let n = problem.unknowns();
    let Some(start) = start else { return Ok(None) };
    if start.len() != n {
        let message = format!("the start has {} entries, it must have {n}", start.len());
        return Err(Error::invalid(Argument::Start, message));
    }
    match start.iter().position(|d| !d.is_finite()) {
        Some(i) => Err(Error::invalid(Argument::Start, format!("the start d[{i}] is not finite"))),
        // Without load and slip rest is the solution, which other starts only approach.
        None if is_unloaded(problem) && problem.has_no_reference_slip() => Ok(None),
        None => Ok(Some(start.to_vec())),
    }
}
