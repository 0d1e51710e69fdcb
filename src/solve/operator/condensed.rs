//! The pairs that may touch, condensed into a small dense problem, which is solved as any other one.
//!
//! With `C` the components of these pairs and `R` the inner unknowns and all other pairs, which are open,
//!
//! ```text
//! S = A_CC - A_CR A_RR⁻¹ A_RC,        F_C = S d_C - (F_C where d_C = 0)
//! ```
//!
//! take one solution with `C` held, and one product, for each component. Where nothing can be held `C` are all pairs,
//! and products alone are taken; without a factor nothing is condensed. Pairs that penetrate then join `C`. Newton's method goes on from the solution. Where
//! the dense problem has no equilibrium, its motion is continued to all unknowns, and the certificate judges it.

use super::memory::{memory_of_components, room};
use super::newton::{self, Outcome, improve};
use super::point::{Displacements, Equations};
use super::session::Session;
use crate::certificate::is_spread_escape;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::problem::{ContactData, ContactProblem, HeldSet, SOLUTIONS};
use crate::settings::Settings;
use crate::solve::part::{PairData, closed_with_margin};
use crate::solve::plan;
use crate::solve::result::{Call, Ending, Solution, Status};

/// Most components of `C`: a system of the dense problem takes a second, and it may take a thousand of them.
const MOST_COMPONENTS: usize = 3000;

/// True if a dense problem of so many components fits into the time and the memory of one of so many unknowns.
pub fn fits(components: usize, unknowns: usize) -> bool {
    components <= MOST_COMPONENTS && memory_of_components(components) <= room(unknowns)
}

/// Goes on from a try that has failed.
pub fn solve(
    equations: &Equations<'_>,
    bodies: &mut Session<'_>,
    _start: &Displacements,
    best: &mut Outcome,
    monitor: &mut Monitor<'_>,
) -> Result<(), Ending> {
    if !bodies.operator.is_exact() {
        return Ok(());
    }
    let laws = equations.contact.pairs();
    let mut chosen = match bodies.operator.can_hold() {
        true => closed_with_margin(laws, &best.point.y),
        false => (0..laws.len()).collect(),
    };
    let mut at = best.point.at.clone();
    while fits(equations.contact.dim() * chosen.len(), equations.load.len()) {
        let condensed = Condensed::new(equations, bodies, &chosen, &at, monitor)?;
        let found = condensed.solved(equations, &chosen, &at, monitor)?;
        let joins: Vec<bool> = match found {
            Some(Solution { status: Status::Solved, d, .. }) => {
                let point = condensed.with(bodies, at, (&d, equations.load), monitor)?;
                let point = equations.held_at(point, bodies)?;
                let closed: Vec<bool> = point.pieces.iter().map(|piece| piece.closed).collect();
                at = point.at.clone();
                if (0..laws.len()).all(|k| !closed[k] || chosen.binary_search(&k).is_ok()) {
                    improve(best, newton::solve(equations, bodies, point, monitor)?);
                    break;
                }
                closed
            }
            Some(Solution { status: Status::NoEquilibrium, recession: Some(motion), .. }) => {
                let motion = condensed.motion(equations, bodies, &motion, monitor)?;
                if is_spread_escape(equations.contact, bodies.operator, &motion)? {
                    return Err(Ending::Recession(motion));
                }
                let parts = motion[equations.inner..].chunks_exact(equations.contact.dim());
                laws.iter().zip(parts).map(|(law, r)| law.recession(r).approach > 0.0).collect()
            }
            _ => break,
        };
        let before = chosen.len();
        chosen = (0..laws.len()).filter(|k| joins[*k] || chosen.binary_search(k).is_ok()).collect();
        if chosen.len() == before {
            break;
        }
    }
    Ok(())
}

/// Bodies condensed on some pairs.
struct Condensed {
    /// Places of the components among all unknowns.
    places: Vec<usize>,
    /// Number of all unknowns.
    unknowns: usize,
    /// Column-major.
    matrix: Vec<f64>,
    load: Vec<f64>,
}

