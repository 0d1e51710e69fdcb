//! Newton's method on the dense equations of some pairs.
//!
//! A factorised system serves again as long as a step with it lets `|H|` fall tenfold: where slip directions turn a
//! little, such chord steps find the last digits for a solve each, and one or two systems in three are saved.
//!
//! In the plane a solution is exact on its pieces. Where it is on others, a few sweeps carry the edge of a zone over many
//! pairs, where Newton's step alone moves it by one.

use super::descent::{self, Goal, NormalMap, PATIENCE, ROUNDING_OF_ETA};
use super::ended::Ended;
use super::start::swept;
use crate::law::{PairLaw, Piece, Vector};
use crate::solve::part::many_are_open;
use crate::solve::pieces::{Equations, Point, Step, Systems};
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::sweeps::sweep_pairs;

/// Systems after which it is given up: it takes up to about ten where it converges.
const MOST_SYSTEMS: u64 = 20;

/// First systems in the plane whose steps are taken whole. With none the bar on the plane with 513 pairs is left unsolved;
/// with four all of its problems take nine systems at most.
pub const FULL_STEPS: u64 = 4;

/// Part of `|H|` that a step with the system of an earlier point may leave. Such a step costs a solve, a small part
/// of a factorisation.
pub const CHORD: f64 = 0.1;

/// A first step in the plane that leaves more than [`CHORD`] of `|H|` and opens more than this part of the pairs is taken
/// twice. Newton's step moves the edge of a zone only by the length over which the forces behind it decay, on a beam its
/// thickness; a pair that opens too early penetrates, and closes by the next step. On 100 problems of `peers.sh` that saves
/// 12 % of the systems, on beams 39 %, and it costs 5 % on the hard families of the plane. Where few pairs open it saves
/// nothing.
const OPENING: f64 = 0.05;

/// Sweeps between a solution in the plane and its pieces: two carry a zone's edge far enough.
const SWEEPS: usize = 2;

/// A step that is cut below this part ends at a kink of `|H|`: some sweeps lead away from it, [`PATIENCE`] times. They
/// halve the failures on random problems.
const SHORT: f64 = 0.1;
const RESWEEPS: usize = 20;

/// Where steps with an earlier system come no nearer.
pub const FAR: Ending = Ending::Stalled("the solution is far from the one before");

/// Where so many pairs are open that they are eliminated first.
pub const OPEN: Ending = Ending::Stalled("many pairs are open");

/// Solves the equations from the coordinates `y`; until most pairs are open if it `leaves_open` pairs to an elimination.
pub fn solve(
    call: &Call<'_>,
    equations: &Equations<'_>,
    y: Vec<Vector>,
    leaves_open: bool,
) -> Ended {
    let dense = Dense { leaves_open, ..Dense::of(call, equations) };
    dense.descend(Point::new(equations, y), 1)
}

/// Solves a whole problem in the plane, which has these equations, near its start: from the solution on the pieces of the problem before with
/// the same matrix, if they are its solution, and from sweeps. The certificate, which reads `K` anyway, tells if they are.
/// `None`: the sweeps lead beyond the largest number.
pub fn solve_in_plane(call: &Call<'_>, equations: &Equations<'_>) -> Option<Candidate> {
    let (contact, tolerance) = (call.contact, call.settings.tolerance);
    let mut dense = Dense::of(call, equations);
    let before = dense.systems.before(call.start).map(|left| Point::of_before(equations, left));
    let again = before.and_then(|point| dense.again(point).ok());
    if let Some(candidate) = &again {
        let certificate = candidate.certificate(contact);
        call.monitor.measured(certificate.eta);
        let y = equations.coordinates(candidate.d(), &certificate.raw);
        if equations.pieces(&y) == dense.pieces {
            if !(certificate.eta <= descent::AIM * tolerance) {
                let ended = dense.descend(Point::new(equations, y), 0);
                return Some(ended.into_candidate());
            }
            let force = certificate.raw.clone();
            let pieces = std::mem::take(&mut dense.pieces);
            dense.systems.leave(|| equations.before((pieces, &y), candidate.d(), &force));
            return again.map(|candidate| candidate.with_force(force));
        }
    }
    let start = again.as_ref().map(Candidate::d).or(call.start);
    let y = swept(equations, start, call.monitor)?;
    Some(dense.descend(Point::new(equations, y), 1).into_candidate())
}

/// Solves the equations in space by steps with the system that the problem before with the same matrix has left, whose
/// solution has the displacements `start`. `None`: nothing is left of it, or the first step does not come near.
pub fn solve_again(call: &Call<'_>, equations: &Equations<'_>, start: &[f64]) -> Option<Ended> {
    let mut dense = Dense::of(call, equations);
    let before = Point::of_before(equations, dense.systems.before(Some(start))?);
    call.monitor.step().ok()?;
    let (merit, enough) = (before.merit, descent::AIM * call.settings.tolerance);
    (dense.pieces, dense.y) = (before.pieces.clone(), before.y.clone());
    dense.orientation = dense.systems.orientation();
    let point = dense.chords(before, enough);
    match (point.merit < merit, point.pieces == dense.pieces) {
        (true, true) => {}
        _ if dense.eta(&point) <= enough => {}
        (true, false) => return Some(Ended::at(point, FAR)),
        (false, _) => return None,
    }
    Some(dense.descend(point, 0))
}

