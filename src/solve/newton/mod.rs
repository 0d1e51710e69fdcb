//! Newton's method on the normal map (`law::normal_map`): one equation for open, stick and slip, in the
//! plane and in space, with the exact friction disc.
//!
//! Some sweeps (`start`), then Newton's method with a line search (`iteration`). The pairs that are surely open are eliminated
//! first (`candidates`). Problems that share a matrix share what is eliminated, and in space the factor of the solution before
//! (`before`). In the plane one factor serves many systems: what starts at a solution needs no elimination. Pairs that are far
//! stiffer along one tangent than along the other are first solved on tangents along which they are as stiff (`levelled`).

mod before;
mod candidates;
mod descent;
mod ended;
mod iteration;
mod levelled;
mod one_pair;
mod polish;
mod start;
mod uncertain_pairs;

pub use candidates::solve as on_candidates;
pub use descent::{AIM, Goal, NewtonOutcome, NormalMap, ROUNDING_OF_ETA, solve as descend};
pub use ended::Ended;
pub use iteration::{from_pieces, solve as newton_from};
pub use one_pair::solve as of_one_pair;
pub use polish::{FullyRefined, refine_fully, refine_to_tolerance};
pub use uncertain_pairs::solve_part;

use crate::solve::pieces::Equations;
use crate::solve::result::{Call, Candidate, Ending};

/// Solves a problem by Newton's method.
pub fn newton(call: &Call<'_>) -> Candidate {
    if let Some(found) = one_pair::solve(call) {
        return found;
    }
    let (contact, settings) = (call.contact, call.settings);
    let in_space = contact.dim() > 2;
    let is_series = contact.problem().remembered().is_some();
    // From nothing, beams with open pairs are solved on their candidates alone.
    if !in_space && is_series && call.start.is_some() {
        let whole = Equations::of(contact);
        let overflown = || Candidate::without_displacements(contact, candidates::OVERFLOW);
        return iteration::solve_in_plane(call, &whole).unwrap_or_else(overflown);
    }
    let tolerance = settings.tolerance;
    let core: &mut candidates::Core<'_> = &mut |equations, (y, leaves_open)| {
        iteration::solve(call, equations, y, !in_space && leaves_open)
    };
    let start = call.start.filter(|_| is_series);
    let again = start.and_then(|start| before::again(call, &Equations::of(contact), start));
    let near = match again {
        Some(found) if found.ending == Ending::Done => return found.into_candidate(),
        again => again.map(|found| found.d),
    };
    let call = &near.as_deref().map_or(*call, |d| call.from(d));
    let levelled = if in_space { levelled::solve(call, core) } else { None };
    match levelled {
        None => on_candidates(call, core),
        // A series goes on from the equations of its own tangents.
        Some(found) if !is_series && found.certificate(contact).eta <= AIM * tolerance => found,
        Some(found) => {
            let mut candidate = on_candidates(&call.from(found.d()), core);
            candidate.effort.factorisations += found.effort.factorisations;
            candidate
        }
    }
}
