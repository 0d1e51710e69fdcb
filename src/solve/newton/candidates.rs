//! Candidate elimination: pairs that are surely open leave the equations by one Cholesky factorisation.
//!
//! After the sweeps the set of open pairs is nearly final. With `O` the pairs that are far from contact
//! and `C` the candidates, `K_OO d_O + K_OC d_C = f_O` holds as long as `O` stays open, so that the
//! contact problem on `C` alone has the matrix `S = K_CC - K_CO K_OO⁻¹ K_OC`. It is solved with all
//! states allowed. If a pair of `O` then penetrates, it joins `C`, and the problem is solved again: this
//! ends, as each pass adds pairs. Where the search opens many of `C`, as on beams, which sweeps hardly move, the next
//! candidates are those of the point that it has reached; that happens a few times at most. The result is measured on the
//! whole problem.
//!
//! *Series.* The eliminated pairs depend on the matrix and on which pairs are open, not on the loads. Where the pairs
//! that an earlier problem with the same matrix has eliminated are open in this one too, the contact problem on its
//! candidates is at hand: sweeps are sweeps on them, and the search is one on a part of the pairs. If pairs outside close,
//! the candidates of both problems are the next ones, so that a series in which the contact rocks soon has candidates
//! for all of it. Where that fails the problem is solved as one that stands alone. The problem on the candidates remembers in
//! the same way what it has worked out.

use std::sync::Arc;

use super::before::Kept;
use super::descent::PATIENCE;
use super::ended::Ended;
use super::iteration::OPEN;
use super::start::swept;
use crate::law::{Piece, Vector};
use crate::monitor::Stop;
use crate::problem::Remembered;
use crate::solve::part::{ReducedProblem, closed_with_margin, many_are_open};
use crate::solve::pieces::{Equations, Point};
use crate::solve::result::{Call, Candidate, Ending};

/// Why there is no start.
pub(super) const OVERFLOW: Ending = Ending::Stalled("the forces are beyond the largest number");

/// Candidates are too many, which costs more than a new elimination, above so many times those that a
/// problem needs.
const TOO_MANY: f64 = 1.6;

/// A solver of equations from given coordinates to a tolerance. It may end with [`OPEN`] where it is told so.
pub type Core<'c> = dyn FnMut(&Equations<'_>, (Vec<Vector>, bool)) -> Ended + 'c;

/// Solves a problem: sweeps, then `core` on the candidates.
pub fn solve(call: &Call<'_>, core: &mut Core<'_>) -> Candidate {
    let contact = call.contact;
    let whole = Equations::of(contact);
    let remembered = contact.problem().remembered();
    // Nothing is left of a problem that is not solved.
    let before = remembered.and_then(Remembered::take::<Kept>);
    let mut search = Search { call, core, is_series: remembered.is_some(), left: PATIENCE };
    let begun = before.and_then(|before| begun(call, &whole, &before));
    let mut spent = 0;
    let mut found = begun.and_then(|(reduced, y)| {
        let found = search.on(&whole, Some(reduced), y);
        spent = found.systems;
        matches!(found.ending, Ending::Done | Ending::Stopped(_)).then_some(found)
    });
    if found.is_none() {
        let Some(y) = swept(&whole, call.start, call.monitor) else {
            return Candidate::without_displacements(contact, OVERFLOW);
        };
        search.left = PATIENCE;
        let alone = search.on(&whole, None, y);
        found = Some(Ended { systems: spent + alone.systems, ..alone });
    }
    found.expect("the problem alone has ended").into_candidate()
}

/// The problem reduced as an earlier one, and coordinates of which those of the candidates come from sweeps on them;
/// `None` if the candidates do not fit.
fn begun<'w>(
    call: &Call<'_>,
    whole: &'w Equations<'w>,
    before: &Kept,
) -> Option<(ReducedProblem<'w>, Vec<Vector>)> {
    let reduced = ReducedProblem::by_elimination(whole, &before.elimination)?;
    let start: Option<Vec<f64>> = call.start.map(|start| reduced.restrict(start));
    let equations = reduced.equations();
    let own = swept(&equations, start.as_deref(), call.monitor)?;
    let needed = closed_with_margin(&equations.laws, &own).len();
    let fits = own.len() as f64 <= TOO_MANY * needed as f64;
    drop(equations);
    let mut y = vec![[0.0; 3]; whole.laws.len()];
    reduced.kept().zip(own).for_each(|(pair, own)| y[pair] = own);
    fits.then_some((reduced, y))
}

