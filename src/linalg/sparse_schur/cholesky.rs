//! Sparse Cholesky factorisations of matrices of one pattern: analysed once, factorised again and again.

use super::diagnosis::diagnosed;
use super::factor_progress::{FactorProgress, Failure};
use super::numeric::{Numeric, factorised};
use super::plan::Plan;
use super::solve::{backward, forward};
use crate::linalg::sparse_matrix::Csc;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::watched::GoesOn;

/// The values of a factor, or the memory of one.
pub type Values = Vec<f64>;

/// Of a plan that eliminates all rows, for matrices of its pattern.
impl Plan {
    /// Factorises a matrix that must be definite; otherwise a motion says why it is not.
    pub fn definite(
        &self,
        mut lower: Csc,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Values, Failure> {
        Ok(diagnosed(self, &mut lower, progress)?.0)
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
