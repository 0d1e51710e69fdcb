//! The steps and the memory of a factorisation, before a number is computed.

use super::factor_progress::{FactorProgress, Failure};
use super::numeric;
use super::schedule::Schedule;
use super::structure::Structure;
use crate::linalg::sparse_matrix::Csc;
use crate::workers;

/// The order of elimination, the places of the entries, and the memory that they need.
pub struct Plan {
    pub(super) structure: Structure,
    pub(super) schedule: Schedule,
    /// Bytes of the factorisation, with those of the matrix.
    pub bytes: u64,
}

impl Plan {
    /// Plans the factorisation of the symmetric matrix whose lower triangle is `lower`, of which the first rows are eliminated; `rank`, if
    /// given, orders them.
    pub fn new(
        lower: &Csc,
        eliminated: usize,
        rank: Option<&[usize]>,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        let structure = Structure::new(lower, eliminated, rank, progress)?;
        let schedule = Schedule::new(&structure)?;
        let matrix = lower.compute_nnz() * (size_of::<usize>() + size_of::<f64>());
        let numeric = numeric::bytes(&structure, lower, workers::threads());
        let bytes = numeric + structure.bytes() + schedule.bytes() + matrix;
        Ok(Plan { structure, schedule, bytes: bytes as u64 })
    }
}
