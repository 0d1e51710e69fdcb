//! Results of problems that were solved in other units than those of the host.

use super::result::{Escape, Existence, SecondSolution, Solution, Status, Uniqueness};
use crate::certificate::Certificate;
use crate::problem::Units;

/// The sentence on a result of which the host's units hold no digits.
const OUT_OF_RANGE: &str = "solved, but displacements or forces in these units are beyond doubles, or so small that \
                            doubles lose their digits: use units that are nearer to the problem's sizes";

/// The result in the host's units. Displacements and forces that lose digits there, or are beyond doubles, are measured
/// again by `certify`, which takes `d`, `d_low` and the contact forces in the units of the solution.
pub fn to_host(
    mut solution: Solution,
    units: Units,
    tolerance: f64,
    certify: impl Fn(&[f64], &[f64], &[f64]) -> Certificate,
) -> Solution {
    let Solution { d, d_low, certificate, .. } = &mut solution;
    point_to_host(units, (d, d_low, certificate), &certify);
    if solution.status == Status::Solved && !solution.certificate.holds(tolerance) {
        (solution.status, solution.message) = (Status::Stalled, OUT_OF_RANGE.into());
        (solution.uniqueness, solution.existence) = (Uniqueness::NotKnown, Existence::NotProved);
        solution.second = None;
    }
    solution.change_second(tolerance, |SecondSolution { d, d_low, certificate, .. }| {
        point_to_host(units, (d, d_low, certificate), &certify);
    });
    if let Existence::Proved(proof) = &mut solution.existence {
        **proof = proof.to_host(units);
    }
    if let Some(Escape { unbalanced, .. }) = &mut solution.escape {
        unbalanced.iter_mut().for_each(|force| *force = units.force.host(*force));
    }
    solution
}

/// Turns displacements in two parts and their certificate into the host's units.
fn point_to_host(
    units: Units,
    (d, low, certificate): (&mut [f64], &mut [f64], &mut Certificate),
    certify: &impl Fn(&[f64], &[f64], &[f64]) -> Certificate,
) {
    let kept =
        units.length.keeps(d) && units.length.keeps(low) && units.force.keeps(&certificate.force);
    let own = certificate.to_host(units);
    d.iter_mut().chain(low.iter_mut()).for_each(|d| *d = units.length.host(*d));
    let again = || {
        Some(certify(&units.length.all(d)?, &units.length.all(low)?, &units.force.all(&own.force)?))
    };
    let measured = if kept { None } else { again() };
    *certificate = measured.map_or(own, |measured| measured.to_host(units));
}
