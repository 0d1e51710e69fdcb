//! Equilibrium of some components while the others are fixed.

use super::ContactProblem;
use crate::linalg::matrix::Matrix;
use crate::linalg::pivoted_cholesky::PivotedCholesky;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::watched::GoesOn;

/// The factor of some rows and columns of a symmetric positive semi-definite matrix `K`, scaled by
/// the units of its components.
pub struct FreeBlock<'p> {
    matrix: Matrix<'p>,
    rows: Vec<usize>,
    scale: Vec<f64>,
    /// Its factor.
    pub factor: PivotedCholesky,
}

/// One solution and one step of iterative refinement: the second recovers the digits that the
/// scaling and a nearly singular block lose.
pub const SOLUTIONS: usize = 2;

impl<'p> FreeBlock<'p> {
    /// Factorises the block of `rows` of a problem's matrix; `None` if it is not positive semi-definite, or where
    /// `goes_on` says no.
    pub fn of_problem(
        problem: &ContactProblem<'p>,
        rows: Vec<usize>,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let scale = rows.iter().map(|&i| problem.unit(i).sqrt().recip()).collect();
        Self::new(problem.stiffness(), rows, scale, goes_on)
    }

    /// Factorises the block of `rows` of a matrix, each times its `scale`, the root of a compliance; `None` as above.
    pub(super) fn new(
        matrix: Matrix<'p>,
        rows: Vec<usize>,
        scale: Vec<f64>,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let entry = |i: usize, j: usize| scale[i] * matrix.at(rows[i], rows[j]) * scale[j];
        let factor = PivotedCholesky::within(rows.len(), NEGLIGIBLE, entry, goes_on)?;
        Some(FreeBlock { matrix, rows, scale, factor })
    }

    /// Rows that depend on the others.
    pub fn dependent(&self) -> impl Iterator<Item = usize> {
        self.factor.dependent.iter().map(|&i| self.rows[i])
    }

    /// Schur complement of `K` on the rows `kept`, column-major; `None` where `goes_on` says no.
    pub fn schur_complement(&self, kept: &[usize], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        self.factor.schur_complement(
            kept.len(),
            |i, j| self.scale[i] * self.matrix.at(self.rows[i], kept[j]),
            |i, j| self.matrix.at(kept[i], kept[j]),
            goes_on,
        )
    }

    /// Adds to the independent rows of `d` what makes `K d = load` there, given `K d - load`.
    fn correct(&self, excess: &[f64], d: &mut [f64]) {
        for (i, y) in self.factor.solution(|i| self.scale[i] * excess[self.rows[i]]) {
            d[self.rows[i]] -= self.scale[i] * y;
        }
    }

    /// Brings the independent rows into equilibrium with the loads.
    pub fn equilibrate(&self, load: &[f64], d: &mut [f64]) {
        for _ in 0..SOLUTIONS {
            let excess = self.matrix.product_less(d, load);
            self.correct(&excess, d);
        }
    }

    /// Extends a motion of the other rows to the independent ones so that no force acts on these.
    pub fn follow(&self, motion: &mut [f64]) {
        for _ in 0..SOLUTIONS {
            let internal = self.matrix.product(motion);
            self.correct(&internal, motion);
        }
    }

    /// A basis of the motions that `K` does not resist. Each moves one dependent component by its
    /// `unit^-1/2`.
    pub fn null_vectors(&self) -> impl Iterator<Item = Vec<f64>> {
        self.factor.dependent.iter().map(|&i| {
            let mut motion = vec![0.0; self.matrix.size()];
            motion[self.rows[i]] = self.scale[i];
            self.follow(&mut motion);
            motion
        })
    }
}
