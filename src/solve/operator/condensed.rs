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
use super::newton::{self, Tried, improve};
use super::point::{Displacements, Equations, Point};
use super::session::Session;
use crate::certificate::is_spread_escape;
use crate::law::{Contact, PairLaw};
use crate::monitor::Watch;
use crate::problem::{ContactData, ContactProblem, HeldSet, SOLUTIONS};
use crate::settings::Settings;
use crate::solve::part::{PairData, closed_with_margin};
use crate::solve::plan;
use crate::solve::result::{Call, Ending, Solution, Status};

/// Most components of `C`: a system of the dense problem takes a second, and it may take a thousand of them.
const MOST_COMPONENTS: usize = 3000;

/// True if a dense problem of so many components fits into the time and the memory of one of so many inner unknowns and
/// components in all.
pub fn fits(components: usize, (inner, all): (usize, usize)) -> bool {
    components <= MOST_COMPONENTS && memory_of_components(components) <= room(inner, all)
}

/// Goes on from a try that has failed.
pub fn solve(tried: &mut Tried<'_, '_>) -> Result<(), Ending> {
    let Tried { equations, bodies, best, .. } = tried;
    if !bodies.operator.is_exact() {
        return Ok(());
    }
    let laws = equations.contact.pairs();
    let mut chosen = match bodies.operator.can_hold() {
        true => closed_with_margin(laws, &best.point.y),
        false => (0..laws.len()).collect(),
    };
    let mut at = best.point.at.clone();
    let sizes = (equations.inner, equations.contact.unknowns());
    while fits(equations.contact.dim() * chosen.len(), sizes) {
        let condensed = Condensed::new(equations, bodies, &chosen, &at)?;
        let found = condensed.solved(equations, &chosen, &at, bodies.monitor)?;
        let (joins, solved): (Vec<bool>, Option<Point>) = match found {
            Some(Solution { status: Status::Solved, d, .. }) => {
                let point = condensed.with(bodies, at, (&d, equations.load))?;
                let point = equations.held_at(point, bodies)?;
                at = point.at.clone();
                (point.pieces.iter().map(|piece| piece.closed).collect(), Some(point))
            }
            Some(Solution { status: Status::NoEquilibrium, recession: Some(motion), .. }) => {
                let rest = Displacements::zero(equations.load.len(), equations.inner);
                let unloaded = vec![0.0; equations.load.len()];
                let motion = condensed.with(bodies, rest, (&motion, &unloaded))?.x;
                if is_spread_escape(equations.contact, bodies.operator, &motion)? {
                    return Err(Ending::Recession(motion));
                }
                let parts = motion[equations.inner..].chunks_exact(equations.contact.dim());
                let approaches = |(law, r): (&PairLaw, &[f64])| law.recession(r).approach > 0.0;
                (laws.iter().zip(parts).map(approaches).collect(), None)
            }
            _ => break,
        };
        let before = chosen.len();
        chosen = (0..laws.len()).filter(|k| joins[*k] || chosen.binary_search(k).is_ok()).collect();
        if chosen.len() == before {
            if let Some(point) = solved {
                improve(best, newton::solve(equations, bodies, point)?);
            }
            break;
        }
    }
    Ok(())
}

/// Bodies condensed on some pairs.
struct Condensed {
    /// Places of the components among all unknowns.
    places: Vec<usize>,
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
    ) -> Result<Self, Ending> {
        let (dim, inner) = (equations.contact.dim(), equations.inner);
        let mut held_set = HeldSet::none(dim, equations.contact.pairs().len());
        let own: Vec<usize> = pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1)).collect();
        own.iter().for_each(|&i| held_set.held[i] = true);
        bodies.hold_under(&held_set)?;
        let places: Vec<usize> = own.iter().map(|i| inner + i).collect();
        let size = places.len();
        let mut condensed = Condensed { places, matrix: vec![0.0; size * size], load: Vec::new() };
        let (near, nothing) = (near.clone(), vec![0.0; size]);
        let at = condensed.with(bodies, near, (&nothing, equations.load))?;
        let forces = bodies.residual(&at.x, &at.low, equations.load)?;
        condensed.load = condensed.places.iter().map(|&i| -forces[i]).collect();
        for j in 0..size {
            let column = condensed.column(bodies, j)?;
            condensed.matrix[size * j..size * (j + 1)].copy_from_slice(&column);
        }
        // Entries that are equal but for rounding become their mean.
        for (i, j) in (0..size).flat_map(|j| (0..j).map(move |i| (i, j))) {
            let (above, below) = (i + size * j, j + size * i);
            let mean = f64::midpoint(condensed.matrix[above], condensed.matrix[below]);
            (condensed.matrix[above], condensed.matrix[below]) = (mean, mean);
        }
        Ok(condensed)
    }

    /// The forces on the components where component `j` is moved by one.
    fn column(&self, bodies: &mut Session<'_>, j: usize) -> Result<Vec<f64>, Ending> {
        bodies.monitor.goes_on()?;
        let mut x = vec![0.0; bodies.operator.units().len()];
        x[self.places[j]] = 1.0;
        let mut forces = bodies.product(&x)?;
        if bodies.has_free_unknowns() {
            let others = bodies.solve(&forces)?;
            let taken = bodies.product(&others)?;
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
    ) -> Result<Displacements, Ending> {
        self.places.iter().zip(d).for_each(|(&i, d)| at.x[i] = *d);
        for _ in 0..=SOLUTIONS {
            at = at.in_equilibrium(bodies, (load, 0.0))?;
        }
        Ok(at)
    }

    /// The result of the dense problem, in displacements of its components, from displacements of all unknowns. `None`: its
    /// data are none, as where rounding has left a stiffness that is not positive.
    fn solved(
        &self,
        whole: &Equations<'_>,
        pairs: &[usize],
        start: &Displacements,
        monitor: &dyn Watch,
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
        let found = plan::solve(&Call::new(contact, &settings, monitor).from(&start))?;
        found.status.stop().map_or(Ok(Some(found)), |stop| Err(stop.into()))
    }
}
