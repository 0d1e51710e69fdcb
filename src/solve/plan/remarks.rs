//! Remarks: data that are legal and often a mistake of the host are named beside the result, never refused.

use crate::law::Contact;
use crate::monitor::Monitor;
use crate::solve::result::{CAUSES, Remarks, Solution, Status, Uniqueness, of_problem};
use crate::solve::rigid::{RigidMotions, is_held_by_rounding, moves_freely};

/// The remarks on a problem and its solution. With friction nothing is asked about motions: that would cost a
/// factorisation of every semi-definite problem.
pub fn of_solution(contact: &Contact<'_>, solution: &Solution, monitor: &Monitor<'_>) -> Remarks {
    let solved = solution.status == Status::Solved;
    let asked = solved && solution.uniqueness == Uniqueness::NotKnown && contact.is_frictionless();
    let (d, certificate) = (&solution.d, &solution.certificate);
    Remarks {
        free_motion: asked && moves_freely(contact, d, &certificate.states, monitor),
        held_by_rounding: solved && is_held_by_rounding(contact, d, &certificate.force),
        ..of_problem(contact.problem())
    }
}

/// Adds to the sentence of a result what to look at, if contact alone holds a body that no method brings to rest, or if
/// rounding alone holds one: there may be no equilibrium.
pub fn explain(contact: &Contact<'_>, solution: &mut Solution, monitor: &Monitor<'_>) {
    let problem = contact.problem();
    if solution.remarks.held_by_rounding {
        let said = solution.message.marked();
        solution.message = format!("{said}; only rounding of K holds a body: {CAUSES}").into();
    }
    if solution.status == Status::Stalled
        && solution.escape.is_none()
        && problem.is_symmetric()
        && RigidMotions::of(problem, monitor).is_some()
    {
        let said = solution.message.marked();
        solution.message = format!("{said}; contact alone holds a body: {CAUSES}").into();
    }
}
