//! The internal result of a method, how it ended, and its certification: the certificate alone decides
//! what is called a solution.

use std::cell::OnceCell;

use super::outcome::{Errors, Solution, Status};
use crate::certificate::{Certificate, is_escape_of, measure, measure_parts};
use crate::law::Contact;
use crate::linalg::vector::normalise;
use crate::monitor::Stop;
use crate::settings::{Method, Settings};

/// How an algorithm ended: the one list for all of them.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Its own test of convergence is met.
    Done,
    /// A budget is used up, or the callback cancelled.
    Stopped(Stop),
    /// It found a motion that may be a recession direction and prove that no equilibrium exists (LCP: a
    /// ray that may prove that nothing is feasible).
    Recession(Vec<f64>),
    /// The branches of an earlier iteration repeat.
    Cycle,
    /// The system of its branches, or its basis, is singular to working precision.
    Singular,
    /// It cannot go on for another reason.
    Stalled(&'static str),
}

/// A candidate of a solver: displacements with the forces that they need, and how they were found.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// Displacements.
    pub d: Vec<f64>,
    /// What rounding to doubles has left out of `d`; empty where nothing is known of it.
    pub low: Vec<f64>,
    /// Contact forces that equilibrium needs at `d`, as the solver has them.
    pub force: Vec<f64>,
    /// Why the solver stopped.
    pub ending: Ending,
    /// Counts.
    pub effort: Effort,
    /// Sign of the determinant of the system of its branches, 0 if not known.
    pub orientation: i8,
    /// What a refinement tells of its errors.
    pub errors: Option<Errors>,
    certificate: OnceCell<Certificate>,
}

/// What a solver did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Effort {
    /// Dense factorisations.
    pub factorisations: u64,
    /// Threshold updates.
    pub outer_iterations: u64,
    /// How often a tableau was refactorised.
    pub refactorisations: u64,
    /// Over-relaxation factor at the end, 0 if there is none.
    pub omega: f64,
    /// Damping of the threshold at the end, 0 if there is none.
    pub damping: f64,
}

impl Effort {
    /// The effort of so many linear systems.
    pub fn of_systems(factorisations: u64) -> Self {
        Effort { factorisations, ..Effort::default() }
    }
}

impl Candidate {
    /// A candidate with its forces.
    pub fn new(d: Vec<f64>, force: Vec<f64>, ending: Ending, effort: Effort) -> Self {
        let certificate = OnceCell::new();
        let (low, errors) = (Vec::new(), None);
        Candidate { d, low, force, ending, effort, orientation: 0, errors, certificate }
    }

    /// A candidate whose forces follow from its displacements.
    pub fn of_displacements(contact: &Contact<'_>, d: Vec<f64>, ending: Ending) -> Self {
        let force = contact.problem().force(&d);
        Candidate::new(d, force, ending, Effort::default())
    }

    /// A solver that could not begin: zero displacement.
    pub fn without_displacements(contact: &Contact<'_>, ending: Ending) -> Self {
        Candidate::of_displacements(contact, vec![0.0; contact.unknowns()], ending)
    }

    /// The same candidate with the counts of what found it.
    pub fn with_effort(self, effort: Effort) -> Self {
        Candidate { effort, ..self }
    }

    /// The same candidate at other displacements.
    pub fn moved_to(self, contact: &Contact<'_>, d: Vec<f64>) -> Self {
        let force = contact.problem().force(&d);
        Candidate { d, low: Vec::new(), force, ..self }.remeasured()
    }

    /// The same candidate with another ending.
    pub fn ended(self, ending: Ending) -> Self {
        Candidate { ending, ..self }
    }

    /// The same candidate after a change of its displacements: its certificate is measured anew.
    pub fn remeasured(self) -> Self {
        Candidate { certificate: OnceCell::new(), ..self }
    }

    /// The certificate, measured once.
    pub fn certificate(&self, contact: &Contact<'_>) -> &Certificate {
        self.certificate.get_or_init(|| match self.low.as_slice() {
            [] => measure(contact, &self.d, &self.force),
            low => measure_parts(contact, &self.d, low),
        })
    }

    /// Whether nothing is left to try: solved, proved to have no solution, or stopped.
    pub fn is_settled(&self, contact: &Contact<'_>, tolerance: f64) -> bool {
        match &self.ending {
            Ending::Recession(motion) => is_escape_of(contact, motion),
            Ending::Stopped(_) => true,
            _ => self.certificate(contact).holds(tolerance),
        }
    }
}

