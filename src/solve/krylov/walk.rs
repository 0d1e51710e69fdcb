//! Where Newton's method fails in the plane: the linear path of `solve::path::linear`, whose theorems G, H and K hold
//! here as they are, with products and solutions only.
//!
//! From coordinates `y0` with the lack `H_0` the loads are led in a straight line to their place,
//!
//! ```text
//! A x - b + (0, P) = (1 - s) H_0,        0 <= s <= 1,
//! ```
//!
//! from piece to piece. The direction on a piece is one system, solved by GMRES on a factor that serves many pieces.
//! No determinant is known, and none is needed: at a sure start it is positive, so that `s` grows, and behind a
//! boundary with the gradient `n` the path leaves the piece that it comes from, `n.dy < 0`. That is the sign of the
//! determinant, which the boundary multiplies by the factor by which it changes `n.dy`.

use super::directions::Directions;
use super::newton::{self, Ended, Goal, solved};
use super::point::{Displacements, Equations, Point};
use super::step::{Step, System};
use crate::error::Error;
use crate::law::branch::Branch;
use crate::law::{Exit, Vector};
use crate::monitor::{Monitor, Stop};
use crate::problem::{Bodies, Restriction};
use crate::solve::candidate::Ending;

/// Part of the residual of a direction that is left. What it leads astray by is put right after so many events.
const FORCING: f64 = 1e-7;
const EVENTS_BETWEEN: u64 = 16;

/// Most events for each pair, and at least: walks from sure starts took up to 4 for each pair.
const EVENTS: u64 = 10;
const LEAST_EVENTS: u64 = 100;

/// How much starts are moved, of the mean force of a pair, and how much the pressures of one with all pairs pressed
/// differ: symmetric meshes have ties.
const MOVED: f64 = 1e-7;
const VARIED: f64 = 0.1;

/// Multiples of the golden section, less their whole parts, look random enough.
const GOLDEN: f64 = 0.618_033_988_749_895;

/// Where a walk starts.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    /// Near the best point so far.
    Best,
    /// With all pairs closed.
    Pressed,
}

/// A walk: coordinates and displacements of all unknowns, with the pieces of the pairs.
struct Walk<'a> {
    equations: &'a Equations<'a>,
    y: Vec<Vector>,
    branches: Vec<Branch>,
    at: Displacements,
    s: f64,
    first: Vec<f64>,
    held: Option<Restriction>,
    known: Directions,
    events: u64,
}

/// How a walk ended.
enum End {
    Arrived,
    Lost,
    Stopped(Stop),
}

/// Walks from where the tries before have ended, `best` among them, then with all pairs pressed on their obstacles.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    mut best: Ended,
    goal: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    for start in [Start::Best, Start::Pressed] {
        let mut walk = Walk::new(equations, bodies, &best.point, start)?;
        match walk.follow(bodies, monitor)? {
            End::Lost => continue,
            End::Stopped(stop) => {
                best.ending = Ending::Stopped(stop);
                return Ok(best);
            }
            End::Arrived => {}
        }
        let Walk { at, y, held, events, .. } = walk;
        let point = equations.point(bodies, at, y, |_, _| None)?;
        let mut ended = newton::solve(equations, bodies, point, held, goal, monitor)?;
        ended.systems += events;
        let is_settled = !matches!(ended.ending, Ending::Stalled(_));
        if is_settled || ended.point.eta < best.point.eta {
            best = ended;
        }
        if is_settled {
            break;
        }
    }
    Ok(best)
}

impl<'a> Walk<'a> {
    fn new(
        equations: &'a Equations<'a>,
        bodies: &mut dyn Bodies,
        near: &Point,
        start: Start,
    ) -> Result<Self, Error> {
        let laws = equations.contact.pairs();
        let mean = equations.unit / (laws.len() as f64).sqrt();
        let part = |number: usize| (number as f64 * GOLDEN).fract();
        let y = laws.iter().zip(&near.y).enumerate().map(|(pair, (law, y))| -> Vector {
            let y = [0, 1].map(|c| y[c] + MOVED * mean * part(2 * pair + c));
            let [n, t] = match start {
                Start::Best => law.sure_start(y),
                Start::Pressed => law.pressed(y, mean * (1.0 + VARIED * part(pair))),
            };
            [n, t, 0.0]
        });
        let y: Vec<Vector> = y.collect();
        let mut held = None;
        if bodies.can_hold() {
            let all = Restriction::all(equations.contact.dim(), laws.len());
            bodies.hold(&all, &mut || true)?;
            held = Some(all);
        }
        let at = equations.point(bodies, near.at.clone(), y.clone(), |_, _| None)?.at;
        let at = at.in_equilibrium(bodies, equations.load)?;
        let Point { at, lack: first, .. } = equations.point(bodies, at, y.clone(), |_, _| None)?;
        let branches = laws.iter().zip(&y).map(|(law, y)| law.chart_branch(y)).collect();
        let known = Directions::default();
        Ok(Walk { equations, y, branches, at, s: 0.0, first, held, known, events: 0 })
    }

