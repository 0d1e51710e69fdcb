//! Newton's method on an operator: its steps by GMRES.

use super::directions::{MOST_DIRECTIONS, Moved};
use super::point::{Displacements, Equations, Point};
use super::session::Session;
use super::system::{Step, System, changed};
use crate::error::Error;
use crate::law::Vector;
use crate::solve::newton::{AIM, Goal, NewtonOutcome, NormalMap, descend};
use crate::solve::result::Ending;

/// Systems with full steps: where they converge they take fewer than steps with a line search.
const FULL_STEPS: u64 = 16;

/// A linear system is solved to this part of its right side, and later to this part of `eta`, so that the last
/// steps converge quadratically (S. C. Eisenstat and H. F. Walker, *Choosing the forcing terms in an inexact
/// Newton method*, SIAM J. Sci. Comput. 17 (1996) 16-32). Where a system is solved less well, the pairs get states
/// that the pieces do not ask for: on lines of 4097 pairs .05 takes up to 17 systems, .3 more than 40.
const FORCING: f64 = 0.01;
const FORCING_OF_ETA: f64 = 0.3;

/// A factor serves while at most this part of the pairs has changed, and a quarter of the directions leaves little
/// enough; if it does not, these serve the system with the new factor.
const CHANGED: f64 = 0.02;

/// How Newton's method ended, and where.
pub type Outcome = NewtonOutcome<Point>;

/// What has been tried, with its best outcome.
pub struct Tried<'t, 'b> {
    pub equations: &'t Equations<'t>,
    pub bodies: &'t mut Session<'b>,
    /// The first displacements, inner ones in equilibrium.
    pub start: &'t Displacements,
    pub best: Outcome,
}

/// Solves from a point. The residual of the last point is measured: where products are dear it is
/// followed from step to step, has the rounding of all of them, and may hide what is left.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut Session<'_>,
    mut point: Point,
) -> Result<Outcome, Error> {
    let goal = Goal { full_steps: FULL_STEPS, ..Goal::of(equations.tolerance) };
    let monitor = bodies.monitor;
    let mut newton = Newton { equations, bodies, known: Vec::new() };
    let mut before = f64::INFINITY;
    loop {
        let mut outcome = descend(&mut newton, point, goal, monitor);
        if let Ending::Failed(error) = outcome.ending {
            return Err(error);
        }
        if !newton.bodies.follows_residuals() {
            return Ok(outcome);
        }
        let Point { at, y, .. } = outcome.point;
        outcome.point = equations.point(newton.bodies, at, y, None)?;
        let eta = outcome.point.eta;
        let is_left = outcome.ending == Ending::Done && eta > equations.tolerance;
        if !(is_left && eta < before) {
            return Ok(outcome);
        }
        (before, point) = (eta, outcome.point);
        newton.known.clear();
    }
}

/// Takes the next outcome if it is settled or has come nearer; whether it is settled.
pub fn improve(best: &mut Outcome, next: Outcome) -> bool {
    let is_settled = !matches!(next.ending, Ending::Stalled(_));
    if is_settled || next.point.eta < best.point.eta {
        *best = next;
    }
    is_settled
}

/// Newton's method in use.
struct Newton<'n, 'b> {
    equations: &'n Equations<'n>,
    bodies: &'n mut Session<'b>,
    /// Directions of the systems so far.
    known: Vec<Moved>,
}

impl NormalMap for Newton<'_, '_> {
    type Point = Point;
    type Step = Step;

    fn eta(&self, point: &Point) -> f64 {
        point.eta
    }

    fn merit(&self, point: &Point) -> f64 {
        point.merit
    }

    /// With a new factor where the old one leaves too much.
    fn step(&mut self, point: &Point) -> Result<Step, Ending> {
        let least = FORCING_OF_ETA * AIM * self.equations.tolerance / point.eta;
        let forcing = FORCING.min(FORCING_OF_ETA * point.eta).max(least);
        let (bodies, known) = (&mut *self.bodies, &mut self.known);
        let system = System::new(self.equations, point, bodies.operator);
        let factor = bodies.held();
        if factor.is_none() {
            bodies.hold_under(&system.held_set)?;
        }
        if let Some(factor) = factor.filter(|factor| **factor != system.held_set) {
            let pairs = factor.springs.len();
            if changed(&factor, &system.held_set) as f64 <= CHANGED * pairs as f64 {
                let step = system.step(bodies, (forcing, MOST_DIRECTIONS / 4), known)?;
                if step.left <= FORCING {
                    return Ok(step);
                }
            } else {
                known.clear();
            }
            bodies.hold_under(&system.held_set)?;
        }
        system.step(bodies, (forcing, MOST_DIRECTIONS), known)
    }

    fn moved(&mut self, point: &Point, step: &Step, part: f64) -> Result<Point, Ending> {
        let laws = self.equations.contact.pairs().iter();
        let y = laws.zip(point.y.iter().zip(&step.dy)).map(|(law, (y, dy))| {
            let next: Vector = std::array::from_fn(|c| y[c] + part * dy[c]);
            law.without_reversal(y, next)
        });
        let at = point.at.moved(part, &step.moved.z);
        let residual = self.bodies.follows_residuals().then(|| {
            let parts = point.residual.iter().zip(&step.moved.forces);
            parts.map(|(from, by)| from + part * by).collect()
        });
        Ok(self.equations.point(self.bodies, at, y.collect(), residual)?)
    }
}
