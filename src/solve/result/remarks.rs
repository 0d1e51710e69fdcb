//! Remarks that the data of a problem show, before anything is solved.

use super::solution::Remarks;
use crate::law::{friction_is_large, gaps_are_negative};
use crate::problem::{ContactProblem, Relation};

/// The remarks on a problem whose solution is not asked.
pub fn of_problem<R: Relation>(problem: &ContactProblem<'_, R>) -> Remarks {
    Remarks {
        gaps_negative: gaps_are_negative(problem),
        friction_large: friction_is_large(problem.law()),
        free_motion: false,
        held_by_rounding: false,
    }
}
