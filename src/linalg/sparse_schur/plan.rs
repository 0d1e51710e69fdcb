//! What a factorisation will do, before a number is computed.

use super::failure::Failure;
use super::numeric;
use super::structure::Structure;
use super::watch::Watch;
use crate::linalg::sparse_matrix::Csc;

/// The order of elimination, the places of the entries, and the memory that they need.
pub struct Plan {
    pub(super) structure: Structure,
    pub(super) panel_of: Vec<usize>,
    bytes: u64,
}

impl Plan {
    /// Of the symmetric matrix whose lower triangle is `lower`, of which the first rows are eliminated; `rank`, if
    /// given, orders them.
    pub fn new(
        lower: &Csc,
        eliminated: usize,
        rank: Option<&[usize]>,
        watch: &mut dyn Watch,
    ) -> Result<Self, Failure> {
        let structure = Structure::new(lower, eliminated, rank, watch)?;
        let panel_of = structure.panel_of_columns()?;
        let update = structure.cost(&panel_of).update;
        let matrix = lower.compute_nnz() * (size_of::<usize>() + size_of::<f64>());
        let bytes = numeric::bytes(&structure, lower, update) + structure.bytes() + matrix;
        Ok(Plan { structure, panel_of, bytes: bytes as u64 })
    }

    /// Bytes of the factorisation, with those of the matrix.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }
}
