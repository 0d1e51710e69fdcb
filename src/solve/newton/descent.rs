//! Newton's method with a line search, for every form of the equations on the normal map (`law::normal_map`): dense,
//! with some pairs eliminated, and with products and solutions only.
//!
//! The iterates obey the law exactly; what falls is the lack of equilibrium. There is no guarantee: from `mu` of about
//! 1 on, on matrices that are no stiffness of a mesh, the method may stop at a kink of the lack's length.

use crate::monitor::Watch;
use crate::solve::result::Ending;

/// Part of the fall of the lack that a full step promises which a shortened one must keep (Armijo).
const SUFFICIENT: f64 = 1e-4;

/// Shortest step: a kink of the law may lie within any longer one.
const SHORTEST: f64 = 1e-3;

/// Tries without a gain after which a loop of Newton's method is given up: shortest steps in a row here.
pub const PATIENCE: usize = 3;

/// Part of the tolerance that is aimed at: the certificate of the whole problem, with its own rounding, must meet
/// the tolerance.
pub const AIM: f64 = 0.1;

/// Where `eta` is below and falls no further, rounding is reached.
const NEAR_ROUNDING: f64 = 1e-6;

/// Rounding of `eta`: that of forces rounded once, a few times as the steps have no rounding in mind.
pub const ROUNDING_OF_ETA: f64 = 4.0 * f64::EPSILON;

/// Equations on the normal map, as Newton's method sees them.
pub trait NormalMap {
    /// Coordinates of all pairs, with the lack of equilibrium there.
    type Point;
    /// A change of a point, to first order.
    type Step;

    /// `eta` at a point, as the certificate measures it.
    fn eta(&self, point: &Self::Point) -> f64;

    /// Length of the lack at a point.
    fn merit(&self, point: &Self::Point) -> f64;

    /// Newton's step from a point.
    ///
    /// # Errors
    /// Why there is none.
    fn step(&mut self, point: &Self::Point) -> Result<Self::Step, Ending>;

    /// The point after a part of a step.
    ///
    /// # Errors
    /// A failure of the host that multiplies.
    fn moved(
        &mut self,
        point: &Self::Point,
        step: &Self::Step,
        part: f64,
    ) -> Result<Self::Point, Ending>;

    /// The point after a step that is taken whole, and the part of the step that has been taken.
    ///
    /// # Errors
    /// As [`Self::moved`].
    fn whole_step(
        &mut self,
        point: &Self::Point,
        step: &Self::Step,
    ) -> Result<(Self::Point, f64), Ending> {
        self.moved(point, step, 1.0).map(|next| (next, 1.0))
    }

    /// The point from which the next system is made, after this part of a step has led to `point`.
    fn after(&mut self, point: Self::Point, _part: f64) -> Self::Point {
        point
    }
}

/// Systems after which Newton's method is given up on operators and in flexibility form.
const MOST_SYSTEMS: u64 = 40;

/// The tolerance and the budget of Newton's method.
#[derive(Clone, Copy)]
pub struct Goal {
    pub tolerance: f64,
    /// Systems that are solved even if the first point is a solution, and those after which it is given up.
    pub least_systems: u64,
    pub most_systems: u64,
    /// First systems whose steps are taken whole, whether the lack falls or not: the line search comes after them.
    pub full_steps: u64,
}

impl Goal {
    /// The goal on operators and in flexibility form.
    pub fn of(tolerance: f64) -> Self {
        Goal { tolerance, least_systems: 0, most_systems: MOST_SYSTEMS, full_steps: 0 }
    }
}

/// How Newton's method ended, and where.
pub struct NewtonOutcome<P> {
    /// The last point where the method is done, otherwise that of the least lack.
    pub point: P,
    /// `Done` if `eta` is below the tolerance or at its rounding.
    pub ending: Ending,
    /// Systems, without one that was stopped.
    pub systems: u64,
}

/// Solves equations from a point.
pub fn solve<M: NormalMap>(
    map: &mut M,
    mut point: M::Point,
    goal: Goal,
    monitor: &dyn Watch,
) -> NewtonOutcome<M::Point> {
    let (mut systems, mut shortest, mut last) = (0, 0, f64::INFINITY);
    // The point of the least lack, if it is not the last one.
    let mut best = None;
    let ending = loop {
        let eta = map.eta(&point);
        monitor.measured(eta);
        let at_rounding = eta <= NEAR_ROUNDING && eta >= last;
        if systems >= goal.least_systems && (eta <= AIM * goal.tolerance || at_rounding) {
            break Ending::Done;
        }
        last = eta;
        if systems >= goal.most_systems || shortest >= PATIENCE {
            break Ending::Stalled("Newton's method does not converge");
        }
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        let step = map.step(&point);
        systems += u64::from(!matches!(step, Err(Ending::Stopped(_))));
        let step = match step {
            Ok(step) => step,
            Err(ending) => break ending,
        };
        let moved = match systems <= goal.full_steps {
            true => map.whole_step(&point, &step),
            false => line_search(map, &point, &step),
        };
        let (next, part) = match moved {
            Ok(moved) => moved,
            Err(ending) => break ending,
        };
        if !map.merit(&next).is_finite() {
            break Ending::Stalled("the forces are beyond the largest number");
        }
        shortest = if part <= SHORTEST { shortest + 1 } else { 0 };
        let before = std::mem::replace(&mut point, map.after(next, part));
        let now = map.merit(&point);
        best = best.or(Some(before)).filter(|best| map.merit(best) < now);
    };
    if ending != Ending::Done {
        point = best.unwrap_or(point);
    }
    NewtonOutcome { point, ending, systems }
}

/// The first of ever shorter steps along which the lack falls enough, or the shortest; and its length.
fn line_search<M: NormalMap>(
    map: &mut M,
    point: &M::Point,
    step: &M::Step,
) -> Result<(M::Point, f64), Ending> {
    let (before, mut part) = (map.merit(point), 1.0);
    loop {
        let next = map.moved(point, step, part)?;
        if map.merit(&next) <= (1.0 - SUFFICIENT * part) * before || part <= SHORTEST {
            return Ok((next, part));
        }
        part /= 2.0;
    }
}
