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

use super::newton::{self, Ended, Goal};
use super::point::{Displacements, Equations, Point};
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::{Monitor, Stop};
use crate::problem::{Bodies, ContactData, ContactProblem, Restriction};
use crate::settings::Settings;
use crate::solve::candidate::{Candidate, Ending};
use crate::solve::memory::memory as memory_of_path;
use crate::solve::path;

/// Pairs beside those that are closed: a part of these, and a few.
const MARGIN: f64 = 0.15;
const FEW: usize = 2;

/// Bytes that are little beside what any program takes.
const LITTLE: u64 = 1 << 25;

/// Most components of `C`: a system of the path takes a second, and it may take a thousand of them.
const MOST_COMPONENTS: usize = 3000;

/// Solutions with the residual of the one before.
const REFINEMENTS: usize = 2;

/// Components of a pair in the plane.
const PLANE: usize = 2;

/// Bytes that so many components of `C` take.
fn memory_of(components: usize) -> u64 {
    (components as u64).pow(2) * size_of::<f64>() as u64 + memory_of_path(components)
}

/// Most bytes that are taken for so many unknowns where there are `room` bytes in any case.
pub fn memory(unknowns: usize, room: u64) -> u64 {
    room.max(LITTLE.min(memory_of(unknowns)))
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
    let most = memory(equations.load.len(), room);
    let fits = |pairs: &[usize]| {
        let components = pairs.len() * equations.contact.dim();
        components <= MOST_COMPONENTS && memory_of(components) <= most
    };
    let mut chosen = touching(equations, &best.point, bodies.can_hold());
    let mut start = best.point.at.clone();
    while fits(&chosen) {
        let condensed = match Condensed::new(equations, bodies, &chosen, start, monitor)? {
            Ok(condensed) => condensed,
            Err(stop) => {
                best.ending = Ending::Stopped(stop);
                return Ok(best);
            }
        };
        let Some(found) = condensed.by_path(equations, goal, monitor) else { break };
        best.systems += found.effort.factorisations;
        match found.ending {
            Ending::Done => {}
            Ending::Stopped(_) => {
                best.ending = found.ending;
                break;
            }
            _ => break,
        }
        let at = condensed.with(equations, bodies, &found.d)?;
        let point = equations.held_at(at, bodies)?;
        let closing: Vec<usize> = (0..point.pieces.len())
            .filter(|pair| point.pieces[*pair].closed && chosen.binary_search(pair).is_err())
            .collect();
        if closing.is_empty() {
            let held = Some(condensed.restriction).filter(|_| bodies.can_hold());
            let mut last = newton::solve(equations, bodies, point, held, goal, monitor)?;
            last.systems += best.systems;
            let is_settled = !matches!(last.ending, Ending::Stalled(_));
            return Ok(if is_settled || last.point.eta < best.point.eta { last } else { best });
        }
        start = point.at;
        chosen.extend(closing);
        chosen.sort_unstable();
    }
    Ok(best)
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
    /// Displacements of all unknowns, from which it begins.
    start: Displacements,
    matrix: Vec<f64>,
    load: Vec<f64>,
}

impl<'c> Condensed<'c> {
    /// On `pairs`, to begin from displacements of all unknowns; or why that was stopped.
    fn new(
        equations: &Equations<'_>,
        bodies: &mut dyn Bodies,
        pairs: &'c [usize],
        start: Displacements,
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
        let size = places.len();
        let (matrix, load) = (vec![0.0; size * size], Vec::new());
        let mut made = Condensed { pairs, places, restriction, start, matrix, load };
        let at = made.with(equations, bodies, &vec![0.0; size])?;
        let forces = bodies.residual(&at.x, &at.low, equations.load)?;
        made.load = made.places.iter().map(|&i| -forces[i]).collect();
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
        self.places.len() < self.start.x.len()
    }

    /// The forces on the components where component `j` is moved by one.
    fn column(&self, bodies: &mut dyn Bodies, j: usize) -> Result<Vec<f64>, Error> {
        let mut x = vec![0.0; self.start.x.len()];
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
        let mut at = self.start.clone();
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

    /// The end of a path in the problem of the pairs; `None` if its data are none, as where rounding has left a
    /// stiffness that is not positive.
    fn by_path(
        &self,
        whole: &Equations<'_>,
        goal: Goal,
        monitor: &mut Monitor<'_>,
    ) -> Option<Candidate> {
        let problem = whole.contact.problem();
        let (dim, law) = (problem.dim(), problem.law());
        let gap: Vec<f64> = self.pairs.iter().map(|&pair| problem.gap(pair)).collect();
        let each = law.parameters();
        let of_law =
            self.pairs.iter().flat_map(|pair| &law.values()[each * pair..each * (pair + 1)]);
        let of_law: Vec<f64> = of_law.copied().collect();
        let slips = self
            .pairs
            .iter()
            .flat_map(|&pair| (0..dim - 1).map(move |c| problem.reference_slip(pair, c)));
        let slips: Vec<f64> = slips.collect();
        let data = ContactData {
            dim,
            pairs: self.pairs.len(),
            stiffness: &self.matrix,
            ld: self.places.len(),
            load: &self.load,
            gap: &gap,
            law: law.with_values(&of_law),
            reference_slip: Some(&slips),
        };
        let problem = ContactProblem::new(data).ok()?;
        let (contact, start) = (Contact::new(&problem), self.start_of_pairs());
        let settings = Settings { tolerance: goal.tolerance, ..Settings::default() };
        let follow = if dim == PLANE { path::linear } else { path::curved };
        Some(follow(&contact, &settings, Some(&start), monitor))
    }

    /// Where the pairs begin.
    fn start_of_pairs(&self) -> Vec<f64> {
        self.places.iter().map(|&i| self.start.x[i]).collect()
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
