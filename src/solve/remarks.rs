//! What is right in itself and often a mistake of the host: said beside the result, never refused.

use super::candidate::CAUSES;
use super::outcome::{Remarks, Solution, Status, Uniqueness};
use super::rigid_balance::rigid_motions;
use super::smallest_lift::moves_freely;
use crate::law::{Contact, friction_is_large, gaps_are_negative};
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, Relation};

/// What the data show.
pub fn of_problem<R: Relation>(problem: &ContactProblem<'_, R>) -> Remarks {
    Remarks {
        gaps_negative: gaps_are_negative(problem),
        friction_large: friction_is_large(problem.law()),
        free_motion: false,
    }
}

/// What the data and the solution show. With friction nothing is asked about motions: that would cost a
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
        && !rigid_motions(problem, &problem.unit_roots(), monitor).is_empty()
    {
        let said = solution.message.marked();
        solution.message = format!("{said}; contact alone holds a body: {CAUSES}").into();
    }
}
