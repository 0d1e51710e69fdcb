//! A flexibility of the host, `d = W F + q`: nothing is reduced.

use std::borrow::Cow;

use super::Reduction;
use crate::linalg::matrix::Matrix;
use crate::problem::{FlexibilityForm, SparseW};

/// The checked flexibility of pairs. Loads of the host are free displacements `q`, and displacements are `d`.
pub enum FlexibilityReduction {
    /// The number of rows, and all entries, column-major.
    Dense(usize, Vec<f64>),
    /// The entries that are stored.
    Sparse(SparseW),
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
