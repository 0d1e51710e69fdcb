//! Newton's method, and what follows where it fails: the dense problem of the pairs that may touch, then problems
//! with given thresholds.

use super::newton::{self, Outcome};
use super::point::{Displacements, Equations};
use super::session::Session;
use super::{condensed, thresholds};
use crate::error::Error;
use crate::monitor::Monitor;
use crate::solve::newton::Halt;
use crate::solve::result::Ending;

/// Solves from displacements whose inner ones are in equilibrium.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut Session<'_>,
    start: &Displacements,
    tolerance: f64,
    monitor: &mut Monitor<'_>,
) -> Result<Outcome, Error> {
    let point = equations.held_at(start.clone(), bodies)?;
    let mut best = newton::solve(equations, bodies, point, tolerance, monitor)?;
    for attempt in [condensed::solve, thresholds::solve] {
        if !matches!(best.ending, Ending::Stalled(_)) || !best.point.merit.is_finite() {
            break;
        }
        match attempt(equations, bodies, start, &mut best, tolerance, monitor) {
            Ok(()) => {}
            Err(Halt::Ended(ending)) => best.ending = ending,
            Err(Halt::Failed(error)) => return Err(error),
        }
    }
    Ok(best)
}
