//! The pairs that may touch, condensed into a small dense problem, which is solved as any other one.
//!
//! With `C` the components of these pairs and `R` the inner unknowns and all other pairs, which are open,
//!
//! ```text
//! S = A_CC - A_CR A_RR⁻¹ A_RC,        F_C = S d_C - (F_C where d_C = 0)
//! ```
//!
//! take one solution with `C` held, and one product, for each component. Where nothing can be held `C` are all pairs,
//! and products alone are taken. Pairs that penetrate then join `C`. Newton's method goes on from the solution.

use super::memory::{memory_of_components, room};
use super::newton::{self, Outcome, improve};
use super::point::{Displacements, Equations};
use super::session::{Halted, Session};
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::{Monitor, Stop};
use crate::problem::{ContactData, ContactProblem, HeldSet, SOLUTIONS};
use crate::settings::Settings;
use crate::solve::part::{PairData, closed_with_margin};
use crate::solve::plan;
use crate::solve::result::Status;

/// Most components of `C`: a system of the dense problem takes a second, and it may take a thousand of them.
const MOST_COMPONENTS: usize = 3000;

/// Goes on from a try that has failed.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut Session<'_>,
    _start: &Displacements,
    best: &mut Outcome,
    tolerance: f64,
    monitor: &mut Monitor<'_>,
) -> Result<(), Halted> {
    let most = room(equations.load.len());
    let fits = |pairs: &[usize]| {
        let components = pairs.len() * equations.contact.dim();
        components <= MOST_COMPONENTS && memory_of_components(components) <= most
    };
    let laws = equations.contact.pairs();
    let mut chosen = match bodies.operator.can_hold() {
        true => closed_with_margin(laws, &best.point.y),
        false => (0..laws.len()).collect(),
    };
    let mut start = best.point.at.clone();
    while fits(&chosen) {
        let condensed = Condensed::new(equations, bodies, &chosen, start, monitor)?;
        let Some(d) = condensed.solution(equations, &chosen, tolerance, monitor)? else { break };
        let at = condensed.with(equations, bodies, &d)?;
        let point = equations.held_at(at, bodies)?;
        let closing: Vec<usize> = (0..point.pieces.len())
            .filter(|pair| point.pieces[*pair].closed && chosen.binary_search(pair).is_err())
            .collect();
        if closing.is_empty() {
            improve(best, newton::solve(equations, bodies, point, tolerance, monitor)?);
            break;
        }
        start = point.at;
        chosen.extend(closing);
        chosen.sort_unstable();
    }
    Ok(())
}

/// Bodies condensed on some pairs.
struct Condensed {
    /// Places of the components among all unknowns.
    places: Vec<usize>,
    /// Displacements of all unknowns, from which it begins.
    start: Displacements,
    /// Column-major.
    matrix: Vec<f64>,
    load: Vec<f64>,
}

impl Condensed {
    /// The bodies on `pairs`, to begin from displacements of all unknowns.
    fn new(
        equations: &Equations<'_>,
        bodies: &mut Session<'_>,
        pairs: &[usize],
        start: Displacements,
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, Halted> {
        let (dim, inner) = (equations.contact.dim(), equations.inner);
        let mut held_set = HeldSet::all(dim, equations.contact.pairs().len());
        held_set.held.fill(false);
        let own: Vec<usize> = pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1)).collect();
        own.iter().for_each(|&i| held_set.held[i] = true);
        bodies.hold_under(&held_set, monitor)?;
        let places: Vec<usize> = own.iter().map(|i| inner + i).collect();
        let size = places.len();
        let mut condensed =
            Condensed { places, start, matrix: vec![0.0; size * size], load: Vec::new() };
        let at = condensed.with(equations, bodies, &vec![0.0; size])?;
        let forces = bodies.operator.residual(&at.x, &at.low, equations.load)?;
        condensed.load = condensed.places.iter().map(|&i| -forces[i]).collect();
        for j in 0..size {
            monitor.goes_on()?;
            let column = condensed.column(bodies, j)?;
            condensed.matrix[size * j..size * (j + 1)].copy_from_slice(&column);
        }
        symmetrise(&mut condensed.matrix, size);
        Ok(condensed)
    }

    /// True if there are other unknowns.
    fn has_others(&self) -> bool {
        self.places.len() < self.start.x.len()
    }

    /// The forces on the components where component `j` is moved by one.
    fn column(&self, bodies: &mut Session<'_>, j: usize) -> Result<Vec<f64>, Error> {
        let mut x = vec![0.0; self.start.x.len()];
        x[self.places[j]] = 1.0;
        let mut forces = bodies.operator.product(&x)?;
        if self.has_others() {
            let mut others = bodies.solve(&forces)?;
            self.places.iter().for_each(|&i| others[i] = 0.0);
            let taken = bodies.operator.product(&others)?;
            forces.iter_mut().zip(taken).for_each(|(force, taken)| *force -= taken);
        }
        Ok(self.places.iter().map(|&i| forces[i]).collect())
    }

    /// All unknowns where the components have the displacements `d` and the others carry no contact forces.
    fn with(
        &self,
        equations: &Equations<'_>,
        bodies: &mut Session<'_>,
        d: &[f64],
    ) -> Result<Displacements, Error> {
        let mut at = self.start.clone();
        self.places.iter().zip(d).for_each(|(&i, d)| at.x[i] = *d);
        if self.has_others() {
            for _ in 0..=SOLUTIONS {
                let lack = bodies.operator.residual(&at.x, &at.low, equations.load)?;
                let mut step = bodies.solve(&lack)?;
                self.places.iter().for_each(|&i| step[i] = 0.0);
                at = at.moved(-1.0, &step);
            }
        }
        Ok(at)
    }

    /// Displacements of the components that solve the dense problem; `None` if there are none, or if its data are
    /// none, as where rounding has left a stiffness that is not positive.
    fn solution(
        &self,
        whole: &Equations<'_>,
        pairs: &[usize],
        tolerance: f64,
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Vec<f64>>, Halted> {
        let problem = whole.contact.problem();
        let own = PairData::of(problem, pairs);
        let data = ContactData {
            dim: problem.dim(),
            pairs: pairs.len(),
            stiffness: &self.matrix,
            ld: self.places.len(),
            load: &self.load,
            gap: &own.gap,
            law: problem.law().with_values(&own.parameters),
            reference_slip: Some(&own.slip),
        };
        let Ok(problem) = ContactProblem::new(data) else { return Ok(None) };
        let start: Vec<f64> = self.places.iter().map(|&i| self.start.x[i]).collect();
        let settings = Settings { tolerance, ..Settings::default() };
        let found = plan::auto(&Contact::new(&problem), &settings, Some(&start), monitor)?;
        Ok(match found.status {
            Status::Solved => Some(found.d),
            Status::IterationLimit => return Err(Stop::IterationLimit.into()),
            Status::TimeLimit => return Err(Stop::TimeLimit.into()),
            Status::Cancelled => return Err(Stop::Cancelled.into()),
            _ => None,
        })
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
