//! The matrix `W` of the flexibility form, dense or sparse.

use std::borrow::Cow;
use std::iter::{once, repeat_n};

use super::sparse_flexibility::SparseW;
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::{largest_eigenvalue, sizes};

/// A checked matrix `W`.
#[derive(Clone, Debug)]
pub enum FlexibilityForm<'a> {
    /// All entries.
    Dense(Matrix<'a>),
    /// The stored entries, and the islands of pairs that they tie to each other.
    Sparse(Cow<'a, SparseW>),
}

impl FlexibilityForm<'_> {
    /// `W F`.
    pub(super) fn times(&self, force: &[f64]) -> Vec<f64> {
        match self {
            FlexibilityForm::Dense(matrix) => matrix.product(force),
            FlexibilityForm::Sparse(matrix) => matrix.times(force),
        }
    }

    /// `W F - d`, in twice the precision and rounded once.
    pub(super) fn times_less(&self, force: &[f64], d: &[f64]) -> Vec<f64> {
        match self {
            FlexibilityForm::Dense(matrix) => {
                matrix.residual(force, &[], d, &matrix.magnitude(&sizes(force)))
            }
            FlexibilityForm::Sparse(matrix) => matrix.times_less(force, d),
        }
    }

    /// Units of force per length of all components, the same for all tangents of a pair of `dim` components.
    pub(super) fn units(&self, dim: usize) -> Vec<f64> {
        let (size, largest) = match self {
            FlexibilityForm::Dense(matrix) => (matrix.size(), matrix.largest_diagonal()),
            FlexibilityForm::Sparse(matrix) => (matrix.size(), matrix.largest_diagonal()),
        };
        let of_pair = |first: usize| match self {
            FlexibilityForm::Dense(matrix) => units_of_pair(&matrix.block(first, dim), largest),
            FlexibilityForm::Sparse(matrix) => {
                units_of_pair(&Matrix::contiguous(dim, &matrix.block(first)), largest)
            }
        };
        let each = (0..size).step_by(dim).map(of_pair);
        each.flat_map(|[normal, tangent]| once(normal).chain(repeat_n(tangent, dim - 1))).collect()
    }
}

/// The units of the normal and of the tangents of a pair with this block of `W`: `1 / W_nn`, and one over the
/// largest eigenvalue of the tangents. `otherwise` is the flexibility of a pair that nothing moves.
fn units_of_pair(block: &Matrix<'_>, otherwise: f64) -> [f64; 2] {
    let (dim, t) = (block.size(), 1);
    let last = dim - 1;
    let largest = largest_eigenvalue(block.at(t, t), block.at(last, t), block.at(last, last));
    let largest = if dim == 2 { block.at(t, t) } else { largest };
    // A pair that only its normal force moves: its tangents have the unit of the normal.
    let softest = largest.max(block.unit(t, dim, otherwise));
    [1.0 / block.unit(0, dim, otherwise), 1.0 / softest]
}
