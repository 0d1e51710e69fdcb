//! Elimination of some components of a symmetric positive definite system, by faer.

use faer::linalg::triangular_solve;
use faer::{MatMut, MatRef, Par};

use super::columns::Columns;
use super::dense;
use super::factor::{cholesky, cholesky_work};
use super::matrix::Matrix;
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
        let (o, c) = (dropped.len(), kept.len());
        let fill = |j: usize, column: &mut [f64]| {
            let own = matrix.column(dropped[j]);
            column[j..].iter_mut().zip(&dropped[j..]).for_each(|(entry, &i)| *entry = own[i]);
        };
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
        let fill = |j: usize, column: &mut [f64]| {
            let own = matrix.column(dropped[j]);
            column.iter_mut().zip(&kept).for_each(|(entry, &i)| *entry = own[i]);
        };
        let mut half = filled((c, o), fill, goes_on)?;
        let mut schur = vec![0.0; c * c];
        for (j, &at) in kept.iter().enumerate() {
            let column = matrix.column(at);
            let target = &mut schur[c * j + j..c * (j + 1)];
            target.iter_mut().zip(&kept[j..]).for_each(|(entry, &i)| *entry = column[i]);
        }
        dense::subtract_coupling(&mut schur, lower.as_ref(), half.as_mut(), goes_on)?;
        Some(Elimination { dropped, kept, lower, half, schur })
    }

    /// The matrix `K_CC - X Xᵀ` of what is kept.
    pub fn schur(&self) -> Matrix<'_> {
        Matrix::new(self.kept.len(), &self.schur, self.kept.len())
    }

    /// `X L⁻¹ b`: what a load `b` on the components `O` takes from the load on `C`.
    pub fn transfer(&self, b: &[f64]) -> Vec<f64> {
        let mut half = b.to_vec();
        self.solve_half(&mut half);
        let product = self.half.as_ref() * as_column(&half);
        product.col_as_slice(0).to_vec()
    }

    /// `K_OO⁻¹ (b - K_OC x)`.
    pub fn follow(&self, b: &[f64], x: &[f64]) -> Vec<f64> {
        let mut half = b.to_vec();
        self.solve_half(&mut half);
        let taken = self.half.as_ref().transpose() * as_column(x);
        half.iter_mut().zip(taken.col_as_slice(0)).for_each(|(half, taken)| *half -= taken);
        self.solve_other_half(&mut half);
        half
    }

    /// `L⁻¹ b`, in place.
    fn solve_half(&self, b: &mut [f64]) {
        let b = MatMut::from_column_major_slice_mut(b, self.lower.nrows(), 1);
        triangular_solve::solve_lower_triangular_in_place(self.lower.as_ref(), b, Par::Seq);
    }

    /// `L⁻ᵀ b`, in place.
    fn solve_other_half(&self, b: &mut [f64]) {
        let b = MatMut::from_column_major_slice_mut(b, self.lower.nrows(), 1);
        triangular_solve::solve_upper_triangular_in_place(
            self.lower.as_ref().transpose(),
            b,
            Par::Seq,
        );
    }
}

fn as_column(x: &[f64]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(x, x.len(), 1)
}
