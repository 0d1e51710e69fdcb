//! The steps and the memory of a factorisation, before a number is computed; and factorisations of matrices of one pattern,
//! which is analysed once.

use super::diagnosis::diagnosed;
use super::factor_progress::{FactorProgress, Failure};
use super::numeric::{self, Numeric, factorised};
use super::schedule::Schedule;
use super::solve::{backward, forward};
use super::structure::Structure;
use crate::linalg::sparse_matrix::Csc;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::watched::GoesOn;
use crate::workers;

/// The values of a factor, or the memory of one.
pub type Values = Vec<f64>;

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

    /// Factorises a matrix of the pattern, of which all rows are eliminated, and which must be definite; otherwise a motion
    /// says why it is not.
    pub fn definite(
        &self,
        mut lower: Csc,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Values, Failure> {
        Ok(diagnosed((&self.structure, &self.schedule), &mut lower, progress)?.0)
    }

    /// Factorises a matrix in the memory of `values`, which are its factor then; `false` if it is not definite but for
    /// rounding.
    pub fn factor(
        &self,
        lower: &Csc,
        values: &mut Values,
        progress: &mut FactorProgress<'_>,
    ) -> Result<bool, Failure> {
        match factorised((&self.structure, &self.schedule), lower, values, progress) {
            Ok(Numeric { weakest, .. }) => Ok(weakest.is_none_or(|(_, pivot)| pivot > NEGLIGIBLE)),
            Err(Failure::Indefinite(_)) => Ok(false),
            Err(failure) => Err(failure),
        }
    }

    /// The solutions for the right sides `b`, one behind the other; `None` where `goes_on` says no.
    pub fn solve(&self, values: &Values, b: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let structure = &self.structure;
        let mut x = structure.ordered(b);
        forward(structure, values, &mut x, goes_on)?;
        backward(structure, values, &mut x, goes_on)?;
        Some(structure.unordered(&x))
    }
}
