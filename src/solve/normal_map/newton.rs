//! Newton's method on the normal map with a line search on the lack of equilibrium.
//!
//! A factorised system serves again as long as a step with it lets `|H|` fall tenfold: where slip directions turn a
//! little, such chord steps find the last digits for a solve each, and one or two systems in three are saved.
//!
//! The iterates obey the law exactly; what falls is `|H|`. There is no guarantee: from `mu` of about 1
//! on, on matrices that are no stiffness of a mesh, it may stop at a kink of `|H|`.

use super::equations::{Equations, Point};
use super::system::System;
use crate::law::Vector;
use crate::monitor::{Monitor, Stop};
use crate::solve::candidate::{Candidate, Effort, Ending};
use crate::solve::sweeps::Sweeper;

/// Systems after which it is given up: it takes up to about ten where it converges.
const MOST_SYSTEMS: u64 = 20;

/// Part of the fall of `|H|` that a full step promises which a shortened one must keep (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Part of `|H|` that a step with the system of an earlier point may leave. Such a step costs a solve, a small part
/// of a factorisation.
const CHORD: f64 = 0.1;

/// Shortest step: a kink of the law may lie within any longer one.
const SHORTEST: f64 = 1e-3;

/// Shortest steps in a row after which it is given up.
const MOST_SHORTEST: u32 = 3;

/// A step that is cut below this part ends at a kink of `|H|`: some sweeps lead away from it, a few
/// times. They halve the failures on random problems.
const SHORT: f64 = 0.1;
const RESWEEPS: usize = 20;
const MOST_RESWEEPS: u32 = 3;

/// Part of the tolerance that is aimed at: the certificate of the whole problem, with its own rounding,
/// must meet the tolerance.
const AIM: f64 = 0.1;

/// Where `eta` is below and falls no further, rounding is reached.
const NEAR_ROUNDING: f64 = 1e-6;

/// How Newton's method ended, and where.
pub struct Ended {
    /// The best point.
    pub point: Point,
    /// `Done` if `eta` is below the tolerance or at its rounding.
    pub ending: Ending,
    /// Linear systems.
    pub systems: u64,
    /// Sign of the determinant of the last system, 0 if there was none.
    pub orientation: i8,
}

impl Ended {
    /// The candidate of equations that are a whole problem's.
    pub fn into_candidate(self) -> Candidate {
        let effort = Effort::of_systems(self.systems);
        let mut candidate = Candidate::new(self.point.d, self.point.force, self.ending, effort);
        candidate.orientation = self.orientation;
        candidate
    }
}

/// Solves the equations from the coordinates `y`.
pub fn solve(
    equations: &Equations<'_>,
    y: Vec<Vector>,
    tolerance: f64,
    monitor: &mut Monitor<'_>,
) -> Ended {
    let point = Point::new(equations, y);
    let mut ended = Ended { point, ending: Ending::Done, systems: 0, orientation: 0 };
    let mut shortest = 0;
    let mut resweeps = 0;
    let mut last = f64::INFINITY;
    let mut kept = None;
    ended.ending = loop {
        if let Some(system) = kept.take()
            && let Err(stop) = chords(equations, system, &mut ended.point, monitor)
        {
            break Ending::Stopped(stop);
        }
        let eta = equations.eta(&ended.point.d, &ended.point.force);
        monitor.measured(eta);
        // One system at least: it finds the digits that sweeps have not, and the orientation.
        let at_rounding = eta <= NEAR_ROUNDING && eta >= last;
        if ended.systems > 0 && (eta <= AIM * tolerance || at_rounding) {
            break Ending::Done;
        }
        last = eta;
        if ended.systems >= MOST_SYSTEMS || shortest >= MOST_SHORTEST {
            break Ending::Stalled("Newton's method does not converge");
        }
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        let point = &ended.point;
        if let Err(stop) = monitor.affords(System::work(equations, &point.pieces)) {
            break Ending::Stopped(stop);
        }
        ended.systems += 1;
        let system = System::new(equations, (&point.pieces, &point.y), 1.0, None);
        let Some(mut system) = system else { break Ending::Singular };
        let Some((step, _)) = system.step(&point.lack, 0.0) else { break Ending::Singular };
        ended.orientation = system.orientation();
        let (next, part) = line_search(equations, point, &step);
        if !next.merit.is_finite() {
            break Ending::Stalled("the forces are beyond the largest number");
        }
        shortest = if part <= SHORTEST { shortest + 1 } else { 0 };
        kept = (part == 1.0).then_some(system);
        ended.point = match part < SHORT && resweeps < MOST_RESWEEPS {
            true => swept(equations, &next, monitor),
            false => next,
        };
        resweeps += u32::from(part < SHORT);
    };
    ended
}

/// Steps with the system `A` of an earlier point, as long as `|H|` falls nearly as after one with a new system `J`.
/// Takes the system: two factors never stand side by side.
///
/// The orientation stays that of `A`. If that of `J` differed, `A⁻¹ J` would have a negative eigenvalue, and what
/// lies along its vector would grow with each step.
fn chords(
    equations: &Equations<'_>,
    mut system: System<'_>,
    point: &mut Point,
    monitor: &mut Monitor<'_>,
) -> Result<(), Stop> {
    loop {
        monitor.goes_on()?;
        let Some((step, _)) = system.step(&point.lack, 0.0) else { return Ok(()) };
        let next = Point::new(equations, moved(&point.y, &step, 1.0));
        if !(next.merit < CHORD * point.merit) {
            return Ok(());
        }
        *point = next;
    }
}

/// `y + part dy`.
fn moved(y: &[Vector], step: &[Vector], part: f64) -> Vec<Vector> {
    let each = |(y, dy): (&Vector, &Vector)| std::array::from_fn(|c| y[c] + part * dy[c]);
    y.iter().zip(step).map(each).collect()
}

/// The point after some sweeps, fewer if the time is up.
fn swept(equations: &Equations<'_>, point: &Point, monitor: &Monitor<'_>) -> Point {
    let sweeper = Sweeper::new();
    let (mut d, mut force) = (point.d.clone(), point.force.clone());
    for _ in 0..RESWEEPS {
        if monitor.is_late() {
            break;
        }
        sweeper.sweep_pairs(&equations.laws, equations.matrix, (&mut d, &mut force), 1.0);
    }
    Point::new(equations, equations.coordinates(&d, &force))
}

/// The first of ever shorter steps along which `|H|` falls enough, or the shortest; and its length.
fn line_search(equations: &Equations<'_>, point: &Point, step: &[Vector]) -> (Point, f64) {
    let mut part = 1.0;
    loop {
        let next = Point::new(equations, moved(&point.y, step, part));
        if next.merit <= (1.0 - SUFFICIENT * part) * point.merit || part <= SHORTEST {
            return (next, part);
        }
        part /= 2.0;
    }
}

/// The point after one system, with the whole step; `None` if the system is singular.
pub fn step(equations: &Equations<'_>, point: &Point) -> Option<Point> {
    let mut system = System::new(equations, (&point.pieces, &point.y), 1.0, None)?;
    let (step, _) = system.step(&point.lack, 0.0)?;
    Some(Point::new(equations, moved(&point.y, &step, 1.0)))
}
