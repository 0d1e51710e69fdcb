//! Remarks: data that are legal and often a mistake of the host are named beside the result, never refused.

use crate::law::Contact;
use crate::monitor::Monitor;
use crate::solve::result::{CAUSES, Remarks, Solution, Status, Uniqueness, of_problem};
use crate::solve::rigid::{RigidMotions, moves_freely};

/// The remarks on a problem and its solution. With friction nothing is asked about motions: that would cost a
/// factorisation of every semi-definite problem.
pub fn of_solution(contact: &Contact<'_>, solution: &Solution, monitor: &Monitor<'_>) -> Remarks {
    let asked = solution.status == Status::Solved
        && solution.uniqueness == Uniqueness::NotKnown
        && contact.is_frictionless();
    Remarks {
        free_motion: asked
            && moves_freely(contact, &solution.d, &solution.certificate.states, monitor),
        ..of_problem(contact.problem())
    }
}

/// Adds to the sentence of a problem that no method solves what to look at, if contact alone holds a body: there
/// may be no equilibrium.
pub fn explain_stall(contact: &Contact<'_>, solution: &mut Solution, monitor: &Monitor<'_>) {
    let problem = contact.problem();
    if solution.status == Status::Stalled
        && problem.is_symmetric()
        && RigidMotions::of(problem, monitor).is_some()
    {
        let said = solution.message.marked();
        solution.message = format!("{said}; contact alone holds a body: {CAUSES}").into();
    }
}