/// Solves a problem in the plane from the solution on given pieces, whatever the law says to it; the start is returned
/// unchanged if that cannot be had.
pub fn from_pieces(call: &Call<'_>, pieces: &[Piece]) -> Candidate {
    let equations = &Equations::of(call.contact);
    let mut dense = Dense::of(call, equations);
    let size = if equations.unit > 0.0 { equations.unit } else { 1.0 };
    let inside = |(law, piece): (&PairLaw, &Piece)| law.inside(*piece, size);
    let y = equations.laws.iter().zip(pieces).map(inside).collect();
    let point = Point::on(equations, pieces.to_vec(), y);
    match dense.from(point) {
        Ok(point) => dense.descend(point, 0).into_candidate(),
        Err(ending) => Candidate::of_displacements(call.contact, call.start_or_zero(), ending),
    }
}

/// Equations whose systems are factorised.
struct Dense<'e> {
    call: &'e Call<'e>,
    equations: &'e Equations<'e>,
    systems: Systems<'e>,
    /// The pieces of the last system, and the coordinates there.
    pieces: Vec<Piece>,
    y: Vec<Vector>,
    orientation: i8,
    /// True if the last point is the solution on the pieces on which it is.
    is_exact: bool,
    /// The pieces to which the sweeps after cut steps have led; the last of them may be there twice.
    swept_to: Vec<Vec<Piece>>,
    /// True if the search ends with [`OPEN`], and the point where it has.
    leaves_open: bool,
    left: Option<Point>,
    /// True before the first step from where sweeps have led.
    begins: bool,
}

impl<'e> Dense<'e> {
    fn of(call: &'e Call<'e>, equations: &'e Equations<'e>) -> Self {
        let (pieces, swept_to) = (Vec::new(), Vec::new());
        let systems = Systems::of(equations, call.monitor);
        Dense {
            call,
            equations,
            systems,
            pieces,
            y: Vec::new(),
            orientation: 0,
            is_exact: false,
            swept_to,
            leaves_open: false,
            left: None,
            begins: false,
        }
    }

    /// The solution on the pieces of a point of the plane. `Err`: that system is singular, or there is no time for it.
    fn from(&mut self, point: Point) -> Result<Point, Ending> {
        self.call.monitor.step()?;
        let step = self.system(&point)?;
        Ok(point.after(self.equations, &step, 1.0))
    }

    /// The displacements of the solution on the pieces of a point of the plane, of which no forces are known yet. `Err`: as
    /// [`Self::from`].
    fn again(&mut self, point: Point) -> Result<Candidate, Ending> {
        self.call.monitor.step()?;
        self.go_to(&point)?;
        let dd = self.systems.motion(&point.lack)?;
        let d = point.d.iter().zip(dd).map(|(d, dd)| d + dd).collect();
        let effort = Effort::of_systems(self.systems.factorisations);
        let mut candidate = Candidate::new(d, Vec::new(), Ending::Done, effort);
        candidate.orientation = self.orientation;
        Ok(candidate)
    }

    /// Goes on from a point to a tolerance, with so many systems at least.
    fn descend(mut self, point: Point, least_systems: u64) -> Ended {
        let (tolerance, monitor) = (self.call.settings.tolerance, self.call.monitor);
        // In the plane the first solutions bring the zones near their places, whatever `|H|` is on the way.
        let full_steps = if self.equations.dim == 2 { FULL_STEPS } else { 0 };
        let mut goal = Goal { tolerance, least_systems, most_systems: MOST_SYSTEMS, full_steps };
        self.is_exact = point.pieces == self.pieces;
        self.begins = least_systems > 0;
        let mut outcome = descent::solve(&mut self, point, goal, monitor);
        // A solution in the plane is exact once it is on the pieces of its system, however rough the tolerance is.
        goal.least_systems = 1;
        // At a degenerate solution rounding may change pieces for ever.
        for _ in 0..PATIENCE {
            let is_rough = self.systems.are_of_pieces() && !self.is_exact;
            if outcome.ending != Ending::Done || !is_rough {
                break;
            }
            outcome = descent::solve(&mut self, outcome.point, goal, monitor);
        }
        let (systems, orientation) = (self.systems.factorisations, self.orientation);
        let point = self.left.unwrap_or(outcome.point);
        self.systems.leave(|| point.clone().into_before(self.equations));
        Ended { systems, orientation, ..Ended::at(point, outcome.ending) }
    }

