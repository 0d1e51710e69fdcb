//! Remarks on a result: data that are legal and often a mistake, and what a host should know of a solution.

use super::ending::CAUSES;
use super::solution::{Remarks, Solution, Status};
use crate::law::{deepest_of_negative_gaps, friction_is_large};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;
use crate::problem::{ContactProblem, Relation};

/// The remarks on the data of a problem with the displacements `d`. Gaps that are no more than rounding beside them
/// may have any sign.
pub fn of_problem<R: Relation>(problem: &ContactProblem<'_, R>, d: &[f64]) -> Remarks {
    let deepest = deepest_of_negative_gaps(problem);
    Remarks {
        gaps_negative: deepest.is_some_and(|deepest| deepest > NEGLIGIBLE * norm_inf(d)),
        friction_large: friction_is_large(problem.law()),
        ..Remarks::default()
    }
}

/// Says the remarks on a solution in its sentence.
pub fn say_remarks<R: Relation>(solution: &mut Solution, problem: &ContactProblem<'_, R>) {
    let remarks = solution.remarks;
    if solution.status != Status::Solved || remarks == Remarks::default() {
        return;
    }
    let deepest = deepest_of_negative_gaps(problem).unwrap_or(0.0);
    let sentences = [
        (remarks.gaps_negative, format!("every gap is negative, by at most {deepest:.1e}")),
        (remarks.friction_large, "a coefficient of friction is above 10".into()),
        (remarks.free_motion, "the bodies may move without any force".into()),
        (remarks.held_by_rounding, format!("only rounding of K holds a body: {CAUSES}")),
        (
            remarks.needs_low_part,
            "d rounded to doubles misses the tolerance, d + d_low meets it".into(),
        ),
    ];
    for (_, sentence) in sentences.iter().filter(|(said, _)| *said) {
        let said = solution.message.marked();
        solution.message = format!("{said}; remark: {sentence}").into();
    }
}
