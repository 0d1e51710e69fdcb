//! From a candidate to a result: the certificate alone decides what is called a solution.

use super::call::Call;
use super::candidate::Candidate;
use super::ending::{Ending, NO_EQUILIBRIUM};
use super::solution::{Solution, Status};
use crate::certificate::is_escape_of;
use crate::linalg::vector::{first_not_finite, normalise};
use crate::settings::Method;

/// Turns the candidate of `method` into a result.
pub fn certified(call: &Call<'_>, method: Method, candidate: Candidate) -> Solution {
    let (contact, settings) = (call.contact, call.settings);
    let mut candidate = at_rest(call, &candidate).unwrap_or(candidate);
    let certificate = candidate.take_certificate(contact).with_rounding(settings.tolerance);
    let mut recession = None;
    // A diverging iterate may itself be a recession direction.
    let motion = match &candidate.ending {
        Ending::Recession(motion) => Some(motion.as_slice()),
        Ending::RunsAway(_) | Ending::Stopped(_) => None,
        _ => certificate.runs_away().then_some(candidate.d()),
    };
    let (mut status, mut message) = candidate.ending.status(settings, &certificate);
    if status != Status::Solved
        && let Some(motion) = motion.filter(|motion| is_escape_of(contact, motion))
    {
        let mut motion = motion.to_vec();
        normalise(&mut motion);
        recession = Some(motion);
        (status, message) = (Status::NoEquilibrium, NO_EQUILIBRIUM.into());
    }
    let Candidate { d, low, effort, errors, orientation, definite, .. } = candidate;
    let mut solution = Solution {
        recession,
        errors: errors.filter(|_| status == Status::Solved),
        orientation: if status == Status::Solved { orientation } else { 0 },
        definite,
        factorisations: effort.factorisations,
        outer_iterations: effort.outer_iterations,
        refactorisations: effort.refactorisations,
        omega: effort.omega,
        damping: effort.damping,
        ..Solution::of(method, (status, message), d, certificate)
    };
    if !low.is_empty() {
        solution.d_low = low;
    }
    solution
}

/// Zero displacement, if it is the solution and the candidate is not, or if a displacement of the candidate is not
/// finite. Without loads the scale of forces is rounding only, which no iterate gets below.
fn at_rest(call: &Call<'_>, other: &Candidate) -> Option<Candidate> {
    let (contact, tolerance) = (call.contact, call.settings.tolerance);
    let is_finite = first_not_finite(other.d()).is_none();
    if is_finite && (!contact.is_unloaded() || other.certificate(contact).holds(tolerance)) {
        return None;
    }
    let mut rest = Candidate::without_displacements(contact, other.ending.clone());
    (rest.effort, rest.orientation) = (other.effort, other.orientation);
    (!is_finite || rest.certificate(contact).holds(tolerance)).then_some(rest)
}
