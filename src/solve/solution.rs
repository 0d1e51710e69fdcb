//! What a solver hands over, and what is called a solution: decided by the certificate alone.

use crate::certificate::{Certificate, certify, is_escape};
use crate::linalg::small::largest;
use crate::monitor::Stop;
use crate::problem::ContactProblem;
use crate::settings::{Method, Settings};

/// What a result is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Certified: `eta <= tolerance`.
    Solved,
    /// `max_iterations` used up; the result is the best iterate.
    IterationLimit,
    /// `time_limit` used up; the result is the best iterate.
    TimeLimit,
    /// Cancelled by the callback; the result is the best iterate.
    Cancelled,
    /// Proved: no equilibrium exists. The displacements are the motion of escape.
    NoEquilibrium,
    /// The method cannot go on, and proves nothing.
    Stalled,
}

/// Why the method that was tried first did not end it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fallback {
    /// Its states came again.
    Cycle,
    /// It met a singular system.
    Singular,
    /// It found a solution of orientation −1, beside which there are others.
    Unstable,
    /// It found no accurate solution.
    Inaccurate,
}

/// Whether a solution is the only one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uniqueness {
    /// Neither is proved.
    NotKnown,
    /// Proved to be the only one.
    Unique,
    /// Proved to be one of several.
    Several,
}

/// A candidate of a solver, not yet certified.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Displacements.
    pub d: Vec<f64>,
    /// Why the solver stopped.
    pub ending: Ending,
    /// Sign of the determinant of the system of its states, 0 if not known.
    pub orientation: i8,
    /// Dense factorisations.
    pub factorisations: u64,
    /// Threshold updates.
    pub outer_iterations: u64,
    /// How often a tableau was computed anew.
    pub refactorisations: u64,
    /// Over-relaxation factor.
    pub omega: f64,
    /// Damping of the threshold.
    pub damping: f64,
}

/// Why a solver stopped.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// It believes that it is done.
    Done,
    /// A budget ended it, or the caller.
    Interrupted(Stop),
    /// It follows a motion that may prove that no equilibrium exists.
    Escape(Vec<f64>),
    /// The states of an earlier iteration came again.
    Cycle,
    /// The system of its states is singular.
    Singular,
    /// It cannot go on for another reason.
    Stalled(&'static str),
}

impl Candidate {
    /// A candidate of which no more is known.
    pub fn ended(d: Vec<f64>, ending: Ending) -> Self {
        Candidate {
            d,
            ending,
            orientation: 0,
            factorisations: 0,
            outer_iterations: 0,
            refactorisations: 0,
            omega: 0.0,
            damping: 0.0,
        }
    }
}

/// Result of a contact problem.
#[derive(Clone, Debug)]
pub struct Solution {
    /// What it is.
    pub status: Status,
    /// One sentence on what happened.
    pub message: String,
    /// Relative displacements; the best iterate where [`Self::status`] is not [`Status::Solved`].
    pub d: Vec<f64>,
    /// The certificate of `d`: measures, contact forces, states.
    pub certificate: Certificate,
    /// Of [`Status::NoEquilibrium`] the motion that proves it (a recession direction), its largest
    /// component 1.
    pub recession: Option<Vec<f64>>,
    /// The method that ended it.
    pub method: Method,
    /// The method tried first, and why it did not end it.
    pub fallback: Option<(Method, Fallback)>,
    /// Whether it is the only solution.
    pub uniqueness: Uniqueness,
    /// Another solution, if [`crate::Search::SecondSolutions`] found one or the default method met an unstable
    /// one on its way.
    pub second: Option<Box<SecondSolution>>,
    /// Sign of the determinant of the system of equations that the states select, 0 if not known.
    /// Over all solutions of a problem with positive definite `K` it adds up to +1.
    pub orientation: i8,
    /// Sweeps, pivots or linear systems, of all methods that were tried.
    pub iterations: u64,
    /// Dense factorisations of Newton's method and of block pivoting.
    pub factorisations: u64,
    /// Threshold updates of [`Method::SorNested`].
    pub outer_iterations: u64,
    /// How often Lemke's tableau was computed anew because accuracy was lost.
    pub refactorisations: u64,
    /// Over-relaxation factor at the end, 0 if there is none.
    pub omega: f64,
    /// Damping of the threshold at the end, 0 if there is none.
    pub damping: f64,
}