/// A search on candidates.
struct Search<'s, 'c> {
    call: &'s Call<'s>,
    core: &'s mut Core<'c>,
    /// True if the candidates of other problems stay among those of this one.
    is_series: bool,
    /// How many times the core may end with [`OPEN`].
    left: usize,
}

impl Search<'_, '_> {
    /// Solves the equations from the coordinates `y`: by the core on the candidates there, first on those of `reduced` if
    /// it is given, and on more of them as long as others close.
    fn on<'w>(
        &mut self,
        whole: &'w Equations<'w>,
        mut reduced: Option<ReducedProblem<'w>>,
        mut y: Vec<Vector>,
    ) -> Ended {
        let mut kept = Vec::new();
        let (mut systems, mut orientation) = (0, 0);
        loop {
            let on_part = match reduced.take() {
                Some(reduced) => Ok(Some(reduced)),
                None => self.widened(whole, &mut kept, &y),
            };
            let part = match on_part {
                Ok(Some(part)) => part,
                Ok(None) => {
                    let found = (self.core)(whole, (y, self.left > 0));
                    systems += found.systems;
                    if found.ending != OPEN {
                        return Ended { systems, ..found };
                    }
                    self.left -= 1;
                    (kept, y) = (Vec::new(), found.y);
                    continue;
                }
                Err(stop) => {
                    let at = Ended::at(Point::new(whole, y), Ending::Stopped(stop));
                    return Ended { systems, orientation, ..at };
                }
            };
            kept = part.kept().collect();
            let of_candidates = Remembered::default();
            let remembered = whole.remembered.map(|_| &of_candidates);
            let equations = Equations { remembered, ..part.equations() };
            let found = self.on_part(&equations, part.kept().map(|pair| y[pair]).collect());
            drop(equations);
            systems += found.systems;
            if found.orientation != 0 {
                orientation = found.orientation;
            }
            let (d, force);
            (d, force, y) = part.whole_from(&found.d, &found.y);
            let done = found.ending == Ending::Done;
            let solved = done && whole.eta(&d, &force) <= self.call.settings.tolerance;
            let is_last = !done || solved || part.closing(&y).is_empty();
            let ending = found.ending;
            if is_last {
                if let Some(remembered) = whole.remembered
                    && matches!(ending, Ending::Done | Ending::Stopped(_))
                {
                    let elimination = Arc::clone(&part.elimination);
                    remembered.leave(Kept { elimination, of_candidates });
                }
                return Ended { d, force, y, ending, systems, orientation };
            }
        }
    }

    /// Solves the equations of candidates. Those of a series may be too many for one problem, and so may those that sweeps
    /// leave closed in the plane.
    fn on_part(&mut self, equations: &Equations<'_>, y: Vec<Vector>) -> Ended {
        let is_series = std::mem::take(&mut self.is_series);
        if equations.dim > 2 && !is_series {
            return (self.core)(equations, (y, false));
        }
        let found = self.on(equations, None, y);
        self.is_series = is_series;
        found
    }

    /// The problem on the candidates at the coordinates `y` and on the pairs that were `kept` before, unless a series has
    /// too many of these, with all others open; as [`ReducedProblem::new`].
    fn widened<'w>(
        &self,
        whole: &'w Equations<'w>,
        kept: &mut Vec<usize>,
        y: &[Vector],
    ) -> Result<Option<ReducedProblem<'w>>, Stop> {
        // In the plane one factor serves many systems: less is saved.
        if whole.dim == 2 && !many_are_open(&whole.pieces(y)) {
            return Ok(None);
        }
        let needed = closed_with_margin(&whole.laws, y);
        kept.extend(&needed);
        kept.sort_unstable();
        kept.dedup();
        if self.is_series && kept.len() as f64 > TOO_MANY * needed.len() as f64 {
            *kept = needed;
        }
        let mut held = vec![Some(Piece::OPEN); y.len()];
        kept.iter().for_each(|&pair| held[pair] = None);
        ReducedProblem::new(whole, &held, self.call.monitor)
    }
}
