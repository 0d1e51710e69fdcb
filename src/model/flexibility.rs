//! Models in flexibility form, `d = W F + q`: the loads of a case are its free displacements `q`, and
//! displacements do not determine forces, so that a solution starts from forces.

use super::{LoadCase, Model};
use crate::error::Error;
use crate::problem::{
    Flexibility, FlexibilityForm, FlexibilityProblem, SparseW, checked_dim, unknowns,
};
use crate::reduce::{FlexibilityReduction, SparseMatrix};
use crate::solve::largest_island;

impl Model {
    /// A flexibility `W` of the host: `dim * pairs` columns with `ld` entries from one to the next.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_flexibility`] of the matrix.
    pub fn flexibility(dim: usize, pairs: usize, w: &[f64], ld: usize) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        let entries = Flexibility::checked_matrix(size, (w, ld))?.to_vec();
        let reduction = Box::new(FlexibilityReduction::Dense(size, entries));
        Ok(Model { dim, pairs, reduction })
    }

    /// A sparse flexibility of the host, of `dim * pairs` rows.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_sparse`] of the matrix.
    pub fn flexibility_sparse(
        dim: usize,
        pairs: usize,
        w: &SparseMatrix<'_>,
    ) -> Result<Self, Error> {
        let w = SparseW::from_sparse(dim, pairs, w)?;
        let reduction = Box::new(FlexibilityReduction::Sparse(w));
        Ok(Model { dim, pairs, reduction })
    }

    /// True if displacements do not determine forces, so that a solution starts from forces.
    pub fn starts_from_forces(&self) -> bool {
        self.reduction.flexibility().is_some()
    }

    /// The problem of a load case on the flexibility.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::with_form`], and loads or prescribed values of the wrong length or not finite.
    pub(super) fn on_flexibility<'a>(
        &self,
        form: FlexibilityForm<'a>,
        case: &LoadCase<'a>,
    ) -> Result<FlexibilityProblem<'a>, Error> {
        self.check_loads(Some(case.load), case.prescribed)?;
        let of_pairs = (case.gap, case.law, case.reference_slip);
        FlexibilityProblem::with_form(form, self.dim, case.load, of_pairs)
    }

    /// The largest consumer of memory of a load case, in words: the largest island of a sparse flexibility.
    pub(crate) fn largest_part(&self) -> Option<String> {
        largest_island(&self.reduction.flexibility()?)
    }
}