/// A further solution, certified like the first.
#[derive(Clone, Debug)]
pub struct SecondSolution {
    /// Relative displacements.
    pub d: Vec<f64>,
    /// The certificate: measures, contact forces, states.
    pub certificate: Certificate,
    /// As [`Solution::orientation`].
    pub orientation: i8,
}

/// Whether nothing but previous slip can cause forces.
pub fn is_unloaded(problem: &ContactProblem<'_>) -> bool {
    problem.load().iter().all(|&f| f == 0.0) && (0..problem.pairs()).all(|i| problem.gap(i) >= 0.0)
}

/// Certifies the candidate of `method`.
pub fn certified(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    method: Method,
    candidate: Candidate,
) -> Solution {
    let mut d = candidate.d;
    let mut certificate = certify(problem, &d);
    if !certificate.holds(settings.tolerance) && is_unloaded(problem) {
        // Forces that die out without load have no scale of their own but rounding.
        let rest = vec![0.0; d.len()];
        let at_rest = certify(problem, &rest);
        if at_rest.holds(settings.tolerance) {
            (d, certificate) = (rest, at_rest);
        }
    }
    let ending = match candidate.ending {
        // Displacements that run away are themselves a motion that may prove why.
        Ending::Escape(motion) => Ending::Escape(motion),
        Ending::Interrupted(reason) => Ending::Interrupted(reason),
        _ if certificate.runs_away() => Ending::Escape(d.clone()),
        other => other,
    };
    let mut recession = None;
    let accuracy = format!("eta is {:.1e}", certificate.eta);
    let (status, message) = if certificate.holds(settings.tolerance) {
        (Status::Solved, format!("solved: {accuracy}"))
    } else {
        let wanted = format!("{accuracy}, wanted {:.1e}", settings.tolerance);
        match ending {
            Ending::Escape(mut motion) if is_escape(problem, &motion) => {
                let most = largest(&motion);
                motion.iter_mut().for_each(|r| *r /= most);
                recession = Some(motion);
                (
                    Status::NoEquilibrium,
                    "no equilibrium exists: the loads drive a rigid motion that contact does not \
                     stop"
                        .into(),
                )
            }
            Ending::Interrupted(reason) => reason.ended(settings, &wanted),
            other => (Status::Stalled, format!("{}; {wanted}", other.reason(&certificate))),
        }
    };
    Solution {
        status,
        message,
        d,
        certificate,
        recession,
        method,
        fallback: None,
        uniqueness: Uniqueness::NotKnown,
        second: None,
        orientation: if status == Status::Solved { candidate.orientation } else { 0 },
        iterations: 0,
        factorisations: candidate.factorisations,
        outer_iterations: candidate.outer_iterations,
        refactorisations: candidate.refactorisations,
        omega: candidate.omega,
        damping: candidate.damping,
    }
}

impl Ending {
    /// Why there is no solution at this end.
    fn reason(&self, certificate: &Certificate) -> &'static str {
        match self {
            Ending::Escape(_) if certificate.runs_away() => {
                "the displacements are so large that rounding hides the forces"
            }
            Ending::Escape(_) => "the path ended in a ray that proves nothing",
            Ending::Cycle => "the states of the pairs repeat in a cycle",
            Ending::Singular => "the system of equations is singular",
            Ending::Stalled(reason) => reason,
            Ending::Done | Ending::Interrupted(_) => "accuracy was lost to rounding",
        }
    }
}

impl Stop {
    /// Status and sentence of a run that was ended with the accuracy that `wanted` tells.
    pub(super) fn ended(self, settings: &Settings, wanted: &str) -> (Status, String) {
        match self {
            Stop::IterationLimit => (
                Status::IterationLimit,
                format!("max_iterations ({}) used up; {wanted}", settings.max_iterations),
            ),
            Stop::TimeLimit => (
                Status::TimeLimit,
                format!("time_limit ({} s) used up; {wanted}", settings.time_limit),
            ),
            Stop::Cancelled => {
                (Status::Cancelled, format!("cancelled by the progress callback; {wanted}"))
            }
        }
    }
}
