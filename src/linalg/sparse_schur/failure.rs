//! How a factorisation fails.

use super::factor_progress::Stopped;
use crate::linalg::free_motions::StiffnessDefect;
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
    /// The resistance of the matrix to this motion cannot be told from rounding.
    Unclear(Vec<f64>),
    /// Not enough memory.
    OutOfMemory,
    /// The caller has ended it.
    Stopped,
}

impl From<StiffnessDefect> for Failure {
    fn from(defect: StiffnessDefect) -> Self {
        match defect {
            StiffnessDefect::Indefinite(motion) => Failure::Negative(motion),
            StiffnessDefect::Unclear(motion) => Failure::Unclear(motion),
        }
    }
}

impl From<Stopped> for Failure {
    fn from(_: Stopped) -> Self {
        Failure::Stopped
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
    fn a_defect_keeps_its_motion() {
        let motion = || vec![1.0, -1.0];
        assert_eq!(
            Failure::from(StiffnessDefect::Indefinite(motion())),
            Failure::Negative(motion())
        );
        assert_eq!(Failure::from(StiffnessDefect::Unclear(motion())), Failure::Unclear(motion()));
        assert_eq!(Failure::from(OutOfMemory), Failure::OutOfMemory);
    }
}
