//! Results of problems that were solved in other units than those of the host.

use super::result::{Escape, Existence, SecondSolution, Solution, Status, Uniqueness};
use crate::certificate::Certificate;
use crate::problem::Units;

/// The sentence on a result of which the host's units hold no digits.
const OUT_OF_RANGE: &str = "solved, but displacements or forces in these units are beyond doubles, or so small that \
                            doubles lose their digits: use units that are nearer to the problem's sizes";

/// The result in the host's units. Displacements and forces that lose digits there, or are beyond doubles, are measured again by `certify`,
/// which takes `d`, `d_low` and the contact forces in the units of the solution.
pub fn to_host(
    mut solution: Solution,
    units: Units,
    tolerance: f64,
    certify: impl Fn(&[f64], &[f64], &[f64]) -> Certificate,
) -> Solution {
    let point = Point { d: solution.d, low: solution.d_low, certificate: solution.certificate };
    let point = point.in_host_units(units, &certify);
    if solution.status == Status::Solved && !point.certificate.holds(tolerance) {
        (solution.status, solution.message) = (Status::Stalled, OUT_OF_RANGE.into());
        (solution.uniqueness, solution.existence) = (Uniqueness::NotKnown, Existence::NotProved);
        solution.second = None;
    }
    (solution.d, solution.d_low, solution.certificate) = (point.d, point.low, point.certificate);
    if let Some(second) = solution.second.take() {
        let SecondSolution { d, d_low, certificate, orientation } = *second;
        let point = Point { d, low: d_low, certificate }.in_host_units(units, &certify);
        if point.certificate.holds(tolerance) {
            let Point { d, low: d_low, certificate } = point;
            solution.second = Some(Box::new(SecondSolution { d, d_low, certificate, orientation }));
        } else {
            solution.uniqueness = Uniqueness::NotKnown;
        }
    }
    if let Existence::Proved(proof) = &mut solution.existence {
        **proof = proof.to_host(units);
    }
    if let Some(Escape { unbalanced, .. }) = &mut solution.escape {
        unbalanced.iter_mut().for_each(|force| *force = units.host_force(*force));
    }
    solution
}

/// Displacements and their certificate.
struct Point {
    d: Vec<f64>,
    low: Vec<f64>,
    certificate: Certificate,
}

impl Point {
    fn in_host_units(
        self,
        units: Units,
        certify: &impl Fn(&[f64], &[f64], &[f64]) -> Certificate,
    ) -> Self {
        let lengths = |d: &[f64]| d.iter().map(|&d| units.host_length(d)).collect::<Vec<_>>();
        let (d, low) = (lengths(&self.d), lengths(&self.low));
        let force = self.certificate.to_host(units).force;
        let kept = units.keeps_lengths(&self.d)
            && units.keeps_lengths(&self.low)
            && units.keeps_forces(&self.certificate.force);
        let again =
            || Some(certify(&units.lengths(&d)?, &units.lengths(&low)?, &units.forces(&force)?));
        let measured = if kept { None } else { again() };
        Point { certificate: measured.unwrap_or(self.certificate).to_host(units), d, low }
    }
}
