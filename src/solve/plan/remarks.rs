//! Remarks: data that are legal and often a mistake of the host, and what a host should know of a solution, are named
//! beside the result, never refused.

use crate::certificate::measure;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::result::{CAUSES, Remarks, Solution, Status, Uniqueness, of_problem};
use crate::solve::rigid::{RigidMotions, escape, is_held_by_rounding, moves_freely};

/// The sentence on bodies that move away if the rounding of a condensation counts as no resistance.
const ROUNDING: &str = "if K is condensed, nothing but its rounding resists a motion that the loads drive: solve it as a \
                        model, which takes that rounding for none";

/// Adds the remarks on a problem and its solution. With friction nothing is asked about free motions: that would cost a
/// factorisation of every semi-definite problem.
pub fn add_remarks(
    contact: &Contact<'_>,
    settings: &Settings,
    solution: &mut Solution,
    monitor: &Monitor<'_>,
) {
    let problem = contact.problem();
    let solved = solution.status == Status::Solved;
    let asked = solved && solution.uniqueness == Uniqueness::NotKnown && contact.is_frictionless();
    let (d, certificate) = (&solution.d, &solution.certificate);
    solution.remarks = Remarks {
        free_motion: asked && moves_freely(contact, d, &certificate.states, monitor),
        held_by_rounding: solved && is_held_by_rounding(contact, d, &certificate.force),
        needs_low_part: solved && needs_low_part(contact, settings, solution),
        ..of_problem(problem, d)
    };
    if solution.status == Status::Stalled && problem.is_symmetric() {
        explain(contact, solution, monitor);
    }
}

/// Adds to the sentence of a problem that is not solved what to look at, if contact alone holds a body, or if nothing but
/// rounding may hold one: there may be no equilibrium.
fn explain(contact: &Contact<'_>, solution: &mut Solution, monitor: &Monitor<'_>) {
    let problem = contact.problem();
    if solution.escape.is_none() && RigidMotions::of(problem, monitor).is_some() {
        let said = solution.message.marked();
        solution.message = format!("{said}; contact alone holds a body: {CAUSES}").into();
    }
    if escape(&Contact::new(&problem.condensed_by_host()), monitor).is_some() {
        let said = solution.message.marked();
        solution.message = format!("{said}; {ROUNDING}").into();
    }
}

/// True if the displacements rounded to doubles miss the tolerance.
fn needs_low_part(contact: &Contact<'_>, settings: &Settings, solution: &Solution) -> bool {
    let certificate = &solution.certificate;
    let may_miss = certificate.residual + certificate.rounding > settings.tolerance;
    may_miss
        && solution.d_low.iter().any(|&low| low != 0.0)
        && !measure(contact, &solution.d, &certificate.force).holds(settings.tolerance)
}
