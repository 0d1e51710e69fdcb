//! Where all else fails: the pairs that may touch, condensed into a small dense matrix, and the path of
//! `solve::path::curved` in it, which leads to a solution whatever the friction is where contact does not hold the
//! bodies alone.
//!
//! With `C` the components of these pairs and `R` the inner unknowns and all other pairs, which are open,
//!
//! ```text
//! S = A_CC - A_CR A_RR⁻¹ A_RC,        F_C = S d_C - (F_C where d_C = 0)
//! ```
//!
//! take one solution with `C` held, and one product, for each component. Where nothing can be held `C` are all pairs,
//! and products alone are taken. Pairs that penetrate then join `C`. Newton's method goes on from where the path ends.

use std::borrow::Cow;

use super::newton::{self, Ended, Goal};
use super::point::{Displacements, Equations, Point};
use crate::error::Error;
use crate::linalg::matrix::Matrix;
use crate::monitor::{Monitor, Stop};
use crate::problem::{Bodies, Restriction};
use crate::solve::candidate::Ending;
use crate::solve::normal_map::Equations as DenseEquations;
use crate::solve::path::curved_from;

/// Pairs beside those that are closed: a part of these, and a few.
const MARGIN: f64 = 0.15;
const FEW: usize = 2;

/// Square matrices of the components of `C`: `S`, and the factors of two systems.
const MATRICES: usize = 3;

/// Bytes that are little beside what any program takes.
const LITTLE: u64 = 1 << 25;

/// Solutions with the residual of the one before.
const REFINEMENTS: usize = 2;

/// Most components of `C` where `room` bytes are free.
fn most_components(room: u64) -> usize {
    let entry = (MATRICES * size_of::<f64>()) as u64;
    (room / entry).isqrt() as usize
}

/// Most bytes that are taken for so many unknowns where there is room for `room` bytes in any case.
pub fn memory(unknowns: usize, room: u64) -> u64 {
    let all = (MATRICES * size_of::<f64>()) as u64 * (unknowns as u64).pow(2);
    room.max(LITTLE.min(all))
}

/// Goes on from tries that have failed, `best` among them; `room` is the memory of what they took.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    mut best: Ended,
    room: u64,
    goal: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    let most = most_components(memory(equations.load.len(), room));
    let mut chosen = touching(equations, &best.point, bodies.can_hold());
    let mut y = best.point.y.clone();
    loop {
        if chosen.len() * equations.contact.dim() > most {
            return Ok(best);
        }
        let condensed = match Condensed::new(equations, bodies, &chosen, &best.point, monitor)? {
            Ok(condensed) => condensed,
            Err(stop) => {
                best.ending = Ending::Stopped(stop);
                return Ok(best);
            }
        };
        let own = chosen.iter().map(|&pair| y[pair]).collect();
        let ended = curved_from(&condensed.equations(equations), own, goal.tolerance, monitor);
        best.systems += ended.systems;
        match ended.ending {
            Ending::Done => {}
            Ending::Stopped(_) => {
                best.ending = ended.ending;
                return Ok(best);
            }
            _ => return Ok(best),
        }
        let at = condensed.with(equations, bodies, &ended.point.d)?;
        let point = equations.held_at(at, bodies)?;
        let closing: Vec<usize> = (0..point.pieces.len())
            .filter(|pair| point.pieces[*pair].closed && chosen.binary_search(pair).is_err())
            .collect();
        if closing.is_empty() {
            let held = Some(condensed.restriction).filter(|_| bodies.can_hold());
            let mut last = newton::solve(equations, bodies, point, held, goal, monitor)?;
            last.systems += best.systems;
            let is_better =
                !matches!(last.ending, Ending::Stalled(_)) || last.point.eta < best.point.eta;
            return Ok(if is_better { last } else { best });
        }
        y = point.y;
        chosen.extend(closing);
        chosen.sort_unstable();
    }
}

/// The pairs that are closed at a point, those next to closing, and those that carry forces when they are open; all
/// pairs where none can be held.
fn touching(equations: &Equations<'_>, point: &Point, can_hold: bool) -> Vec<usize> {
    let laws = equations.contact.pairs();
    if !can_hold {
        return (0..laws.len()).collect();
    }
    let closed = point.pieces.iter().filter(|piece| piece.closed).count();
    let wanted = closed + (MARGIN * closed as f64).ceil() as usize + FEW;
    let mut chosen: Vec<usize> =
        (0..laws.len()).filter(|&pair| laws[pair].has_obstacle()).collect();
    let height = |pair: usize| {
        point.y[pair][0] / equations.root[equations.inner + equations.contact.dim() * pair]
    };
    chosen.sort_by(|&a, &b| height(b).total_cmp(&height(a)));
    chosen.truncate(wanted);
    chosen.extend((0..laws.len()).filter(|&pair| !laws[pair].is_free_when_open()));
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// Bodies condensed on some pairs.
struct Condensed<'c> {
    pairs: &'c [usize],
    /// Where their components are among all unknowns.
    places: Vec<usize>,
    restriction: Restriction,
    /// All unknowns where these components are zero and the others without contact forces.
    at: Displacements,
    matrix: Vec<f64>,
    load: Vec<f64>,
}

