//! The search for a second solution.

use super::difference::{are_different, are_parted};
use crate::error::Error;
use crate::law::{Contact, PairLaw, Piece};
use crate::solve::newton::{FullyRefined, from_pieces, refine_fully};
use crate::solve::result::{Call, Candidate, Ending, SecondSolution};
use crate::solve::{lcp, path};

/// Pairs whose piece is changed, one at a time: four runs of Newton's method for each, which is what
/// the rest of the search costs for a hundred pairs.
const NEIGHBOURS: usize = 32;

/// A solution other than `known`, if one is found. In the plane: by Newton's method from all pairs sticking, open or
/// slipping and from pieces next to the known ones, and by Lemke's with several starts and from where its path turns. In
/// space: at the ends of paths from several starts.
pub fn another(call: &Call<'_>, known: &FullyRefined) -> Result<Option<SecondSolution>, Error> {
    if call.monitor.goes_on().is_err() {
        return Ok(None);
    }
    let is_planar = call.contact.dim() == 2;
    let d = known.candidate.d();
    for pieces in if is_planar { starts(call.contact, d) } else { Vec::new() } {
        if call.monitor.is_late() {
            return Ok(None);
        }
        let candidate = from_pieces(&call.from(d), &pieces);
        let other = accepted(call, known, candidate);
        if other.is_some() {
            return Ok(other);
        }
    }
    let ends = match is_planar {
        true => lcp::lemke_ends(call)?,
        false => path::ends(call),
    };
    let mut others = ends.into_iter();
    Ok(others.find_map(|candidate| accepted(call, known, candidate)))
}

/// A candidate that is a solution other than `known`; none if there is no time for the question.
fn accepted(call: &Call<'_>, known: &FullyRefined, candidate: Candidate) -> Option<SecondSolution> {
    let (contact, settings) = (call.contact, call.settings);
    let may_be = candidate.ending == Ending::Done
        && !call.monitor.is_late()
        && candidate.certificate(contact).holds(settings.tolerance)
        && are_different(contact, known.candidate.d(), candidate.d());
    let other = if may_be { refine_fully(call, &candidate)? } else { return None };
    let is_other = are_parted(contact, known, &other)
        && other.candidate.certificate(contact).holds(settings.tolerance);
    let found = other.candidate;
    is_other.then(|| SecondSolution {
        certificate: found.certificate(contact).clone(),
        orientation: found.orientation,
        d_low: found.low_part(),
        d: found.d().to_vec(),
    })
}

/// All pairs open, all slipping to either side, all sticking; and the pieces of a solution with that of one pair changed,
/// of the first pairs.
fn starts(contact: &Contact<'_>, known: &[f64]) -> Vec<Vec<Piece>> {
    let all = |piece: &dyn Fn(&PairLaw) -> Piece| contact.pairs().iter().map(piece).collect();
    let here = contact.pieces(known, &contact.problem().force(known));
    let mut starts = vec![
        all(&|_| Piece::OPEN),
        all(&|law| law.slip(1)),
        all(&|law| law.slip(-1)),
        all(&PairLaw::stick),
    ];
    for (pair, law) in contact.pairs().iter().enumerate().take(NEIGHBOURS) {
        for piece in law.planar_pieces().into_iter().filter(|piece| *piece != here[pair]) {
            let mut pieces = here.clone();
            pieces[pair] = piece;
            starts.push(pieces);
        }
    }
    starts
}
