//! A body that the host itself has condensed on its contact nodes, on an obstacle: `d = u`.

use super::Reduction;
use crate::error::{Argument, Error};
use crate::linalg::free_motions::{Doubt, Whole, settle};
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::{CONDENSATION, FREE};
use crate::linalg::vector::first_not_finite;
use crate::linalg::watched::GoesOn;
use crate::problem::Named;
use crate::problem::symmetric_matrix::{check, check_semidefinite, is_symmetric_beside};

/// The host's condensed stiffness.
pub struct CondensedReduction {
    /// Components of `d`.
    size: usize,
    stiffness: Vec<f64>,
}

impl CondensedReduction {
    /// Keeps the stiffness, checked, with `dim` rows for each pair, and without what rounding has made of
    /// free motions.
    ///
    /// # Errors
    /// As [`settled`].
    pub(crate) fn new(dim: usize, matrix: &Matrix<'_>, go_on: GoesOn<'_>) -> Result<Self, Error> {
        let settled = settled(dim, matrix, ("K", Argument::Matrix), go_on)?;
        let stiffness = settled.unwrap_or_else(|| matrix.to_vec());
        Ok(CondensedReduction { size: matrix.size(), stiffness })
    }
}

/// Checks a host's condensed matrix, and returns it, contiguous, exact on the motions that are free up to
/// the rounding of its condensation; `None` if it is to be taken as it is.
///
/// It is changed only if a diagonal entry is at most 9e-12 of the largest one of its pair and the
/// component is coupled to others: that may be rounding of a free body on few points. Then motions of
/// so little energy become exactly free, and all others keep what they have. A matrix with a motion that
/// cannot be told from rounding is taken as it is. `go_on` is asked now and then; if it ends the check, the
/// answer is none to use.
///
/// # Errors
/// As `check` and `check_semidefinite`.
pub(super) fn settled(
    dim: usize,
    matrix: &Matrix<'_>,
    named: Named<'_>,
    go_on: GoesOn<'_>,
) -> Result<Option<Vec<f64>>, Error> {
    let cleaned = without_rounding(dim, matrix, go_on);
    check(&view(matrix, &cleaned), dim, named)?;
    check_semidefinite(&view(matrix, &cleaned), dim, named, go_on)?;
    Ok(cleaned)
}

/// The matrix without rounding, if there is one, or as it was given.
pub(super) fn view<'k>(given: &Matrix<'k>, cleaned: &'k Option<Vec<f64>>) -> Matrix<'k> {
    cleaned.as_ref().map_or(*given, |cleaned| Matrix::contiguous(given.size(), cleaned))
}

/// The matrix without what rounding made of free motions; `None` if it is to be taken as it is, or where `goes_on`
/// says no.
fn without_rounding(dim: usize, matrix: &Matrix<'_>, goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
    let units = matrix.units_of_condensation(dim);
    let is_rounding = |i: usize| matrix.at(i, i) <= FREE * CONDENSATION * units[i];
    if !(0..matrix.size()).any(is_rounding) {
        return None;
    }
    let root: Vec<f64> = units.iter().map(|unit| unit.sqrt()).collect();
    let mut stiffness = matrix.to_vec();
    let is_sound = units.iter().all(|&unit| unit > 0.0)
        && first_not_finite(&stiffness).is_none()
        && is_symmetric_beside(matrix, &root);
    let given = HostMatrix { matrix: *matrix, units: &units };
    // A matrix that is not sound is refused by the check.
    let doubt = (&units[..], 0.0, Doubt::Pivots);
    (is_sound && settle(&mut stiffness, doubt, (&[], &given), goes_on) == Ok(true))
        .then_some(stiffness)
}

/// A matrix of which nothing was eliminated here.
struct HostMatrix<'k> {
    matrix: Matrix<'k>,
    units: &'k [f64],
}

impl Whole for HostMatrix<'_> {
    fn extended(&self, kept: &[f64], _: GoesOn<'_>) -> Option<Vec<f64>> {
        Some(kept.to_vec())
    }

    fn forces(&self, motion: &[f64]) -> Vec<f64> {
        self.matrix.product(motion)
    }

    fn noise(&self, motion: &[f64]) -> f64 {
        CONDENSATION * self.units.iter().zip(motion).map(|(unit, x)| unit * x * x).sum::<f64>()
    }
}

impl Reduction for CondensedReduction {
    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn is_condensed_by_host(&self) -> bool {
        true
    }

    fn host_size(&self) -> usize {
        self.size
    }
}
