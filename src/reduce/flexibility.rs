//! A flexibility of the host, `d = W F + q`: nothing is reduced.

use std::borrow::Cow;

use super::Reduction;
use super::sparse::SparseMatrix;
use crate::error::Error;
use crate::linalg::matrix::Matrix;
use crate::problem::{Flexibility, FlexibilityForm, SparseW};

/// The flexibility of pairs. Loads of the host are free displacements `q`, and displacements are `d`.
pub enum FlexibilityReduction {
    /// The number of rows, and all entries, column-major.
    Dense(usize, Vec<f64>),
    /// The entries that are stored.
    Sparse(SparseW),
}

impl FlexibilityReduction {
    /// A dense matrix of `size` rows with `ld` entries from one column to the next.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_flexibility`] of the matrix.
    pub fn dense(size: usize, w: &[f64], ld: usize) -> Result<Self, Error> {
        let matrix = Flexibility::checked_matrix(size, (w, ld))?;
        Ok(FlexibilityReduction::Dense(size, matrix.entries().collect()))
    }

    /// A sparse matrix.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_sparse`] of the matrix.
    pub fn sparse(dim: usize, pairs: usize, w: &SparseMatrix<'_>) -> Result<Self, Error> {
        SparseW::from_sparse(dim, pairs, w).map(FlexibilityReduction::Sparse)
    }
}

impl Reduction for FlexibilityReduction {
    fn flexibility(&self) -> Option<FlexibilityForm<'_>> {
        Some(match self {
            Self::Dense(size, entries) => {
                FlexibilityForm::Dense(Matrix::contiguous(*size, entries))
            }
            Self::Sparse(w) => FlexibilityForm::Sparse(Cow::Borrowed(w)),
        })
    }

    fn host_size(&self) -> usize {
        match self {
            Self::Dense(size, _) => *size,
            Self::Sparse(w) => w.size(),
        }
    }
}
