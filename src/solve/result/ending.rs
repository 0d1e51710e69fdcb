//! How an algorithm ended: the one list for all of them, and their sentences.

use super::solution::{Fallback, Status};
use crate::certificate::Certificate;
use crate::error::{Error, Message, number};
use crate::monitor::Stop;
use crate::settings::Settings;

/// The end of an algorithm.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// Its own test of convergence is met.
    Done,
    /// A budget is used up, or the callback cancelled.
    Stopped(Stop),
    /// It found a motion that may be a recession direction and prove that no equilibrium exists (LCP: a
    /// ray that may prove that nothing is feasible).
    Recession(Vec<f64>),
    /// Springs that are let go leave the bodies moving along this rigid motion, which proves nothing with Coulomb's law.
    RunsAway(Vec<f64>),
    /// The pieces of an earlier iteration repeat.
    Cycle,
    /// The system of its pieces, or its basis, is singular to working precision.
    Singular,
    /// It cannot go on for another reason.
    Stalled(&'static str),
    /// A function of the host has failed, which ends the call.
    Failed(Error),
}

/// The sentence of a proof that no equilibrium exists.
pub const NO_EQUILIBRIUM: &str =
    "no equilibrium exists: the loads drive a rigid motion that contact does not stop";

/// Causes that a host looks at then.
pub const CAUSES: &str = "are a support, friction, or a pair missing, is a gap infinite, or is a normal, a load or the \
                          sign of gap turned round?";

impl From<Stop> for Ending {
    fn from(stop: Stop) -> Self {
        Ending::Stopped(stop)
    }
}

impl From<Error> for Ending {
    fn from(error: Error) -> Self {
        Ending::Failed(error)
    }
}

/// The part of a sentence that tells an error beside the tolerance that it misses.
pub fn wanted(certificate: &Certificate, tolerance: f64) -> String {
    format!("eta is {:.1e}, wanted {tolerance:.1e}", certificate.eta)
}

impl Ending {
    /// Status and sentence of a run with this certificate; whether a motion proves something is not asked.
    pub fn status(&self, settings: &Settings, certificate: &Certificate) -> (Status, Message) {
        let wanted = wanted(certificate, settings.tolerance);
        let (status, sentence) = match self {
            _ if certificate.holds(settings.tolerance) => {
                (Status::Solved, format!("solved: eta is {:.1e}", certificate.eta))
            }
            Ending::Stopped(stop) => stop.status(settings, &wanted),
            other => (Status::Stalled, format!("{}; {wanted}", other.reason(certificate))),
        };
        (status, sentence.into())
    }

    /// Why another method is asked after this end, on pieces whose system has this orientation.
    pub fn fallback(&self, orientation: i8) -> Fallback {
        match self {
            Ending::Cycle => Fallback::Cycle,
            Ending::Singular => Fallback::Singular,
            Ending::Done if orientation < 0 => Fallback::Unstable,
            _ => Fallback::Inaccurate,
        }
    }

    /// Why there is no solution at this end.
    fn reason(&self, certificate: &Certificate) -> &'static str {
        if let Some(doubt) = certificate.doubt() {
            return doubt;
        }
        match self {
            Ending::Recession(_) => {
                "the method ended on a motion that does not prove that no equilibrium exists"
            }
            Ending::RunsAway(_) => "the bodies move away as springs are let go",
            Ending::Cycle => "the states of the pairs repeat in a cycle",
            Ending::Singular => "the system of equations is singular",
            Ending::Stalled(reason) => reason,
            Ending::Failed(_) => "a function of the host has failed",
            Ending::Done | Ending::Stopped(_) => "accuracy was lost to rounding",
        }
    }
}

impl Stop {
    /// Status and sentence of a run that was stopped with the accuracy that `wanted` tells.
    pub fn status(self, settings: &Settings, wanted: &str) -> (Status, String) {
        match self {
            Stop::IterationLimit => (
                Status::IterationLimit,
                format!("max_iterations ({}) used up; {wanted}", settings.max_iterations),
            ),
            Stop::TimeLimit => (
                Status::TimeLimit,
                format!(
                    "time_limit ({} s) used up, or too little left for the next step; {wanted}",
                    number(settings.time_limit)
                ),
            ),
            Stop::Cancelled => {
                (Status::Cancelled, format!("cancelled by the progress callback; {wanted}"))
            }
        }
    }
}
