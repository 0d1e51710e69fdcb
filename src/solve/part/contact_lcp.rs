//! The LCP of contact without friction, or in 2D, as `lcp::lemke::contact` states it.
//!
//! Tangential components without friction, and normal ones without an obstacle, carry no contact force and are condensed. `K`
//! may be singular: components that depend on others through a free motion are left out of the factor, and no singular
//! block is inverted. The tension of pairs is a part of the load.
//!
//! The matrix of the LCP is not stored: its columns are made from those of the stiffness when a tableau asks for them.

use std::borrow::Cow;

use crate::certificate::is_escape_of;
use crate::law::{Contact, Piece};
use crate::linalg::factor::cholesky_work;
use crate::linalg::packed::PackedSymmetric;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;
use crate::monitor::Watch;
use crate::problem::FreeBlock;
use crate::solve::result::Ending;

/// The LCP of a contact problem in the variables `(w, a, b)`.
pub struct ContactLcp<'p> {
    contact: &'p Contact<'p>,
    /// Components that carry no contact force are condensed.
    block: FreeBlock<'p>,
    at_rest: Vec<f64>,
    /// The others: normal, then tangential.
    normal: Vec<usize>,
    tangential: Vec<usize>,
    /// For each tangential component: the place of its pair in `normal`, and the slope of its bound; 0
    /// of a pair without an obstacle.
    coupling: Vec<(usize, f64)>,
    /// The stiffness of the components that are left, half of it: a tableau beside it is larger than `K`. `None`: nothing is
    /// condensed, and it is `K`.
    condensed: Option<PackedSymmetric>,
    /// Places of the components in it, normal, then tangential.
    places: Vec<usize>,
}

/// `K` is no stiffness of a structure.
const INDEFINITE: Ending = Ending::Stalled("K is not positive semi-definite");

impl<'p> ContactLcp<'p> {
    /// Condenses what carries no contact force. `Err`: why that is impossible, which may be a proof
    /// that no equilibrium exists.
    pub fn new(contact: &'p Contact<'p>, monitor: &dyn Watch) -> Result<Self, Ending> {
        let (problem, dim) = (contact.problem(), contact.dim());
        let is_frictionless = contact.is_frictionless();
        let (mut normal, mut tangential, mut free) = (Vec::new(), Vec::new(), Vec::new());
        let mut coupling = Vec::new();
        for (pair, law) in contact.pairs().iter().enumerate() {
            let touches = law.has_obstacle();
            let slips = (touches || law.has_friction()) && !is_frictionless;
            if slips {
                let slope = law.bound.slope;
                coupling.push(if touches { (normal.len(), slope) } else { (0, 0.0) });
            }
            if touches { &mut normal } else { &mut free }.push(dim * pair);
            if slips { &mut tangential } else { &mut free }
                .extend(dim * pair + 1..dim * (pair + 1));
        }
        let indices: Vec<usize> = normal.iter().chain(&tangential).copied().collect();
        let condenses = !free.is_empty();
        monitor.affords(cholesky_work(free.len()))?;
        let block = FreeBlock::of_problem(problem, free, &mut monitor.asking());
        let block = block.ok_or(INDEFINITE)?;
        let mut at_rest = vec![0.0; contact.unknowns()];
        for &i in &indices {
            at_rest[i] = contact.pairs()[i / dim].reference()[i % dim];
        }
        block.equilibrate(contact.load_with_tension(), &mut at_rest);
        if let Some(motion) = driven_motion(contact, &block, &at_rest) {
            return Err(Ending::Recession(motion));
        }
        let (mut condensed, mut places) = (None, indices);
        if condenses {
            monitor.affords(block.factor.schur_work(places.len()))?;
            let schur = block.schur_complement(&places, &mut monitor.asking());
            condensed = Some(PackedSymmetric::new(places.len(), schur.ok_or(INDEFINITE)?));
            places = (0..places.len()).collect();
        }
        Ok(ContactLcp { contact, block, at_rest, normal, tangential, coupling, condensed, places })
    }

    /// Gives clearances of a frictionless problem that nothing resists the stiffness of their units in its `matrix`. They are
    /// closed if they are pushed; returned is the motion of one that is pulled, if it proves that no equilibrium exists.
    pub fn stiffen_unresisted(&self, matrix: &mut [f64], q: &[f64]) -> Option<Vec<f64>> {
        let (size, problem) = (self.places.len(), self.contact.problem());
        let diagonal = matrix.iter_mut().step_by(size + 1);
        let mut pulled = vec![0.0; size];
        for (k, (&i, own)) in self.normal.iter().zip(diagonal).enumerate() {
            if *own <= NEGLIGIBLE * problem.unit(i) {
                *own = problem.unit(i);
                pulled[k] = f64::from(u8::from(q[k] < 0.0));
            }
        }
        let motion = self.motion(&pulled);
        is_escape_of(self.contact, &motion).then_some(motion)
    }