impl<'c> Condensed<'c> {
    /// On `pairs`, from displacements near by; or why that was stopped.
    fn new(
        equations: &Equations<'_>,
        bodies: &mut dyn Bodies,
        pairs: &'c [usize],
        near: &Point,
        monitor: &mut Monitor<'_>,
    ) -> Result<Result<Self, Stop>, Error> {
        let (dim, inner) = (equations.contact.dim(), equations.inner);
        let own: Vec<usize> = pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1)).collect();
        let mut restriction = Restriction::all(dim, equations.contact.pairs().len());
        restriction.held.fill(false);
        own.iter().for_each(|&i| restriction.held[i] = true);
        let mut stop = None;
        if bodies.can_hold() {
            bodies.hold(&restriction, &mut || {
                stop = monitor.goes_on().err();
                stop.is_none()
            })?;
        }
        if let Some(stop) = stop {
            return Ok(Err(stop));
        }
        let places: Vec<usize> = own.iter().map(|i| inner + i).collect();
        let (at, matrix, load) = (near.at.clone(), Vec::new(), Vec::new());
        let mut made = Condensed { pairs, places, restriction, at, matrix, load };
        let size = made.places.len();
        made.at = made.with(equations, bodies, &vec![0.0; size])?;
        let forces = bodies.residual(&made.at.x, &made.at.low, equations.load)?;
        made.load = made.places.iter().map(|&i| -forces[i]).collect();
        made.matrix = vec![0.0; size * size];
        for j in 0..size {
            if let Err(stop) = monitor.goes_on() {
                return Ok(Err(stop));
            }
            let column = made.column(bodies, j)?;
            made.matrix[size * j..size * (j + 1)].copy_from_slice(&column);
        }
        symmetrise(&mut made.matrix, size);
        Ok(Ok(made))
    }

    /// Whether there are other unknowns.
    fn has_others(&self) -> bool {
        self.places.len() < self.at.x.len()
    }

    /// The forces on the components where component `j` is moved by one.
    fn column(&self, bodies: &mut dyn Bodies, j: usize) -> Result<Vec<f64>, Error> {
        let mut x = vec![0.0; self.at.x.len()];
        x[self.places[j]] = 1.0;
        let mut forces = bodies.product(&x)?;
        if self.has_others() {
            let mut others = bodies.solve(&forces)?;
            self.places.iter().for_each(|&i| others[i] = 0.0);
            let taken = bodies.product(&others)?;
            forces.iter_mut().zip(taken).for_each(|(force, taken)| *force -= taken);
        }
        Ok(self.places.iter().map(|&i| forces[i]).collect())
    }

    /// All unknowns where the components have the displacements `d` and the others carry no contact forces.
    fn with(
        &self,
        equations: &Equations<'_>,
        bodies: &mut dyn Bodies,
        d: &[f64],
    ) -> Result<Displacements, Error> {
        let mut at = self.at.clone();
        self.places.iter().zip(d).for_each(|(&i, d)| at.x[i] = *d);
        if self.has_others() {
            for _ in 0..=REFINEMENTS {
                let lack = bodies.residual(&at.x, &at.low, equations.load)?;
                let mut step = bodies.solve(&lack)?;
                self.places.iter().for_each(|&i| step[i] = 0.0);
                at = at.moved(-1.0, &step);
            }
        }
        Ok(at)
    }

    /// The equations of the pairs.
    fn equations(&self, whole: &Equations<'_>) -> DenseEquations<'_> {
        let dim = whole.contact.dim();
        let laws = self.pairs.iter().map(|&pair| whole.contact.pairs()[pair]).collect();
        let size = self.places.len();
        let matrix = Matrix::new(size, &self.matrix, size);
        let load = Cow::Borrowed(self.load.as_slice());
        DenseEquations::new(dim, matrix, load, Cow::Owned(laws), whole.unit)
    }
}

/// Takes the mean of entries that are equal but for rounding.
fn symmetrise(matrix: &mut [f64], size: usize) {
    for j in 0..size {
        for i in 0..j {
            let mean = f64::midpoint(matrix[i + size * j], matrix[j + size * i]);
            (matrix[i + size * j], matrix[j + size * i]) = (mean, mean);
        }
    }
}
