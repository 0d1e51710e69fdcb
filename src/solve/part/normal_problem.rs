//! Frictionless contact condensed on the normal displacements.
//!
//! Tangential components, and normal ones without an obstacle, carry no contact force. Their condensation
//! leaves an LCP in `x = -d_n` with the lower bound `-gap` and the Schur complement `M` as its matrix.
//! The tension of pairs is a part of the load.
//! `K` may be singular: components that depend on others through a free motion are left out of the
//! factor, and no singular block is inverted.

use crate::certificate::is_escape_of;
use crate::law::Contact;
use crate::law::complementarity::{is_bounded, lower_bounds};
use crate::linalg::factor::cholesky_work;
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::monitor::Monitor;
use crate::problem::BoundedLcp;
use crate::problem::FreeBlock;
use crate::solve::result::Ending;

/// A frictionless problem, condensed.
pub struct NormalProblem<'p> {
    contact: &'p Contact<'p>,
    /// Normal components that the LCP keeps, in its order.
    kept: Vec<usize>,
    block: FreeBlock<'p>,
    at_rest: Vec<f64>,
    matrix: Vec<f64>,
    q: Vec<f64>,
    lower: Vec<f64>,
}

impl<'p> NormalProblem<'p> {
    /// Condenses. `Err`: why the problem cannot be condensed, which may be a proof that no equilibrium
    /// exists, or that there is no time for it.
    pub fn new(contact: &'p Contact<'p>, monitor: &mut Monitor<'_>) -> Result<Self, Ending> {
        let problem = contact.problem();
        let lower = lower_bounds(contact);
        let (normal, free): (Vec<usize>, Vec<usize>) =
            (0..contact.unknowns()).partition(|&i| is_bounded(contact, i));
        monitor.affords(cholesky_work(free.len()))?;
        let block = FreeBlock::of_problem(problem, free, &mut monitor.asking());
        let block = block.ok_or(INDEFINITE)?;
        let mut at_rest = vec![0.0; contact.unknowns()];
        block.equilibrate(contact.load_with_tension(), &mut at_rest);
        if let Some(motion) = driven_motion(contact, &block, &at_rest) {
            return Err(Ending::Recession(motion));
        }
        monitor.affords(block.schur_work(normal.len()))?;
        let whole = block.schur_complement(&normal, &mut monitor.asking()).ok_or(INDEFINITE)?;
        let size = normal.len();
        // A normal component whose motion nothing resists: its pair is closed if it is pushed, and
        // proves that no equilibrium exists if it is pulled.
        let (unresisted, resisted): (Vec<usize>, Vec<usize>) =
            (0..size).partition(|&k| whole[k + size * k] <= NEGLIGIBLE * problem.unit(normal[k]));
        let force = contact.force_without_tension(&at_rest);
        for &k in &unresisted {
            let i = normal[k];
            at_rest[i] = -lower[i];
            if contact.pairs()[i / contact.dim()].is_tensile(force[i]) {
                let mut motion = vec![0.0; contact.unknowns()];
                motion[i] = -1.0;
                block.follow(&mut motion);
                if is_escape_of(contact, &motion) {
                    return Err(Ending::Recession(motion));
                }
            }
        }
        block.equilibrate(contact.load_with_tension(), &mut at_rest);
        let kept: Vec<usize> = resisted.iter().map(|&k| normal[k]).collect();
        let entries = resisted.iter().flat_map(|&j| resisted.iter().map(move |&i| i + size * j));
        Ok(NormalProblem {
            matrix: entries.map(|entry| whole[entry]).collect(),
            q: kept.iter().map(|&i| -force[i]).collect(),
            lower: kept.iter().map(|&i| lower[i]).collect(),
            contact,
            kept,
            block,
            at_rest,
        })
    }

    /// The LCP that is left, in `x = -d_n`.
    pub fn lcp(&self) -> BoundedLcp<'_> {
        let size = self.kept.len();
        BoundedLcp {
            matrix: Matrix::new(size, &self.matrix, size.max(1)),
            q: &self.q,
            lower: &self.lower,
            symmetric: true,
            remembered: None,
        }
    }

    /// The components that are left, of any vector of all components.
    pub fn restrict(&self, values: &[f64]) -> Vec<f64> {
        self.kept.iter().map(|&i| values[i]).collect()
    }

    /// All displacements from the solution `x` of the LCP.
    pub fn expand(&self, x: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (&i, x) in self.kept.iter().zip(x) {
            d[i] = -x;
        }
        self.block.equilibrate(self.contact.load_with_tension(), &mut d);
        d
    }

    /// The motion of all components that follow the motion `x` of the LCP's without force.
    pub fn follow(&self, x: &[f64]) -> Vec<f64> {
        let mut motion = vec![0.0; self.contact.unknowns()];
        for (&i, x) in self.kept.iter().zip(x) {
            motion[i] = -x;
        }
        self.block.follow(&mut motion);
        motion
    }
}

/// `K` is no stiffness of a structure.
pub const INDEFINITE: Ending = Ending::Stalled("K is not positive semi-definite");

/// A motion of condensed components alone on which the loads do work, if there is one.
pub fn driven_motion(contact: &Contact<'_>, block: &FreeBlock<'_>, d: &[f64]) -> Option<Vec<f64>> {
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
