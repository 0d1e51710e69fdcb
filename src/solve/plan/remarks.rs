//! Remarks: data that are legal and often a mistake of the host, and what a host should know of a solution, are named
//! beside the result, never refused.

use crate::certificate::measure;
use crate::law::{Contact, deepest_of_negative_gaps, friction_is_large, passes_gaps, size_of_gaps};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;
use crate::problem::{ContactProblem, Relation};
use crate::settings::Settings;
use crate::solve::result::{CAUSES, Call, Remarks, Solution, Status, Uniqueness};
use crate::solve::rigid::{RigidMotions, escape, is_held_by_rounding, moves_freely};

/// The sentence on bodies that move away if the rounding of a condensation counts as no resistance.
const ROUNDING: &str = "if K is condensed, nothing but its rounding resists a motion that the loads drive: solve it as a \
                        model, which takes that rounding for none";

/// Adds the remarks on the data of a problem and what its solution passes, in the sentence of the solution too.
pub fn remark_on_data<R: Relation>(
    problem: &ContactProblem<'_, R>,
    settings: &Settings,
    solution: &mut Solution,
) {
    let gaps_passed = gaps_passed(problem, settings, solution);
    solution.remarks = Remarks { gaps_passed, ..of_data(problem, &solution.d) };
    say_remarks(problem, solution);
}

/// The remarks on the data of a problem with the displacements `d`. Gaps that are no more than rounding beside them
/// may have any sign.
fn of_data<R: Relation>(problem: &ContactProblem<'_, R>, d: &[f64]) -> Remarks {
    let deepest = deepest_of_negative_gaps(problem);
    Remarks {
        gaps_negative: deepest.is_some_and(|deepest| deepest > NEGLIGIBLE * norm_inf(d)),
        friction_large: friction_is_large(problem.law()),
        ..Remarks::default()
    }
}

/// True if a solution has a penetration that is not small beside the gaps.
fn gaps_passed<R: Relation>(
    problem: &ContactProblem<'_, R>,
    settings: &Settings,
    solution: &Solution,
) -> bool {
    let at = (&solution.d[..], solution.certificate.penetration);
    solution.status == Status::Solved && passes_gaps(problem, at, settings.tolerance)
}

/// Says the remarks on a solution in its sentence.
pub fn say_remarks<R: Relation>(problem: &ContactProblem<'_, R>, solution: &mut Solution) {
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
        (remarks.gaps_passed, passed(problem, solution)),
    ];
    for (_, sentence) in sentences.iter().filter(|(said, _)| *said) {
        solution.say(&format!("remark: {sentence}"));
    }
}

/// The sentence on a penetration that is not small beside the gaps.
fn passed<R: Relation>(problem: &ContactProblem<'_, R>, solution: &Solution) -> String {
    let penetration = solution.certificate.penetration;
    let share = penetration / size_of_gaps(problem, &solution.d);
    format!(
        "the penetration {penetration:.1e} is {share:.1e} of the largest gap or normal displacement, and forces may be wrong, as \
         bodies are soft beside the loads: ask for a smaller tolerance, or make them stiffer"
    )
}

/// Adds the remarks on a problem and its solution. With friction nothing is asked about free motions: that would cost a
/// factorisation of every semi-definite problem.
pub fn add_remarks(call: &Call<'_>, solution: &mut Solution) {
    let (contact, problem) = (call.contact, call.contact.problem());
    let solved = solution.status == Status::Solved;
    let asked = solved && solution.uniqueness == Uniqueness::NotKnown && contact.is_frictionless();
    let Solution { d, certificate, definite, .. } = &*solution;
    let at = (d.as_slice(), certificate.states.as_slice());
    solution.remarks = Remarks {
        free_motion: asked && moves_freely(contact, at, definite, call.monitor),
        held_by_rounding: solved && is_held_by_rounding(contact, d, &certificate.force),
        needs_low_part: solved && needs_low_part(call, solution),
        gaps_passed: gaps_passed(problem, call.settings, solution),
        ..of_data(problem, d)
    };
    if solution.status == Status::Stalled && problem.is_symmetric() {
        explain(call, solution);
    }
}

/// Adds to the sentence of a problem that is not solved what to look at, if contact alone holds a body, or if nothing but
/// rounding may hold one: there may be no equilibrium.
fn explain(call: &Call<'_>, solution: &mut Solution) {
    let (problem, monitor) = (call.contact.problem(), call.monitor);
    if solution.escape.is_none() && RigidMotions::of(problem, monitor).is_some() {
        solution.say(&format!("contact alone holds a body: {CAUSES}"));
    }
    if escape(&Contact::new(&problem.condensed_by_host()), monitor).is_some() {
        solution.say(ROUNDING);
    }
}

/// True if the displacements rounded to doubles miss the tolerance.
fn needs_low_part(call: &Call<'_>, solution: &Solution) -> bool {
    let (certificate, tolerance) = (&solution.certificate, call.settings.tolerance);
    let may_miss = certificate.residual + certificate.rounding > tolerance;
    may_miss
        && solution.d_low.iter().any(|&low| low != 0.0)
        && !measure(call.contact, (&solution.d, &[]), &certificate.force).holds(tolerance)
}
