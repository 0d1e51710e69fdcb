//! Newton's method on the normal map, its steps by GMRES, with a line search.

use super::directions::Directions;
use super::point::{Equations, Point};
use super::step::{MOST_DIRECTIONS, Step, System, changed};
use crate::error::Error;
use crate::law::Vector;
use crate::monitor::{Monitor, Stop};
use crate::problem::{Bodies, Restriction};
use crate::solve::candidate::Ending;

/// Systems with full steps: where they converge they take fewer than steps with a line search.
const FULL_STEPS: u64 = 16;

/// Systems after which it is given up. With a line search nothing cycles.
pub const MOST_SYSTEMS: u64 = 40;

/// Part of the fall of the lack that a full step promises which a shortened one must keep (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Shortest step: a kink of the law may lie within any longer one.
const SHORTEST: f64 = 1e-3;

/// Shortest steps in a row after which it is given up.
const MOST_SHORTEST: u32 = 3;

/// Part of the tolerance that is aimed at.
const AIM: f64 = 0.1;

/// Where `eta` is below and falls no further, rounding is reached.
const NEAR_ROUNDING: f64 = 1e-6;

/// A linear system is solved to this part of its right side, and later to this part of `eta`, so that the last
/// steps converge quadratically (S. C. Eisenstat and H. F. Walker, *Choosing the forcing terms in an inexact
/// Newton method*, SIAM J. Sci. Comput. 17 (1996) 16-32). Where a system is solved less well, the pairs get states
/// that the pieces do not ask for: on lines of 4097 pairs .05 takes up to 17 systems, .3 more than 40.
const FORCING: f64 = 0.01;
const FORCING_OF_ETA: f64 = 0.3;

/// A factor serves while at most this part of the pairs has changed, and so many directions leave little
/// enough; if they do not, they serve the system with the new factor.
const CHANGED: f64 = 0.02;
const DIRECTIONS: usize = 25;

/// How often it goes on from a residual that is measured.
const MOST_RENEWALS: u32 = 3;

/// What is wanted, and the systems after which it is given up.
#[derive(Clone, Copy)]
pub struct Goal {
    pub tolerance: f64,
    pub systems: u64,
}

/// How it ended.
pub struct Ended {
    pub point: Point,
    pub ending: Ending,
    pub systems: u64,
    /// What is held in the last factor.
    pub held: Option<Restriction>,
}

/// Solves from a point; `held` is what is held in the factor. The residual of the last point is measured: where
/// products are dear it is followed from step to step, has the rounding of all of them, and may hide what is left.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    point: Point,
    held: Option<Restriction>,
    goal: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    let mut ended = follow(equations, bodies, point, held, goal, monitor)?;
    if !is_followed(bodies) {
        return Ok(ended);
    }
    let (mut before, mut renewals) = (f64::INFINITY, 0);
    loop {
        let Point { at, y, .. } = ended.point;
        ended.point = equations.point(bodies, at, y, |_, _| None)?;
        let eta = ended.point.eta;
        let is_left = ended.ending == Ending::Done && eta > goal.tolerance && eta < before;
        if !is_left || renewals == MOST_RENEWALS {
            return Ok(ended);
        }
        (before, renewals) = (eta, renewals + 1);
        let next = follow(equations, bodies, ended.point, ended.held, goal, monitor)?;
        ended = Ended { systems: ended.systems + next.systems, ..next };
    }
}

/// The same from a point whose residual is measured.
fn follow(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    point: Point,
    mut held: Option<Restriction>,
    Goal { tolerance, systems: most }: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    let mut ended = Ended { point, ending: Ending::Done, systems: 0, held: None };
    let (mut shortest, mut last) = (0, f64::INFINITY);
    let mut known = Directions::default();
    ended.ending = loop {
        let eta = ended.point.eta;
        monitor.measured(eta);
        let at_rounding = eta <= NEAR_ROUNDING && eta >= last;
        if eta <= AIM * tolerance || at_rounding {
            break Ending::Done;
        }
        last = eta;
        if ended.systems >= most || shortest >= MOST_SHORTEST {
            break Ending::Stalled("Newton's method does not converge");
        }
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        ended.systems += 1;
        let system = System::new(equations, &ended.point, bodies.has_springs());
        let goal = FORCING_OF_ETA * AIM * tolerance / eta;
        let forcing = FORCING.min(FORCING_OF_ETA * eta).max(goal);
        let parts = (forcing, FORCING);
        let step = match solved(&system, bodies, &mut held, parts, &mut known, monitor)? {
            Ok(step) => step,
            Err(stop) => break Ending::Stopped(stop),
        };
        let (next, part) = match ended.systems <= FULL_STEPS {
            true => (moved(equations, bodies, &ended.point, &step, 1.0)?, 1.0),
            false => line_search(equations, bodies, &ended.point, &step)?,
        };
        if !next.merit.is_finite() {
            break Ending::Stalled("the forces are beyond the largest number");
        }
        shortest = if part <= SHORTEST { shortest + 1 } else { 0 };
        ended.point = next;
    };
    ended.held = held;
    Ok(ended)
}

