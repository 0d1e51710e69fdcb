//! How a factorisation fails.

use crate::linalg::free_motions::Doubt;
use crate::linalg::sparse_matrix::OutOfMemory;

/// Why a matrix was not factorised.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A null vector of the matrix, zero in the rows of `C`, its largest entry 1.
    NullVector(Vec<f64>),
    /// The matrix is not positive semi-definite, as this row shows.
    Indefinite(usize),
    /// The energy of this motion is negative, so that the matrix is not positive semi-definite.
    Negative(Vec<f64>),
    /// Whether the matrix resists this motion cannot be told from rounding.
    Unclear(Vec<f64>),
    /// Not enough memory.
    OutOfMemory,
    /// The watch has ended it.
    Stopped,
}

impl From<Doubt> for Failure {
    fn from(doubt: Doubt) -> Self {
        match doubt {
            Doubt::Indefinite(motion) => Failure::Negative(motion),
            Doubt::Unclear(motion) => Failure::Unclear(motion),
        }
    }
}

impl From<OutOfMemory> for Failure {
    fn from(_: OutOfMemory) -> Self {
        Failure::OutOfMemory
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_doubt_keeps_its_motion() {
        let motion = || vec![1.0, -1.0];
        assert_eq!(Failure::from(Doubt::Indefinite(motion())), Failure::Negative(motion()));
        assert_eq!(Failure::from(Doubt::Unclear(motion())), Failure::Unclear(motion()));
        assert_eq!(Failure::from(OutOfMemory), Failure::OutOfMemory);
    }
}
