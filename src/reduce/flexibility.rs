//! A flexibility of the host, `d = W F + q`: nothing is reduced.

use std::borrow::Cow;

use super::sparse::SparseMatrix;
use super::{Reduction, motion};
use crate::error::{Error, Message};
use crate::linalg::matrix::Matrix;
use crate::problem::{Flexibility, FlexibilityForm, SparseW};

/// The flexibility of pairs. Loads of the host are free displacements `q`, and displacements are `d`.
pub struct FlexibilityReduction {
    dim: usize,
    size: usize,
    /// All entries, column-major, of a dense `W`.
    dense: Vec<f64>,
    sparse: Option<SparseW>,
}

impl FlexibilityReduction {
    /// A dense matrix of `size` rows, `dim` for each pair, with `ld` entries from one column to the next.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_flexibility`] of the matrix.
    pub fn dense(dim: usize, size: usize, w: &[f64], ld: usize) -> Result<Self, Error> {
        let matrix = Flexibility::checked_matrix(size, w, ld)?;
        let dense = (0..size).flat_map(|j| matrix.column(j).to_vec()).collect();
        Ok(FlexibilityReduction { dim, size, dense, sparse: None })
    }

    /// A sparse matrix.
    ///
    /// # Errors
    /// As [`crate::FlexibilityProblem::from_sparse`] of the matrix.
    pub fn sparse(dim: usize, pairs: usize, w: &SparseMatrix<'_>) -> Result<Self, Error> {
        let sparse = SparseW::from_sparse(dim, pairs, w)?;
        let size = sparse.size();
        Ok(FlexibilityReduction { dim, size, dense: Vec::new(), sparse: Some(sparse) })
    }
}

impl Reduction for FlexibilityReduction {
    fn stiffness(&self) -> &[f64] {
        &[]
    }

    fn flexibility(&self) -> Option<FlexibilityForm<'_>> {
        let dense =
            || FlexibilityForm::Dense(Matrix::new(self.size, &self.dense, self.size.max(1)));
        let sparse = |w| FlexibilityForm::Sparse(Cow::Borrowed(w));
        Some(self.sparse.as_ref().map_or_else(dense, sparse))
    }

    fn host_size(&self) -> usize {
        self.size
    }

    fn motion_in_words(&self, d: &[f64]) -> Message {
        motion::of_pairs(self.dim, d).into()
    }
}
