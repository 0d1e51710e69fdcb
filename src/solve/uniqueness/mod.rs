//! Uniqueness of a solution: proofs (`proof`), and a search for a second one (`search`).
//!
//! *Several.* Two certified solutions that differ (`difference`); or one whose orientation, the sign of the
//! determinant of its system, is −1: over all solutions the signs add up to the degree of the
//! natural map, which is +1 for positive definite `K` as it is for `mu = 0`.

mod difference;
mod existence;
mod proof;
mod search;

use super::newton::{from_pieces, refine_fully};
use super::result::{Call, Candidate, Ending, Solution, Status, Uniqueness};
use crate::error::Error;
use crate::law::Contact;
use difference::{are_different, are_parted, is_sharp, is_strict};
pub use existence::examine as prove;

/// Tries to prove that `solution` is the only one, or to find a second.
pub fn examine(call: &Call<'_>, solution: &mut Solution) -> Result<(), Error> {
    let contact = call.contact;
    if solution.status != Status::Solved || solution.second.is_some() {
        return Ok(());
    }
    if proof::is_unique(call) {
        solution.uniqueness = Uniqueness::Unique;
        return Ok(());
    }
    if contact.is_frictionless() || call.monitor.is_late() {
        return Ok(());
    }
    let mut first = given(contact, solution);
    if contact.dim() == 2 {
        // To the last digit, and with its orientation.
        let Some(own) = on_own_pieces(&call.from(&solution.d)) else { return Ok(()) };
        solution.orientation = own.orientation;
        by_orientation(call, solution);
        first = own;
    }
    let Some(first) = refine_fully(call, &first) else { return Ok(()) };
    if let Some(second) = search::another(call, &first)? {
        solution.uniqueness = Uniqueness::Several;
        solution.second = Some(Box::new(second));
    }
    Ok(())
}

/// Concludes from an orientation of −1, away from where pieces meet, that there are others; nothing if there is no
/// time.
pub fn by_orientation(call: &Call<'_>, solution: &mut Solution) {
    let contact = call.contact;
    if solution.orientation < 0
        && solution.status == Status::Solved
        && let Some(sharp) = refine_fully(call, &given(contact, solution))
        && sharp.candidate.orientation < 0
        && is_sharp(contact, &sharp)
        && is_strict(contact, sharp.candidate.d())
        && proof::scaled_factor(call).is_some()
    {
        solution.uniqueness = Uniqueness::Several;
    }
}

/// True if two results are next to two solutions; no, if there is no time for the question.
pub fn are_two(call: &Call<'_>, one: &Solution, two: &Solution) -> bool {
    let contact = call.contact;
    let sharp = |solution| refine_fully(call, &given(contact, solution));
    matches!((sharp(one), sharp(two)), (Some(one), Some(two)) if are_parted(contact, &one, &two))
}

/// A solution as a candidate that can be refined.
fn given(contact: &Contact<'_>, solution: &Solution) -> Candidate {
    Candidate::of_displacements(contact, solution.d.clone(), Ending::Done)
}

/// The solution on the pieces of the start, if that is the start.
fn on_own_pieces(call: &Call<'_>) -> Option<Candidate> {
    let (contact, d) = (call.contact, call.start_or_zero());
    let pieces = contact.pieces(&d, &contact.problem().force(&d));
    let candidate = from_pieces(call, &pieces);
    let same = candidate.ending == Ending::Done && !are_different(contact, &d, candidate.d());
    same.then_some(candidate)
}
