//! The search for a second solution.

use super::difference::{are_different, are_parted};
use crate::error::Error;
use crate::law::branch::Branch;
use crate::law::{Contact, PairLaw};
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::active_set::from_branches;
use crate::solve::candidate::{Candidate, Ending, low_part};
use crate::solve::normal_map::{Sharpened, sharpened};
use crate::solve::outcome::SecondSolution;
use crate::solve::{lemke, path};

/// Pairs whose branch is changed, one at a time: four runs of Newton's method for each, which is what
/// the rest of the search costs for a hundred pairs.
const NEIGHBOURS: usize = 32;

/// A solution other than `known` in the plane, if one is found: by Newton's method from all pairs sticking, open
/// or slipping, by Lemke's with several starts and from where its path turns, and by Newton's from
/// branches next to the known ones.
pub fn another(
    contact: &Contact<'_>,
    settings: &Settings,
    known: &Sharpened,
    monitor: &mut Monitor<'_>,
) -> Result<Option<SecondSolution>, Error> {
    let accepted =
        |candidate, monitor: &Monitor<'_>| accepted(contact, settings, known, candidate, monitor);
    for branches in starts(contact) {
        if monitor.is_late() {
            return Ok(None);
        }
        let d = vec![0.0; contact.unknowns()];
        let candidate = from_branches(contact, settings, branches, d, monitor);
        if let Some(other) = accepted(candidate, monitor) {
            return Ok(Some(other));
        }
    }
    for candidate in lemke::ends(contact, settings, monitor)? {
        if let Some(other) = accepted(candidate, monitor) {
            return Ok(Some(other));
        }
    }
    for branches in neighbours(contact, &known.candidate.d) {
        if monitor.is_late() {
            break;
        }
        let d = known.candidate.d.clone();
        let candidate = from_branches(contact, settings, branches, d, monitor);
        if let Some(other) = accepted(candidate, monitor) {
            return Ok(Some(other));
        }
    }
    Ok(None)
}

/// A solution other than `known` in space, if one is found: at the ends of paths from several starts.
pub fn another_in_space(
    contact: &Contact<'_>,
    settings: &Settings,
    known: &Sharpened,
    monitor: &mut Monitor<'_>,
) -> Option<SecondSolution> {
    path::ends(contact, settings, monitor)
        .into_iter()
        .find_map(|candidate| accepted(contact, settings, known, candidate, monitor))
}

/// A candidate that is a solution other than `known`.
fn accepted(
    contact: &Contact<'_>,
    settings: &Settings,
    known: &Sharpened,
    candidate: Candidate,
    monitor: &Monitor<'_>,
) -> Option<SecondSolution> {
    let may_be = candidate.ending == Ending::Done
        && candidate.certificate(contact).holds(settings.tolerance)
        && are_different(contact, &known.candidate.d, &candidate.d);
    let other = if may_be { sharpened(contact, &candidate, monitor)? } else { return None };
    let is_other = are_parted(contact, known, &other)
        && other.candidate.certificate(contact).holds(settings.tolerance);
    let found = other.candidate;
    is_other.then(|| SecondSolution {
        certificate: found.certificate(contact).clone(),
        orientation: found.orientation,
        d_low: low_part(&found),
        d: found.d,
    })
}

/// All pairs open, all slipping to either side, all sticking.
fn starts(contact: &Contact<'_>) -> Vec<Vec<Branch>> {
    let all = |branch: &dyn Fn(&PairLaw) -> Branch| contact.pairs().iter().map(branch).collect();
    vec![
        all(&|_| Branch::OPEN),
        all(&|law| law.slip([1.0, 0.0])),
        all(&|law| law.slip([-1.0, 0.0])),
        all(&PairLaw::stick),
    ]
}

/// The branches of a solution with that of one pair changed, of the first pairs.
fn neighbours(contact: &Contact<'_>, known: &[f64]) -> Vec<Vec<Branch>> {
    let here = contact.branches(known, &contact.problem().force(known));
    let mut neighbours = Vec::new();
    for (pair, law) in contact.pairs().iter().enumerate().take(NEIGHBOURS) {
        for branch in law.planar_branches().into_iter().filter(|branch| *branch != here[pair]) {
            let mut branches = here.clone();
            branches[pair] = branch;
            neighbours.push(branches);
        }
    }
    neighbours
}
