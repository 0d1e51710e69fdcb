//! Frictionless contact by sweeps on the normal displacements.

use super::Iterate;
use super::driver::{Driver, LARGEST_FACTOR};
use super::lcp_iterate::LcpIterate;
use crate::monitor::Monitor;
use crate::solve::part::NormalProblem;
use crate::solve::result::{Call, Candidate, Effort, Ending};

/// The condensed problem has another scale of forces than the whole one, whose certificate decides: the
/// target is tightened by this factor until that holds, or no rounding can reach it.
const TIGHTENING: f64 = 0.1;

/// Solves a problem.
pub fn frictionless(call: &Call<'_>, monitor: &mut Monitor<'_>) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let normal = match NormalProblem::new(contact, monitor) {
        Ok(normal) => normal,
        Err(why) => return Candidate::without_displacements(contact, why),
    };
    let start = normal.restrict(&call.start_or_zero()).iter().map(|d| -d).collect();
    let iterate = LcpIterate::new(normal.lcp(), start);
    let mut driver = Driver::new(iterate, settings, LARGEST_FACTOR, monitor);
    let mut target = settings.tolerance;
    loop {
        let ending = match driver.solve(target) {
            Ok(()) => Ending::Done,
            Err(Ending::Recession(motion)) => Ending::Recession(normal.follow(&motion)),
            Err(other) => other,
        };
        let d = normal.expand(driver.iterate.unknowns());
        let mut candidate = Candidate::of_displacements(contact, d, ending);
        candidate.effort = Effort { omega: driver.relaxation.omega, ..Effort::default() };
        let done = candidate.ending != Ending::Done
            || candidate.certificate(contact).holds(settings.tolerance);
        if done || target < f64::EPSILON * settings.tolerance {
            return candidate;
        }
        target *= TIGHTENING;
    }
}