impl Condensed {
    /// The bodies on `pairs`, near displacements of all unknowns.
    fn new(
        equations: &Equations<'_>,
        bodies: &mut Session<'_>,
        pairs: &[usize],
        near: &Displacements,
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, Ending> {
        let (dim, inner) = (equations.contact.dim(), equations.inner);
        let mut held_set = HeldSet::none(dim, equations.contact.pairs().len());
        let own: Vec<usize> = pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1)).collect();
        own.iter().for_each(|&i| held_set.held[i] = true);
        bodies.hold_under(&held_set, monitor)?;
        let places: Vec<usize> = own.iter().map(|i| inner + i).collect();
        let (size, unknowns) = (places.len(), equations.load.len());
        let (matrix, load) = (vec![0.0; size * size], Vec::new());
        let mut condensed = Condensed { places, unknowns, matrix, load };
        let at = {
            let nothing = vec![0.0; size];
            condensed.with(bodies, near.clone(), (&nothing, equations.load), monitor)?
        };
        let forces = bodies.operator.residual(&at.x, &at.low, equations.load)?;
        condensed.load = condensed.places.iter().map(|&i| -forces[i]).collect();
        for j in 0..size {
            let column = condensed.column(bodies, j, monitor)?;
            condensed.matrix[size * j..size * (j + 1)].copy_from_slice(&column);
        }
        symmetrise(&mut condensed.matrix, size);
        Ok(condensed)
    }

    /// True if there are other unknowns.
    fn has_others(&self) -> bool {
        self.places.len() < self.unknowns
    }

    /// The forces on the components where component `j` is moved by one.
    fn column(
        &self,
        bodies: &mut Session<'_>,
        j: usize,
        monitor: &mut Monitor<'_>,
    ) -> Result<Vec<f64>, Ending> {
        monitor.goes_on()?;
        let mut x = vec![0.0; self.unknowns];
        x[self.places[j]] = 1.0;
        let mut forces = bodies.operator.product(&x)?;
        if self.has_others() {
            let mut others = bodies.solve(&forces, monitor)?;
            self.places.iter().for_each(|&i| others[i] = 0.0);
            let taken = bodies.operator.product(&others)?;
            forces.iter_mut().zip(taken).for_each(|(force, taken)| *force -= taken);
        }
        Ok(self.places.iter().map(|&i| forces[i]).collect())
    }

    /// All unknowns under a load where the components have the displacements `d` and the others carry no contact
    /// forces, from displacements near them.
    fn with(
        &self,
        bodies: &mut Session<'_>,
        mut at: Displacements,
        (d, load): (&[f64], &[f64]),
        monitor: &mut Monitor<'_>,
    ) -> Result<Displacements, Ending> {
        self.places.iter().zip(d).for_each(|(&i, d)| at.x[i] = *d);
        if self.has_others() {
            for _ in 0..=SOLUTIONS {
                let lack = bodies.operator.residual(&at.x, &at.low, load)?;
                let mut step = bodies.solve(&lack, monitor)?;
                self.places.iter().for_each(|&i| step[i] = 0.0);
                at = at.moved(-1.0, &step);
            }
        }
        Ok(at)
    }

    /// A motion of the components, continued to all unknowns.
    fn motion(
        &self,
        equations: &Equations<'_>,
        bodies: &mut Session<'_>,
        d: &[f64],
        monitor: &mut Monitor<'_>,
    ) -> Result<Vec<f64>, Ending> {
        let nothing = vec![0.0; self.unknowns];
        let rest = Displacements::new(nothing.clone(), equations.inner);
        Ok(self.with(bodies, rest, (d, &nothing), monitor)?.x)
    }

    /// The result of the dense problem, in displacements of its components, from displacements of all unknowns. `None`: its
    /// data are none, as where rounding has left a stiffness that is not positive.
    fn solved(
        &self,
        whole: &Equations<'_>,
        pairs: &[usize],
        start: &Displacements,
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Solution>, Ending> {
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
        let contact = &Contact::new(&problem);
        let start: Vec<f64> = self.places.iter().map(|&i| start.x[i]).collect();
        let settings = Settings { tolerance: whole.tolerance, ..Settings::default() };
        let found = plan::solve(&Call::new(contact, &settings).from(&start), monitor)?;
        found.status.stop().map_or(Ok(Some(found)), |stop| Err(stop.into()))
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
