//! A matrix of flexibility that the library keeps.

use super::sparse_flexibility::SparseW;

/// A checked copy of the host's matrix `W`.
pub enum FlexibilityForm {
    /// All entries, column-major.
    Dense(Vec<f64>),
    /// The stored entries, and the islands of pairs that they tie to each other.
    Sparse(SparseW),
}