    /// The variables of a frictionless problem at displacements.
    pub fn clearances(&self, d: &[f64]) -> Vec<f64> {
        self.normal.iter().map(|&i| self.at_rest[i] - d[i]).collect()
    }

    /// `q`, a covering vector with these cohesions against slip to either side, and roots of the units of all variables.
    pub fn vectors(&self, cohesion: [f64; 2]) -> [Vec<f64>; 3] {
        let problem = self.contact.problem();
        let force = self.contact.force_without_tension(&self.at_rest);
        let root = |i: &usize| problem.unit(*i).sqrt();
        let mut q: Vec<f64> = self.normal.iter().map(|&i| -force[i]).collect();
        let mut covering: Vec<f64> = self.normal.iter().map(root).collect();
        for (side, cohesion) in [1.0, -1.0].into_iter().zip(cohesion) {
            for (i, &(normal, slope)) in self.tangential.iter().zip(&self.coupling) {
                let coupled =
                    |values: &[f64]| values.get(normal).map_or(0.0, |value| slope * value);
                let (bound, clamp) = (coupled(&q), coupled(&covering));
                let offset = self.contact.pairs()[i / 2].bound.offset;
                q.push(bound + offset + side * force[*i]);
                covering.push(clamp + cohesion * root(i));
            }
        }
        let components = self.normal.iter().chain(&self.tangential).chain(&self.tangential);
        [q, covering, components.map(root).collect()]
    }

    /// All displacements of a point of the path.
    pub fn displacements(&self, z: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (d, motion) in d.iter_mut().zip(self.motion_of_variables(z)) {
            *d += motion;
        }
        self.block.equilibrate(self.contact.load_with_tension(), &mut d);
        d
    }

    /// The motion of all components along a ray.
    pub fn motion(&self, ray: &[f64]) -> Vec<f64> {
        let mut motion = self.motion_of_variables(ray);
        // Below a tenth of what counts as rigid in the certificate: digits that rounding has left.
        let least = NEGLIGIBLE / 10.0 * norm_inf(&motion);
        motion.iter_mut().filter(|r| r.abs() < least).for_each(|r| *r = 0.0);
        self.block.follow(&mut motion);
        motion
    }

    fn motion_of_variables(&self, z: &[f64]) -> Vec<f64> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let mut motion = vec![0.0; self.contact.unknowns()];
        for (k, &i) in self.normal.iter().enumerate() {
            motion[i] = -z[k];
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            motion[i] = z[n + k] - z[n + m + k];
        }
        motion
    }

    /// The pieces of a point of the path.
    pub fn pieces(&self, z: &[f64]) -> Vec<Piece> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let mut variables = vec![[0.0; 3]; self.contact.pairs().len()];
        for (k, &i) in self.normal.iter().enumerate() {
            variables[i / self.contact.dim()][0] = z[k];
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            (variables[i / 2][1], variables[i / 2][2]) = (z[n + k], z[n + m + k]);
        }
        let laws = self.contact.pairs().iter();
        laws.zip(variables).map(|(law, [w, a, b])| law.piece_of_variables(w, a, b)).collect()
    }

    /// Writes column `j` of the matrix.
    pub fn write_column(&self, j: usize, column: &mut [f64]) {
        let (n, m) = (self.normal.len(), self.tangential.len());
        // Variable j moves one component: a clearance, or a slip to one side.
        let (component, sign) = match j {
            j if j < n => (j, -1.0),
            j if j < n + m => (j, 1.0),
            j => (j - m, -1.0),
        };
        let place = self.places[component];
        let source = match &self.condensed {
            Some(stiffness) => Cow::Owned(stiffness.column(place)),
            None => Cow::Borrowed(self.contact.problem().column(place)),
        };
        let (clearances, slips) = column.split_at_mut(n);
        let (forward, backward) = slips.split_at_mut(m);
        for (i, entry) in clearances.iter_mut().enumerate() {
            *entry = -sign * source[self.places[i]];
        }
        let sides = forward.iter_mut().zip(backward).zip(&self.coupling).enumerate();
        for (k, ((forward, backward), &(normal, slope))) in sides {
            let bound = clearances.get(normal).map_or(0.0, |clearance| slope * clearance);
            let force = sign * source[self.places[n + k]];
            (*forward, *backward) = (bound + force, bound - force);
        }
    }
}

/// A motion of condensed components alone on which the loads do work, if there is one.
fn driven_motion(contact: &Contact<'_>, block: &FreeBlock<'_>, d: &[f64]) -> Option<Vec<f64>> {
    let problem = contact.problem();
    block.dependent().next()?;
    let force = contact.force_without_tension(d);
    let mut motion = vec![0.0; contact.unknowns()];
    for i in block.dependent() {
        motion[i] = -force[i] / problem.unit(i);
    }
    block.follow(&mut motion);
    is_escape_of(contact, &motion).then_some(motion)
}
