//! Where Newton's method fails: Coulomb's law as a sequence of problems with given thresholds (paper, section 2.1,
//! `g <- mu |F_n|`), each by Newton's method, which has one solution to find then, and Newton's method for the law
//! itself from where each of them ends.

use super::newton::{self, Ended, Goal};
use super::point::{Displacements, Equations, Point};
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::problem::{Bodies, Unformed};
use crate::solve::candidate::Ending;

/// Most problems with given thresholds.
const ROUNDS: usize = 4;

/// What is asked of one: its solution is a start alone.
const ROUGH: Goal = Goal { tolerance: 1e-3, systems: newton::MOST_SYSTEMS };

/// Goes on from a first try that has failed; `start` has its inner unknowns in equilibrium.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    start: Displacements,
    mut best: Ended,
    goal: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    let mut point = equations.held_at(start, bodies)?;
    let mut held = best.held.take();
    for _ in 0..ROUNDS {
        let mut contact: Contact<'_, Unformed<'_>> = equations.contact.clone();
        contact.set_thresholds(&thresholds(equations, &point));
        let given = equations.with(&contact);
        let from = given.held_at(point.at, bodies)?;
        let between = newton::solve(&given, bodies, from, held, ROUGH, monitor)?;
        if let Ending::Stopped(_) = between.ending {
            best.ending = between.ending;
            break;
        }
        point = equations.held_at(between.point.at.clone(), bodies)?;
        let from = equations.held_at(between.point.at, bodies)?;
        let next = newton::solve(equations, bodies, from, between.held, goal, monitor)?;
        held = next.held.clone();
        let is_settled = !matches!(next.ending, Ending::Stalled(_));
        if is_settled || next.point.eta < best.point.eta {
            best = next;
        }
        if is_settled {
            break;
        }
    }
    Ok(best)
}

/// What the pairs can carry along their tangents under the forces at a point.
fn thresholds(equations: &Equations<'_>, point: &Point) -> Vec<f64> {
    let (d, forces) = (&point.at.x[equations.inner..], &point.residual[equations.inner..]);
    equations.contact.each(d, forces).map(|(law, _, force)| law.threshold(force[0])).collect()
}