/// Whether residuals follow from those of the point before, without products.
fn is_followed(bodies: &dyn Bodies) -> bool {
    !bodies.has_cheap_products() && bodies.inner() == 0
}

/// The step of a system to a residual of the part `forcing`, with a new factor where the old one does not leave the
/// part `enough` at most, or why it was stopped.
pub fn solved(
    system: &System<'_>,
    bodies: &mut dyn Bodies,
    held: &mut Option<Restriction>,
    (forcing, enough): (f64, f64),
    known: &mut Directions,
    monitor: &mut Monitor<'_>,
) -> Result<Result<Step, Stop>, Error> {
    if let Some(factor) = held.as_mut().filter(|factor| **factor != system.restriction) {
        let pairs = factor.springs.len();
        if changed(factor, &system.restriction) as f64 <= CHANGED * pairs as f64 {
            let step = system.step(bodies, Some(factor), (forcing, DIRECTIONS), known)?;
            if step.left <= enough {
                return Ok(Ok(step));
            }
        } else {
            known.clear();
        }
        if let Err(stop) = renew(bodies, factor, &system.restriction, monitor)? {
            return Ok(Err(stop));
        }
    }
    system.step(bodies, held.as_ref(), (forcing, MOST_DIRECTIONS), known).map(Ok)
}

/// Factorises anew.
fn renew(
    bodies: &mut dyn Bodies,
    factor: &mut Restriction,
    restriction: &Restriction,
    monitor: &mut Monitor<'_>,
) -> Result<Result<(), Stop>, Error> {
    let mut stop = None;
    let mut goes_on = || {
        stop = monitor.goes_on().err();
        stop.is_none()
    };
    bodies.hold(restriction, &mut goes_on)?;
    if let Some(stop) = stop {
        return Ok(Err(stop));
    }
    factor.clone_from(restriction);
    Ok(Ok(()))
}

/// The first of ever shorter steps along which the lack falls enough, or the shortest; and its length.
fn line_search(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    point: &Point,
    step: &Step,
) -> Result<(Point, f64), Error> {
    let mut part = 1.0;
    loop {
        let next = moved(equations, bodies, point, step, part)?;
        if next.merit <= (1.0 - SUFFICIENT * part) * point.merit || part <= SHORTEST {
            return Ok((next, part));
        }
        part /= 2.0;
    }
}

/// The point after a part of a step.
fn moved(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    point: &Point,
    step: &Step,
    part: f64,
) -> Result<Point, Error> {
    let laws = equations.contact.pairs().iter();
    let y = laws.zip(point.y.iter().zip(&step.dy)).map(|(law, (y, dy))| {
        let next: Vector = std::array::from_fn(|c| y[c] + part * dy[c]);
        law.without_reversal(y, next)
    });
    let along = |from: &[f64], by: &[f64]| -> Vec<f64> {
        from.iter().zip(by).map(|(from, by)| from + part * by).collect()
    };
    let at = point.at.moved(part, &step.moved.z);
    equations.point(bodies, at, y.collect(), |bodies, apart| {
        if !is_followed(bodies) {
            return None;
        }
        let mut residual = along(&point.residual, &step.moved.forces);
        if apart.iter().any(|apart| *apart != 0.0) {
            match bodies.product(apart) {
                Ok(product) => residual.iter_mut().zip(product).for_each(|(sum, p)| *sum += p),
                Err(error) => return Some(Err(error)),
            }
        }
        Some(Ok(residual))
    })
}
