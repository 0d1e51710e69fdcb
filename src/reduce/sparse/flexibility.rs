//! A host's sparse flexibility matrix: checked as a stiffness matrix is, and by what no semi-definite matrix has.

use std::borrow::Cow;

use super::host_arrays::SparseMatrix;
use super::host_matrix::check_diagonal;
use crate::error::Error;
use crate::linalg::sparse_matrix::{Csc, diagonals, entries};
use crate::linalg::tolerances::AGREES;
use crate::problem::symmetric_matrix::beyond_diagonal;
use crate::problem::{
    FlexibilityData, FlexibilityForm, FlexibilityProblem, SparseW, checked_dim, unknowns,
};
use crate::reduce::probes::refuse;

impl<'a> FlexibilityProblem<'a> {
    /// Checks the data and copies `W`.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first entry of the matrix that is out of range or order, listed twice, in the
    /// wrong triangle, not finite, not symmetric beyond rounding (1e-9 of the diagonal), larger than its diagonal
    /// allows, negative on the diagonal or zero there in a row that is not zero; a `W` of another size or of
    /// zeros; the first entry of another array that is out of range. [`Error::OutOfMemory`]: no memory for the copy.
    pub fn from_sparse(data: FlexibilityData<'a, SparseMatrix<'_>>) -> Result<Self, Error> {
        let matrix = SparseW::from_sparse(data.dim, data.pairs, &data.flexibility)?;
        let form = FlexibilityForm::Sparse(Cow::Owned(matrix));
        Self::with_form(form, data.dim, data.free, (data.gap, data.law, data.reference_slip))
    }
}

impl SparseW {
    /// A checked copy of a host's matrix of so many pairs.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_sparse`] of the matrix.
    pub(crate) fn from_sparse(
        dim: usize,
        pairs: usize,
        matrix: &SparseMatrix<'_>,
    ) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        if matrix.size != size {
            return refuse(format!(
                "W: size is {}, it must be dim * pairs, which is {size}",
                matrix.size
            ));
        }
        let lower = matrix.lower_triangle("W")?;
        check_diagonal("W", &lower, |_| true)?;
        check_entries(&lower)?;
        SparseW::new(dim, lower)
    }
}

/// Refuses entries that the diagonal does not allow.
fn check_entries(lower: &Csc) -> Result<(), Error> {
    let root: Vec<f64> = diagonals(lower).map(f64::sqrt).collect();
    for (i, j, value) in entries(lower).filter(|(i, j, _)| i != j) {
        let scale = root[i] * root[j];
        if value.abs() > (1.0 + AGREES) * scale {
            return refuse(beyond_diagonal("W", (i, j), value, scale));
        }
    }
    Ok(())
}