    /// Goes on to the end.
    fn follow(&mut self, bodies: &mut dyn Bodies, monitor: &mut Monitor<'_>) -> Result<End, Error> {
        let most = LEAST_EVENTS.max(EVENTS * self.y.len() as u64);
        let mut passed: Option<(usize, Exit)> = None;
        while self.events < most {
            if let Err(stop) = monitor.step() {
                return Ok(End::Stopped(stop));
            }
            self.events += 1;
            if self.events.is_multiple_of(EVENTS_BETWEEN)
                && let Err(stop) = self.put_right(bodies, monitor)?
            {
                return Ok(End::Stopped(stop));
            }
            let first = self.first.clone();
            let Step { dy: rate, moved, .. } = match self.moved_by(&first, bodies, monitor)? {
                Ok(step) => step,
                Err(stop) => return Ok(End::Stopped(stop)),
            };
            let sign = passed.as_ref().map_or(1.0, |(pair, Exit { gradient, .. })| {
                let rate = rate[*pair];
                -(gradient[0] * rate[0] + gradient[1] * rate[1]).signum()
            });
            let exit = self.next_exit(&rate, sign);
            let left = if sign > 0.0 { 1.0 - self.s } else { f64::INFINITY };
            let step = exit.as_ref().map_or(left, |(_, exit)| exit.step.min(left));
            if !step.is_finite() {
                return Ok(End::Lost);
            }
            self.move_by(sign * step, &rate, &moved.z);
            self.s += sign * step;
            let Some((pair, exit)) = exit.filter(|(_, exit)| exit.step < left) else {
                return Ok(End::Arrived);
            };
            if self.s < 0.0 {
                return Ok(End::Lost);
            }
            self.branches[pair] = exit.beyond;
            passed = Some((pair, exit));
        }
        Ok(End::Lost)
    }

    /// The step that takes a lack away on the pieces of today.
    fn moved_by(
        &mut self,
        lack: &[f64],
        bodies: &mut dyn Bodies,
        monitor: &mut Monitor<'_>,
    ) -> Result<Result<Step, Stop>, Error> {
        let system = System::on_branches(self.equations, lack, &self.branches);
        let exact = (FORCING, FORCING);
        solved(&system, bodies, &mut self.held, exact, &mut self.known, monitor)
    }

    fn move_by(&mut self, part: f64, rate: &[Vector], z: &[f64]) {
        for (y, rate) in self.y.iter_mut().zip(rate) {
            y.iter_mut().zip(rate).for_each(|(y, rate)| *y += part * rate);
        }
        self.at = self.at.moved(part, z);
    }

    /// Puts the coordinates back on the path.
    fn put_right(
        &mut self,
        bodies: &mut dyn Bodies,
        monitor: &mut Monitor<'_>,
    ) -> Result<Result<(), Stop>, Error> {
        let point = self.equations.point(bodies, self.at.clone(), self.y.clone(), |_, _| None)?;
        let on_path = self.first.iter().map(|first| (1.0 - self.s) * first);
        let off: Vec<f64> =
            point.lack.iter().zip(on_path).map(|(lack, path)| lack - path).collect();
        self.at = point.at;
        Ok(match self.moved_by(&off, bodies, monitor)? {
            Ok(Step { dy, moved, .. }) => {
                self.move_by(1.0, &dy, &moved.z);
                Ok(())
            }
            Err(stop) => Err(stop),
        })
    }

    /// The first boundary on the way, and whose it is.
    fn next_exit(&self, rate: &[Vector], sign: f64) -> Option<(usize, Exit)> {
        let mut first: Option<(usize, Exit)> = None;
        let pairs = self.equations.contact.pairs().iter().zip(&self.branches);
        for (pair, ((law, branch), (y, rate))) in pairs.zip(self.y.iter().zip(rate)).enumerate() {
            let rate = [sign * rate[0], sign * rate[1]];
            if let Some(exit) = law.planar_exit(*branch, [y[0], y[1]], rate)
                && first.as_ref().is_none_or(|(_, first)| exit.step < first.step)
            {
                first = Some((pair, exit));
            }
        }
        first
    }
}