    /// Goes to the system of the pieces of a point.
    fn go_to(&mut self, point: &Point) -> Result<(), Ending> {
        let pairs = self.equations.linearised(&point.pieces, &point.y);
        self.systems.go_to(pairs)?;
        self.orientation = self.systems.orientation();
        self.pieces.clone_from(&point.pieces);
        self.y.clone_from(&point.y);
        Ok(())
    }

    /// The step from the pieces of a point.
    fn system(&mut self, point: &Point) -> Result<Step, Ending> {
        self.go_to(point)?;
        self.systems.step(&point.lack)
    }

    /// Steps with the system `A` of an earlier point, as long as `|H|` falls nearly as after one with a new system `J`.
    ///
    /// The orientation stays that of `A`. If that of `J` differed, `A⁻¹ J` would have a negative eigenvalue, and what
    /// lies along its vector would grow with each step. The steps end where `eta` is `enough`.
    fn chords(&mut self, mut point: Point, enough: f64) -> Point {
        let equations = self.equations;
        while !self.call.monitor.is_late() {
            let Ok(step) = self.systems.step(&point.lack) else { break };
            // A force that is carried along has the rounding of all steps: the last digits are measured anew.
            let next = point.after(equations, &Step { product: Vec::new(), ..step }, 1.0);
            if !(next.merit < CHORD * point.merit) {
                break;
            }
            point = next;
            if enough > 0.0 && equations.eta(&point.d, &point.force) <= enough {
                break;
            }
        }
        point
    }

    /// The point with pairs stuck whose slips have turned back since the last system, if there are any.
    fn without_reversal(&self, point: &Point) -> Option<Point> {
        let places = || self.equations.laws.iter().zip(self.y.iter().zip(&point.y));
        let stuck = || places().map(|(law, (before, y))| law.without_reversal(before, *y));
        let reverses = stuck().zip(&point.y).any(|(stuck, y)| stuck != *y);
        reverses.then(|| Point::new(self.equations, stuck().collect()))
    }

    /// The point after some sweeps, fewer if the time is up.
    fn swept(&self, point: &Point, sweeps: usize) -> Point {
        let equations = self.equations;
        let (mut d, mut force) = (point.d.clone(), point.force.clone());
        let iterate = (&mut d[..], &mut force[..]);
        sweep_pairs(&equations.laws, equations.matrix, iterate, (sweeps, 1.0), self.call.monitor);
        Point::new(equations, equations.coordinates(&d, &force))
    }
}

impl NormalMap for Dense<'_> {
    type Point = Point;
    type Step = Step;

    fn eta(&self, point: &Point) -> f64 {
        self.equations.eta(&point.d, &point.force)
    }

    fn merit(&self, point: &Point) -> f64 {
        point.merit
    }

    fn step(&mut self, point: &Point) -> Result<Step, Ending> {
        if let Some((last, others)) = self.swept_to.split_last()
            && others.contains(last)
        {
            return Err(Ending::Cycle);
        }
        if self.leaves_open && many_are_open(&point.pieces) {
            self.left = Some(point.clone());
            return Err(OPEN);
        }
        self.system(point)
    }

    fn moved(&mut self, point: &Point, step: &Step, part: f64) -> Result<Point, Ending> {
        Ok(point.after(self.equations, step, part))
    }

    fn whole_step(&mut self, point: &Point, step: &Step) -> Result<(Point, f64), Ending> {
        let next = point.after(self.equations, step, 1.0);
        let opened = closed(point).saturating_sub(closed(&next)) as f64;
        let is_far = next.merit > CHORD * point.merit;
        let opens_many = opened > OPENING * point.pieces.len() as f64;
        Ok(match std::mem::take(&mut self.begins) && is_far && opens_many {
            true => (point.after(self.equations, step, 2.0), 2.0),
            false => (next, 1.0),
        })
    }

    fn after(&mut self, point: Point, part: f64) -> Point {
        let is_linear = self.systems.are_of_pieces();
        self.is_exact = part == 1.0 && point.pieces == self.pieces;
        if is_linear && let Some(stuck) = self.without_reversal(&point) {
            return stuck;
        }
        if part < SHORT && self.swept_to.len() < PATIENCE {
            let swept = self.swept(&point, RESWEEPS);
            self.swept_to.push(swept.pieces.clone());
            return swept;
        }
        if self.is_exact {
            let anew = Point::new(self.equations, point.y);
            let is_enough = self.eta(&anew) <= ROUNDING_OF_ETA;
            return if is_enough { anew } else { self.chords(anew, ROUNDING_OF_ETA) };
        }
        if !is_linear {
            return if part == 1.0 { self.chords(point, 0.0) } else { point };
        }
        let swept = self.swept(&point, SWEEPS);
        if swept.merit < point.merit { swept } else { point }
    }
}

/// Number of closed pairs.
fn closed(point: &Point) -> usize {
    point.pieces.iter().filter(|piece| piece.closed).count()
}
