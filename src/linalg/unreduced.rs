//! A sparse matrix from which components were eliminated, for the energies of motions.

use super::free_motions::Whole;
use super::sparse_matrix::{Csc, column, symmetric_magnitude};
use super::vector::{dot, sizes};

/// Solves for the eliminated rows: from a right side of all rows and the kept components to all.
type Recover<'f> = dyn Fn(&[f64], &[f64]) -> Vec<f64> + 'f;

/// The matrix before the elimination, with its factor.
pub struct Unreduced<'f> {
    lower: Csc,
    recover: &'f Recover<'f>,
}

impl<'f> Unreduced<'f> {
    /// The matrix whose lower triangle is `lower`, and the solution of its eliminated rows.
    pub fn new(lower: Csc, recover: &'f Recover<'f>) -> Self {
        Unreduced { lower, recover }
    }
}

impl Whole for Unreduced<'_> {
    /// With one step of iterative refinement.
    fn extended(&self, kept: &[f64]) -> Vec<f64> {
        let mut motion = (self.recover)(&vec![0.0; self.lower.ncols()], kept);
        let correction = (self.recover)(&self.forces(&motion), &vec![0.0; kept.len()]);
        motion.iter_mut().zip(&correction).for_each(|(x, correction)| *x -= correction);
        motion
    }

    fn forces(&self, motion: &[f64]) -> Vec<f64> {
        let mut forces = vec![0.0; motion.len()];
        for j in 0..self.lower.ncols() {
            let (rows, values) = column(&self.lower, j);
            let (moved, mut own) = (motion[j], 0.0);
            for (&i, value) in rows.iter().zip(values) {
                forces[i] += value * moved;
                own += if i == j { 0.0 } else { value * motion[i] };
            }
            forces[j] += own;
        }
        forces
    }

    fn noise(&self, motion: &[f64]) -> f64 {
        let size = sizes(motion);
        f64::EPSILON * dot(&size, &symmetric_magnitude(&self.lower, &size))
    }
}
