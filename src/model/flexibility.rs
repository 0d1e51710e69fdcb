//! Models in flexibility form, `d = W F + q`: the loads of a case are its free displacements `q`, and
//! displacements do not determine forces, so that a solution starts from forces.

use super::{LoadCase, Model};
use crate::error::Error;
use crate::monitor::Monitor;
use crate::problem::{
    FlexibilityData, FlexibilityForm, FlexibilityProblem, SparseFlexibilityProblem, SparseW,
    checked_dim, unknowns,
};
use crate::reduce::{FlexibilityReduction, SparseMatrix};
use crate::settings::Settings;
use crate::solve::{
    Solution, largest_island, memory_flexibility, memory_of_islands, solve_flexibility,
    solve_flexibility_sparse,
};

impl Model {
    /// A flexibility `W` of the host: `dim * pairs` columns with `ld` entries from one to the next.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_flexibility`] of the matrix.
    pub fn flexibility(dim: usize, pairs: usize, w: &[f64], ld: usize) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        let reduction = Box::new(FlexibilityReduction::dense(dim, size, w, ld)?);
        Ok(Model { dim, pairs, reduction })
    }

    /// A sparse flexibility of the host, of `dim * pairs` rows.
    ///
    /// # Errors
    /// As [`SparseFlexibilityProblem::from_sparse`] of the matrix.
    pub fn flexibility_sparse(
        dim: usize,
        pairs: usize,
        w: &SparseMatrix<'_>,
    ) -> Result<Self, Error> {
        let reduction = Box::new(FlexibilityReduction::sparse(dim, pairs, w)?);
        Ok(Model { dim, pairs, reduction })
    }

    /// True if displacements do not determine forces, so that a solution starts from forces.
    pub fn starts_from_forces(&self) -> bool {
        self.reduction.flexibility().is_some()
    }

    /// Solves a load case in flexibility form from the forces `start`.
    pub(super) fn solve_flexibility(
        &self,
        form: &FlexibilityForm,
        case: &LoadCase<'_>,
        (settings, start): (&Settings, Option<&[f64]>),
        monitor: &mut Monitor<'_>,
    ) -> Result<Solution, Error> {
        match form {
            FlexibilityForm::Dense(w) => {
                solve_flexibility(&self.dense_problem(w, case)?, settings, start, monitor)
            }
            FlexibilityForm::Sparse(matrix) => {
                solve_flexibility_sparse(&sparse_problem(matrix, case)?, settings, start, monitor)
            }
        }
    }

    /// The problem of a load case on a dense flexibility.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_flexibility`].
    pub(super) fn dense_problem<'a>(
        &self,
        w: &'a [f64],
        case: &LoadCase<'a>,
    ) -> Result<FlexibilityProblem<'a>, Error> {
        FlexibilityProblem::from_flexibility(FlexibilityData {
            dim: self.dim,
            pairs: self.pairs,
            flexibility: w,
            ld: (self.dim * self.pairs).max(1),
            free: case.load,
            gap: case.gap,
            law: case.law,
            reference_slip: case.reference_slip,
        })
    }

    /// Most bytes that a load case takes, of a model in flexibility form.
    pub(super) fn memory_of_flexibility(&self, form: &FlexibilityForm) -> u64 {
        match form {
            FlexibilityForm::Dense(_) => memory_flexibility(self.dim * self.pairs),
            FlexibilityForm::Sparse(matrix) => memory_of_islands(matrix),
        }
    }

    /// The largest consumer of memory of a load case, in words: the largest island of a sparse flexibility.
    pub(crate) fn largest_part(&self) -> Option<String> {
        match self.reduction.flexibility()? {
            FlexibilityForm::Dense(_) => None,
            FlexibilityForm::Sparse(matrix) => Some(largest_island(matrix)),
        }
    }
}

/// The problem of a load case on a sparse flexibility.
///
/// # Errors
/// As [`SparseFlexibilityProblem::with_matrix`].
pub(super) fn sparse_problem<'a>(
    matrix: &SparseW,
    case: &LoadCase<'a>,
) -> Result<SparseFlexibilityProblem<'a>, Error> {
    let LoadCase { load, gap, law, reference_slip, .. } = *case;
    SparseFlexibilityProblem::with_matrix(matrix.clone(), load, gap, law, reference_slip)
}
