//! Solvers: each a plain function of (problem, settings, start, monitor) that returns a candidate.
//! What is called a solution is decided here, by the certificate alone.

mod bare;
mod coulomb;
mod elimination;
mod escape;
mod factor;
mod frictionless;
mod lemke;
mod relaxation;
mod sor;
mod sweeps;
mod tableau;

use crate::certificate::{Certificate, certify, is_escape};
use crate::error::{Argument, Error};
use crate::linalg::small::largest;
use crate::monitor::{Interruption, Monitor};
use crate::problem::{ContactProblem, Friction};
use crate::settings::{Method, Settings};

pub use bare::{LcpSolution, solve_lcp};

/// What a result is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Certified: `eta <= tolerance`.
    Solved,
    /// `max_iterations` used up; the result is the last iterate.
    IterationLimit,
    /// `time_limit` used up; the result is the last iterate.
    TimeLimit,
    /// Cancelled by the callback; the result is the last iterate.
    Cancelled,
    /// Proved: no equilibrium exists. The displacements are the motion of escape.
    NoEquilibrium,
    /// The method cannot go on, and proves nothing.
    Stalled,
}

/// A candidate of a solver, not yet certified.
#[derive(Clone, Debug)]
struct Candidate {
    d: Vec<f64>,
    ending: Ending,
    outer_iterations: u64,
    refactorisations: u64,
    omega: f64,
    damping: f64,
}

/// Why a solver stopped.
#[derive(Clone, Debug, PartialEq)]
enum Ending {
    Done,
    Interrupted(Interruption),
    Escape(Vec<f64>),
    Stalled(&'static str),
}

impl Candidate {
    fn ended(d: Vec<f64>, ending: Ending) -> Self {
        Candidate { d, ending, outer_iterations: 0, refactorisations: 0, omega: 0.0, damping: 0.0 }
    }
}

/// Result of a contact problem.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What it is.
    pub status: Status,
    /// One sentence on what happened.
    pub message: String,
    /// Relative displacements; of [`Status::NoEquilibrium`] the motion of escape, its largest
    /// component 1.
    pub d: Vec<f64>,
    /// The certificate: measures, contact forces, states. Of [`Status::NoEquilibrium`] that of the
    /// last iterate, with the forces set to zero.
    pub certificate: Certificate,
    /// Sweeps or pivots.
    pub iterations: u64,
    /// Threshold updates of [`Method::SorNested`].
    pub outer_iterations: u64,
    /// How often Lemke's tableau was computed anew because accuracy was lost.
    pub refactorisations: u64,
    /// Over-relaxation factor at the end, 0 if there is none.
    pub omega: f64,
    /// Damping of the threshold at the end, 0 if there is none.
    pub damping: f64,
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
    check_method(problem, settings.method)?;
    let start = checked_start(problem, start)?;
    let candidate = match (settings.method, problem.friction()) {
        (Method::Lemke, _) => frictionless::lemke(problem, settings, monitor)?,
        (_, friction) if friction.is_zero() => {
            frictionless::sor(problem, settings, &start, monitor)
        }
        (Method::SorNested, Friction::Coulomb(_)) => {
            coulomb::nested(problem, settings, start, monitor)
        }
        (Method::SorDiagonal, _) | (_, Friction::Tresca(_)) => {
            coulomb::single(problem, settings, start, monitor)
        }
    };
    Ok(certified(problem, settings, candidate, monitor.iterations()))
}

fn check_method(problem: &ContactProblem<'_>, method: Method) -> Result<(), Error> {
    let refuse = |message: &str| Err(Error::invalid(Argument::Settings, message));
    let tresca = matches!(problem.friction(), Friction::Tresca(_));
    match method {
        Method::Lemke if !problem.friction().is_zero() => refuse(if tresca {
            "settings: Lemke's method is for frictionless contact, every g must be 0"
        } else {
            "settings: Lemke's method is for frictionless contact, every mu must be 0"
        }),
        Method::SorDiagonal if tresca => refuse(
            "settings: the diagonal method updates thresholds, and here they are given: use the \
             nested one",
        ),
        _ => Ok(()),
    }
}

