//! Elimination of some components of a symmetric positive definite system, by faer.

use super::columns::Columns;
use super::dense::{self, Triangle};
use super::factor::{cholesky, cholesky_work};
use super::matrix::Matrix;
use super::sparse_matrix::{as_column, as_column_mut};
use super::tolerances::SINGULAR;
use super::watched::{GoesOn, filled};

/// `K_OO = L Lᵀ` of the components `O`, `X = K_CO L⁻ᵀ` with the components `C` that are kept, and their Schur
/// complement.
#[derive(Debug)]
pub struct Elimination {
    /// The components that are eliminated.
    pub dropped: Vec<usize>,
    /// The components that are kept, in the order of [`Self::schur`].
    pub kept: Vec<usize>,
    lower: Columns,
    half: Columns,
    schur: Vec<f64>,
}

impl Elimination {
    /// Operations of [`Self::new`] for so many components that are eliminated, and kept.
    pub fn work(dropped: usize, kept: usize) -> f64 {
        let (o, c) = (dropped as f64, kept as f64);
        cholesky_work(dropped) + o * c * (o + c)
    }

    /// Eliminates `dropped` and keeps `kept`; `None` if `K_OO` is not positive definite to working
    /// precision, or where `goes_on` says no.
    pub fn new(
        matrix: Matrix<'_>,
        dropped: Vec<usize>,
        kept: Vec<usize>,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        // The entries of a column of the matrix in these rows.
        let take = |j: usize, rows: &[usize], column: &mut [f64]| {
            let own = matrix.column(j);
            column.iter_mut().zip(rows).for_each(|(entry, &i)| *entry = own[i]);
        };
        let o = dropped.len();
        let fill = |j: usize, column: &mut [f64]| take(dropped[j], &dropped[j..], &mut column[j..]);
        let mut lower = filled((o, o), fill, goes_on)?;
        cholesky(lower.as_mut(), goes_on)?;
        // Written so that NaN is singular too.
        let regular = dropped
            .iter()
            .enumerate()
            .all(|(j, &at)| lower[(j, j)].powi(2) > SINGULAR * matrix.at(at, at));
        if !regular {
            return None;
        }
        let coupling = |j: usize, column: &mut [f64]| take(dropped[j], &kept, column);
        let corner = |j: usize, column: &mut [f64]| take(kept[j], &kept[j..], column);
        let (half, schur) =
            dense::schur_complement(lower.as_ref(), kept.len(), coupling, corner, goes_on)?;
        Some(Elimination { dropped, kept, lower, half, schur })
    }

    /// The matrix `K_CC - X Xᵀ` of what is kept.
    pub fn schur(&self) -> Matrix<'_> {
        Matrix::contiguous(self.kept.len(), &self.schur)
    }

    /// `X L⁻¹ b`: what a load `b` on the components `O` takes from the load on `C`.
    pub fn transfer(&self, b: &[f64]) -> Vec<f64> {
        let product = self.half.as_ref() * as_column(&self.solved_half(b));
        product.col_as_slice(0).to_vec()
    }

    /// `K_OO⁻¹ (b - K_OC x)`.
    pub fn follow(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut half = self.solved_half(b);
        let taken = self.half.as_ref().transpose() * as_column(x);
        half.iter_mut().zip(taken.col_as_slice(0)).for_each(|(half, taken)| *half -= taken);
        Triangle::Upper.solve(self.lower.as_ref().transpose(), as_column_mut(&mut half));
        half
    }

    /// `L⁻¹ b`.
    fn solved_half(&self, b: &[f64]) -> Vec<f64> {
        let mut half = b.to_vec();
        Triangle::Lower.solve(self.lower.as_ref(), as_column_mut(&mut half));
        half
    }
}
