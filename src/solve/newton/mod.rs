//! Newton's method on the normal map (`law::normal_map`): one equation for open, stick and slip, in the
//! plane and in space, with the exact friction disc.
//!
//! Some sweeps (`start`), then Newton's method with a line search (`iteration`). In the plane one factor serves many systems;
//! in space the pairs that are surely open are eliminated first, and problems that share a matrix share what is eliminated
//! (`candidates`).

mod candidates;
mod descent;
mod iteration;
mod polish;
mod question;
mod start;
mod uncertain_pairs;

pub use candidates::solve as on_candidates;
pub use descent::{AIM, Goal, Halt, NewtonOutcome, NormalMap, solve as descend};
pub use iteration::{Ended, solve as newton_from};
pub use polish::{FullyRefined, ROUNDING_OF_ETA, refine_fully, refine_to_tolerance};
pub use uncertain_pairs::{PartOutcome, solve_part};

use crate::law::{Contact, Piece};
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::pieces::Equations;
use crate::solve::result::Candidate;

/// Solves from the displacements `start` (zero if `None`) by Newton's method.
pub fn newton(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    if contact.dim() == 2 {
        let equations = Equations::of(contact);
        let y = start::swept(&equations, start, monitor);
        if !y.iter().flatten().all(|y| y.is_finite()) {
            return Candidate::without_displacements(contact, candidates::OVERFLOW);
        }
        return iteration::solve(&equations, y, settings.tolerance, monitor).into_candidate();
    }
    on_candidates(contact, settings, start, monitor, &mut |equations, y, monitor| {
        iteration::solve(equations, y, settings.tolerance, monitor)
    })
}

/// Solves in the plane from the solution on given pieces; `d` is returned unchanged if that cannot be had.
pub fn from_pieces(
    contact: &Contact<'_>,
    settings: &Settings,
    pieces: &[Piece],
    d: &[f64],
    monitor: &mut Monitor<'_>,
) -> Candidate {
    match iteration::from_pieces(&Equations::of(contact), pieces, settings.tolerance, monitor) {
        Ok(ended) => ended.into_candidate(),
        Err(ending) => Candidate::of_displacements(contact, d.to_vec(), ending),
    }
}
