//! Newton's method on the normal map (`law::normal_map`): one equation for open, stick and slip, in the
//! plane and in space, with the exact friction disc.
//!
//! Some sweeps (`start`), then the pairs that are surely open are eliminated (`candidates`), then Newton's method
//! with a line search on what is left (`newton`). Problems that share a matrix share what is eliminated
//! (`series`). In the plane the active-set method takes fewer systems and is used instead.

mod candidates;
mod equations;
mod newton;
mod polish;
mod series;
mod start;
mod system;

pub use equations::{Equations, Point};
pub use newton::{Ended, solve as newton_from};
pub use polish::{Sharpened, polished, sharpened};
pub use series::solve as on_candidates;
pub use system::{Border, System};

use crate::law::Contact;
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::candidate::Candidate;

/// Solves from the displacements `start` (zero if `None`) by Newton's method.
pub fn newton(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    on_candidates(contact, settings, start, monitor, &mut |equations, y, monitor| {
        newton::solve(equations, y, settings.tolerance, monitor)
    })
}
