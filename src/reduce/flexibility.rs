//! A flexibility of the host, `d = W F + q`: nothing is reduced.

use std::borrow::Cow;

use super::Reduction;
use super::sparse::SparseMatrix;
use crate::error::Error;
use crate::linalg::matrix::Matrix;
use crate::problem::{Flexibility, FlexibilityForm, SparseW};

/// The flexibility of pairs. Loads of the host are free displacements `q`, and displacements are `d`.
pub struct FlexibilityReduction {
    size: usize,
    /// All entries, column-major, of a dense `W`.
    dense: Vec<f64>,
    sparse: Option<SparseW>,
}

impl FlexibilityReduction {
    /// A dense matrix of `size` rows with `ld` entries from one column to the next.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_flexibility`] of the matrix.
    pub fn dense(size: usize, w: &[f64], ld: usize) -> Result<Self, Error> {
        let matrix = Flexibility::checked_matrix(size, (w, ld))?;
        let dense = (0..size).flat_map(|j| matrix.column(j).to_vec()).collect();
        Ok(FlexibilityReduction { size, dense, sparse: None })
    }

    /// A sparse matrix.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_sparse`] of the matrix.
    pub fn sparse(dim: usize, pairs: usize, w: &SparseMatrix<'_>) -> Result<Self, Error> {
        let sparse = SparseW::from_sparse(dim, pairs, w)?;
        let size = sparse.size();
        Ok(FlexibilityReduction { size, dense: Vec::new(), sparse: Some(sparse) })
    }
}

impl Reduction for FlexibilityReduction {
    fn flexibility(&self) -> Option<FlexibilityForm<'_>> {
        let dense =
            || FlexibilityForm::Dense(Matrix::new(self.size, &self.dense, self.size.max(1)));
        let sparse = |w| FlexibilityForm::Sparse(Cow::Borrowed(w));
        Some(self.sparse.as_ref().map_or_else(dense, sparse))
    }

    fn host_size(&self) -> usize {
        self.size
    }
}
