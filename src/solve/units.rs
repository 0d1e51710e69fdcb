//! Results of problems that were solved in other units than those of the host.

use super::result::{Escape, Existence, SecondSolution, Solution, Status, Uniqueness};
use crate::certificate::{Certificate, measure};
use crate::law::Contact;
use crate::problem::{ContactProblem, Relation, Units};
use crate::settings::Settings;

/// The sentence on a result of which the host's units hold no digits.
const OUT_OF_RANGE: &str = "solved, but displacements or forces in these units are beyond doubles, or so small that \
                            doubles lose their digits: use units that are nearer to the problem's sizes";

/// The result in the host's units; `problem` is in those of the result. Displacements and forces that lose digits there, or
/// are beyond doubles, are measured again on it.
pub fn to_host<R: Relation>(
    mut solution: Solution,
    units: Units,
    settings: &Settings,
    problem: &ContactProblem<'_, R>,
) -> Solution {
    let (contact, tolerance) = (Contact::new(problem), settings.tolerance);
    let turn = |d: &mut [f64], low: &mut [f64], certificate: &mut Certificate| {
        let kept = units.length.keeps(d)
            && units.length.keeps(low)
            && units.force.keeps(&certificate.force);
        let own = certificate.to_host(units);
        d.iter_mut().chain(low.iter_mut()).for_each(|d| *d = units.length.host(*d));
        let again = || {
            let (d, low) = (units.length.all(d)?, units.length.all(low)?);
            Some(measure(&contact, (&d, &low), &units.force.all(&own.force)?))
        };
        let measured = if kept { None } else { again() };
        *certificate = measured.map_or(own, |new| new.with_rounding(tolerance).to_host(units));
    };
    let Solution { d, d_low, certificate, .. } = &mut solution;
    turn(d, d_low, certificate);
    if solution.status == Status::Solved && !solution.certificate.holds(tolerance) {
        (solution.status, solution.message) = (Status::Stalled, OUT_OF_RANGE.into());
        (solution.uniqueness, solution.existence) = (Uniqueness::NotKnown, Existence::NotProved);
        solution.second = None;
    }
    solution.change_second(tolerance, |SecondSolution { d, d_low, certificate, .. }| {
        turn(d, d_low, certificate);
    });
    if let Existence::Proved(proof) = &mut solution.existence {
        **proof = proof.to_host(units);
    }
    if let Some(Escape { unbalanced, .. }) = &mut solution.escape {
        unbalanced.iter_mut().for_each(|force| *force = units.force.host(*force));
    }
    solution
}