fn checked_start(problem: &ContactProblem<'_>, start: Option<&[f64]>) -> Result<Vec<f64>, Error> {
    let n = problem.unknowns();
    let rest = vec![0.0; n];
    let Some(start) = start else { return Ok(rest) };
    if start.len() != n {
        let message = format!("the start has {} entries, it must have {n}", start.len());
        return Err(Error::invalid(Argument::Start, message));
    }
    match start.iter().position(|d| !d.is_finite()) {
        Some(i) => Err(Error::invalid(Argument::Start, format!("the start d[{i}] is not finite"))),
        // Without load and slip rest is the solution, which other starts only approach.
        None if is_unloaded(problem) && problem.has_no_previous_slip() => Ok(rest),
        None => Ok(start.to_vec()),
    }
}

/// Whether nothing but previous slip can cause forces.
fn is_unloaded(problem: &ContactProblem<'_>) -> bool {
    problem.load().iter().all(|&f| f == 0.0) && (0..problem.pairs()).all(|i| problem.gap(i) >= 0.0)
}

fn certified(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    candidate: Candidate,
    iterations: u64,
) -> Solution {
    let Candidate { mut d, ending, outer_iterations, refactorisations, omega, damping } = candidate;
    let mut certificate = certify(problem, &d);
    if !certificate.holds(settings.tolerance) && is_unloaded(problem) {
        // Forces that die out without load have no scale of their own but rounding.
        let rest = vec![0.0; d.len()];
        let at_rest = certify(problem, &rest);
        if at_rest.holds(settings.tolerance) {
            (d, certificate) = (rest, at_rest);
        }
    }
    let ending = match ending {
        // Displacements that run away are themselves a motion that may prove why.
        Ending::Done | Ending::Stalled(_) if certificate.runs_away() => Ending::Escape(d.clone()),
        other => other,
    };
    let accuracy = format!("eta is {:.1e}", certificate.eta);
    let (status, message) = if certificate.holds(settings.tolerance) {
        (Status::Solved, format!("solved: {accuracy}"))
    } else {
        let wanted = format!("{accuracy}, wanted {:.1e}", settings.tolerance);
        match ending {
            Ending::Escape(mut motion) if is_escape(problem, &motion) => {
                let most = largest(&motion);
                motion.iter_mut().for_each(|r| *r /= most);
                d = motion;
                certificate.force.fill(0.0);
                (
                    Status::NoEquilibrium,
                    "no equilibrium exists: the loads drive a rigid motion that contact does not \
                     stop"
                        .into(),
                )
            }
            Ending::Escape(_) if certificate.runs_away() => (
                Status::Stalled,
                format!("the displacements are so large that rounding hides the forces; {wanted}"),
            ),
            Ending::Escape(_) => {
                (Status::Stalled, format!("the path ended in a ray that proves nothing; {wanted}"))
            }
            Ending::Interrupted(reason) => reason.ended(settings, &wanted),
            Ending::Stalled(reason) => (Status::Stalled, format!("{reason}; {wanted}")),
            Ending::Done => (Status::Stalled, format!("accuracy was lost to rounding; {wanted}")),
        }
    };
    Solution {
        status,
        message,
        d,
        certificate,
        iterations,
        outer_iterations,
        refactorisations,
        omega,
        damping,
    }
}

impl Interruption {
    /// Status and sentence of a run that was ended with the accuracy that `wanted` tells.
    fn ended(self, settings: &Settings, wanted: &str) -> (Status, String) {
        match self {
            Interruption::IterationLimit => (
                Status::IterationLimit,
                format!("max_iterations ({}) used up; {wanted}", settings.max_iterations),
            ),
            Interruption::TimeLimit => (
                Status::TimeLimit,
                format!("time_limit ({} s) used up; {wanted}", settings.time_limit),
            ),
            Interruption::Cancelled => {
                (Status::Cancelled, format!("cancelled by the progress callback; {wanted}"))
            }
        }
    }
}
