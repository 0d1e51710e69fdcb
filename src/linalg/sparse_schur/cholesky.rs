//! Sparse Cholesky factorisations of matrices of one pattern: analysed once, factorised again and again.

use super::diagnosis::diagnosed;
use super::factor_progress::{FactorProgress, Failure};
use super::numeric::{Numeric, Unfinished, factorised};
use super::plan::Plan;
use super::solve::{backward, forward};
use crate::linalg::sparse_matrix::Csc;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::watched::GoesOn;

/// The values of a factor, or the memory of one.
#[derive(Default)]
pub struct Values(Vec<f64>);

/// The analysis of a pattern.
pub struct SparseCholesky(Plan);

impl SparseCholesky {
    /// Analyses the pattern of `lower`, of which every diagonal entry is stored.
    pub fn new(lower: &Csc, progress: &mut FactorProgress<'_>) -> Result<Self, Failure> {
        Ok(SparseCholesky(Plan::new(lower, lower.ncols(), None, progress)?))
    }

    /// Bytes of a factorisation, with those of the matrix.
    pub fn bytes(&self) -> u64 {
        self.0.bytes
    }

    /// Factorises a matrix of the pattern that must be definite; otherwise a motion says why it is not.
    pub fn diagnosed(
        &self,
        mut lower: Csc,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Values, Failure> {
        Ok(Values(diagnosed(&self.0, &mut lower, progress)?.0))
    }

    /// Factorises a matrix of the pattern in the memory of `values`, which are its factor then; `false` if it is not definite
    /// but for rounding.
    pub fn factor(
        &self,
        lower: &Csc,
        values: &mut Values,
        progress: &mut FactorProgress<'_>,
    ) -> Result<bool, Failure> {
        let parts = (&self.0.structure, &self.0.schedule);
        match factorised(parts, lower, &mut values.0, progress) {
            Ok(Numeric { weakest, .. }) => Ok(weakest.is_none_or(|(_, pivot)| pivot > NEGLIGIBLE)),
            Err(Unfinished::Pivot(_)) => Ok(false),
            Err(Unfinished::Failed(failure)) => Err(failure),
        }
    }

    /// The solutions for the right sides `b`, one behind the other; `None` where `goes_on` says no.
    pub fn solve(&self, values: &Values, b: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let structure = &self.0.structure;
        let mut x = structure.ordered(b);
        forward(structure, &values.0, &mut x, goes_on)?;
        backward(structure, &values.0, &mut x, goes_on)?;
        Some(structure.unordered(&x))
    }
}
