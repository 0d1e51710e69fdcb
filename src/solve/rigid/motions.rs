//! The rigid motions of a problem: those that `K` does not resist.

use crate::linalg::gmres::extend_basis;
use crate::linalg::vector::{combination, dot, largest_of};
use crate::monitor::Watch;
use crate::problem::{ContactProblem, FreeBlock, Relation};

/// A space of rigid motions.
#[derive(Clone)]
pub struct RigidMotions {
    /// Roots of the units of the components.
    pub root: Vec<f64>,
    /// An orthonormal basis, each component times its `root`.
    pub basis: Vec<Vec<f64>>,
}

impl RigidMotions {
    /// The motions without internal force; `None` if there are none, or no time to find them.
    pub fn of(problem: &ContactProblem<'_>, monitor: &dyn Watch) -> Option<Self> {
        let n = problem.unknowns();
        if let Some(known) = problem.relation().free_motions {
            let motions = Self::spanned(problem, known.iter());
            return Some(motions).filter(|motions| !motions.basis.is_empty());
        }
        let block = FreeBlock::of_problem(problem, (0..n).collect(), &mut monitor.asking())?;
        Some(Self::of_block(problem, &block)).filter(|motions| !motions.basis.is_empty())
    }

    /// The motions that a block of a problem does not resist, and that move nothing beside it.
    pub fn of_block(problem: &ContactProblem<'_>, block: &FreeBlock<'_>) -> Self {
        Self::spanned(problem, block.null_vectors())
    }

    /// The multiples of one motion.
    pub fn along<R: Relation>(problem: &ContactProblem<'_, R>, motion: &[f64]) -> Self {
        Self::spanned(problem, std::iter::once(motion))
    }

    /// The sums of multiples of some motions.
    fn spanned<R: Relation>(
        problem: &ContactProblem<'_, R>,
        some: impl Iterator<Item = impl AsRef<[f64]>>,
    ) -> Self {
        let mut motions = RigidMotions { root: problem.unit_roots(), basis: Vec::new() };
        for motion in some {
            let scaled = motions.scaled(motion.as_ref());
            extend_basis(&mut motions.basis, scaled);
        }
        motions
    }

    /// Displacements, each component times its `root`.
    pub fn scaled(&self, d: &[f64]) -> Vec<f64> {
        d.iter().zip(&self.root).map(|(d, root)| d * root).collect()
    }

    /// Largest component of a motion, in the unit of `root`.
    pub fn size(&self, motion: &[f64]) -> f64 {
        largest_of(motion.iter().zip(&self.root).map(|(r, root)| r * root))
    }

    /// The rigid motion nearest to displacements.
    pub fn part(&self, d: &[f64]) -> Vec<f64> {
        self.motion(&self.coordinates(d))
    }

    /// The coordinates of the rigid motion nearest to displacements.
    pub fn coordinates(&self, d: &[f64]) -> Vec<f64> {
        let scaled = self.scaled(d);
        self.basis.iter().map(|v| dot(v, &scaled)).collect()
    }

    /// The motion with these coordinates.
    pub fn motion(&self, coordinates: &[f64]) -> Vec<f64> {
        let parts = coordinates.iter().copied().zip(&self.basis);
        let mut motion = combination(self.root.len(), parts);
        motion.iter_mut().zip(&self.root).for_each(|(motion, root)| *motion /= root);
        motion
    }
}