/// Turns the candidate of `method` into a result.
pub fn certified(
    contact: &Contact<'_>,
    settings: &Settings,
    method: Method,
    candidate: &Candidate,
) -> Solution {
    let at_rest = at_rest(contact, settings, candidate);
    let candidate = at_rest.as_ref().unwrap_or(candidate);
    let certificate = candidate.certificate(contact).clone().with_rounding(settings.tolerance);
    let mut recession = None;
    let accuracy = format!("eta is {:.1e}", certificate.eta);
    let wanted = format!("{accuracy}, wanted {:.1e}", settings.tolerance);
    // A diverging iterate may itself be a recession direction.
    let motion = match &candidate.ending {
        Ending::Recession(motion) => Some(motion),
        Ending::Stopped(_) => None,
        _ => certificate.runs_away().then_some(&candidate.d),
    };
    let (status, message) = if certificate.holds(settings.tolerance) {
        (Status::Solved, format!("solved: {accuracy}"))
    } else if let Some(motion) = motion.filter(|motion| is_escape_of(contact, motion)) {
        let mut motion = motion.clone();
        normalise(&mut motion);
        recession = Some(motion);
        (Status::NoEquilibrium, NO_EQUILIBRIUM.to_owned())
    } else if let Ending::Stopped(stop) = candidate.ending {
        stop.status(settings, &wanted)
    } else {
        (Status::Stalled, format!("{}; {wanted}", candidate.ending.reason(&certificate)))
    };
    let effort = candidate.effort;
    Solution {
        d_low: low_part(candidate),
        recession,
        errors: candidate.errors.filter(|_| status == Status::Solved),
        orientation: if status == Status::Solved { candidate.orientation } else { 0 },
        factorisations: effort.factorisations,
        outer_iterations: effort.outer_iterations,
        refactorisations: effort.refactorisations,
        omega: effort.omega,
        damping: effort.damping,
        ..Solution::of(method, (status, message), candidate.d.clone(), certificate)
    }
}

/// What rounding has left out of the displacements, as far as it is known.
pub fn low_part(candidate: &Candidate) -> Vec<f64> {
    if candidate.low.is_empty() { vec![0.0; candidate.d.len()] } else { candidate.low.clone() }
}

/// Zero displacement, if it is the solution and the candidate is not. Without loads the scale of
/// forces is rounding only, which no iterate gets below.
fn at_rest(contact: &Contact<'_>, settings: &Settings, other: &Candidate) -> Option<Candidate> {
    if !contact.is_unloaded() || other.certificate(contact).holds(settings.tolerance) {
        return None;
    }
    let mut rest = Candidate::without_displacements(contact, other.ending.clone());
    (rest.effort, rest.orientation) = (other.effort, other.orientation);
    rest.certificate(contact).holds(settings.tolerance).then_some(rest)
}

/// The sentence of a proof that no equilibrium exists.
pub const NO_EQUILIBRIUM: &str =
    "no equilibrium exists: the loads drive a rigid motion that contact does not stop";

/// What a host looks at then.
pub const CAUSES: &str = "are a support, friction, or a pair missing, or is a normal, a load or the sign of gap \
                          turned round?";

impl Ending {
    /// Why there is no solution at this end.
    pub(super) fn reason(&self, certificate: &Certificate) -> &'static str {
        match self {
            _ if certificate.runs_away() => {
                "the displacements are so large that rounding hides the forces"
            }
            Ending::Recession(_) => {
                "the method ended on a motion that does not prove that no equilibrium exists"
            }
            Ending::Cycle => "the states of the pairs repeat in a cycle",
            Ending::Singular => "the system of equations is singular",
            Ending::Stalled(reason) => reason,
            Ending::Done | Ending::Stopped(_) => "accuracy was lost to rounding",
        }
    }
}

impl Stop {
    /// Status and sentence of a run that was stopped with the accuracy that `wanted` tells.
    pub(super) fn status(self, settings: &Settings, wanted: &str) -> (Status, String) {
        match self {
            Stop::IterationLimit => (
                Status::IterationLimit,
                format!("max_iterations ({}) used up; {wanted}", settings.max_iterations),
            ),
            Stop::TimeLimit => (
                Status::TimeLimit,
                format!(
                    "time_limit ({} s) used up, or too little left for the next step; {wanted}",
                    settings.time_limit
                ),
            ),
            Stop::Cancelled => {
                (Status::Cancelled, format!("cancelled by the progress callback; {wanted}"))
            }
        }
    }
}
