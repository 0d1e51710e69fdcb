//! The progress of a factorisation, the end that its caller may put to it, and how else it fails.

use crate::linalg::sparse_matrix::OutOfMemory;

/// Is told between two steps of a factorisation which share of its work is done, 0 before anything is known of it, and may
/// end it by [`Failure::Stopped`].
pub type FactorProgress<'a> = dyn FnMut(f64) -> Result<(), Failure> + 'a;

/// Why a matrix was not factorised.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A null vector of the matrix, zero in the rows of `C`, its largest entry 1.
    NullVector(Vec<f64>),
    /// The matrix is not positive semi-definite, as this row shows.
    Indefinite(usize),
    /// The energy of this motion is negative, so that the matrix is not positive semi-definite.
    Negative(Vec<f64>),
    /// The resistance of the matrix to this motion cannot be told from rounding.
    Unclear(Vec<f64>),
    /// Not enough memory.
    OutOfMemory,
    /// The caller has ended it.
    Stopped,
}

impl From<OutOfMemory> for Failure {
    fn from(_: OutOfMemory) -> Self {
        Failure::OutOfMemory
    }
}
