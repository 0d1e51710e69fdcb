//! An approximate inverse of a dense matrix, with bounds that hold whatever rounding has done to it.
//!
//! With any `R`, a matrix `J` is regular if `|1 - R J| < 1` in a norm. Products of matrices are computed in any
//! order of their sums, so that they are off by at most `gamma |R| |J|`, `gamma = n u / (1 - n u)`
//! (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, SIAM 2002, section 3.5). Row sums of
//! `|R| |J|` take a product with a vector only.

use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};

use super::ball::{product_up, sum_of_products_up, sum_up};
use super::columns::Columns;
use super::dense::Triangle;
use super::factor::{RowOrder, lu};
use super::watched::{GoesOn, block, columns_of, filled};

/// A matrix and its approximate inverse.
pub struct ApproximateInverse {
    matrix: Columns,
    inverse: Columns,
}

impl ApproximateInverse {
    /// Inverts the `n x n` matrix whose columns `fill(j, column)` writes; `None` if an entry of the inverse is
    /// not finite, or where `goes_on` says no.
    pub fn new(
        n: usize,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let matrix = filled((n, n), fill, goes_on)?;
        let inverse = inverted(&matrix, goes_on)?;
        let finite = (0..n).all(|j| inverse.column(j).iter().all(|entry| entry.is_finite()));
        finite.then_some(ApproximateInverse { matrix, inverse })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.inverse.nrows()
    }

    /// `R x`.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        sums_over_columns(&self.inverse, x, |entry| entry)
    }

    /// Bounds on `|R| g` where each entry of `g` is the rounding of inner products of a size, and a doubt.
    fn rest(&self, sizes: &[f64], doubt: &[f64]) -> Vec<f64> {
        let rounding = gamma(self.size());
        let both = sizes.iter().zip(doubt);
        let wide = both.map(|(size, doubt)| sum_up(product_up(size.abs(), rounding), *doubt));
        bound_of_product(&self.inverse, &wide.collect::<Vec<_>>())
    }

    /// Bounds on the sizes of the entries of `R g` where each entry of `g` is at most `doubt` from that of
    /// `middle`.
    pub fn image(&self, middle: &[f64], doubt: &[f64]) -> Vec<f64> {
        let n = self.size();
        let computed = self.product(middle);
        // The rounding of the product is below that of n terms of |R| |g|.
        let rest = self.rest(middle, doubt);
        computed.iter().zip(rest).map(|(g, rest)| sum_up(sum_up(g.abs(), rest), tiny(n))).collect()
    }

    /// Bounds on the row sums of `|1 - R (J + E)|` for all `E` whose absolute row sums are at most `doubt`;
    /// `None` where `goes_on` says no.
    pub fn contraction(&self, doubt: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let n = self.size();
        let mut sums = vec![0.0; n];
        let at_once = block(n * n);
        let mut block = Mat::zeros(n, at_once);
        for begin in (0..n).step_by(at_once) {
            if !goes_on() {
                return None;
            }
            let width = at_once.min(n - begin);
            let columns = self.matrix.as_ref().get(.., begin..begin + width);
            let part = block.get_mut(.., ..width);
            matmul(part, Accum::Replace, self.inverse.as_ref(), columns, 1.0, Par::Seq);
            for j in 0..width {
                block[(begin + j, j)] -= 1.0;
                let column = block.col_as_slice(j);
                sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry.abs());
            }
        }
        // Subnormal parts of the products stay below n of the least normal numbers in each entry.
        let sizes = bound_of_product(&self.matrix, &vec![1.0; n]);
        let rest = self.rest(&sizes, doubt);
        let tiny = tiny(n) * n as f64;
        let total =
            |(sum, rest): (&f64, f64)| sum_up(sum_of_products_up(*sum, n), sum_up(rest, tiny));
        Some(sums.iter().zip(rest).map(total).collect())
    }
}

/// Bound on the relative rounding of inner products of `n` terms, in any order.
fn gamma(n: usize) -> f64 {
    (n as f64 + 4.0) * f64::EPSILON
}

/// Bound on what `n` subnormal products lose.
fn tiny(n: usize) -> f64 {
    n as f64 * f64::MIN_POSITIVE
}

/// Bounds on the entries of `|A| x`, of an `x` that has no negative entry.
fn bound_of_product(matrix: &Columns, x: &[f64]) -> Vec<f64> {
    let sums = sums_over_columns(matrix, x, f64::abs).into_iter();
    sums.map(|sum| sum_of_products_up(sum, x.len())).collect()
}

/// The product of what `of` makes of the entries with `x`, column by column.
fn sums_over_columns(matrix: &Columns, x: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut sums = vec![0.0; matrix.nrows()];
    for (j, x) in x.iter().enumerate() {
        sums.iter_mut().zip(matrix.column(j)).for_each(|(sum, entry)| *sum += of(*entry) * x);
    }
    sums
}

/// By the factors of the transpose: right-hand sides by rows need no deep stack (`small_products.rs`), and the inverse
/// comes out by columns. `None` where `goes_on` says no.
fn inverted(matrix: &Columns, goes_on: GoesOn<'_>) -> Option<Columns> {
    let n = matrix.nrows();
    let mut factors = matrix.as_ref().transpose().to_owned();
    let RowOrder { order, .. } = lu(factors.as_mut(), goes_on)?;
    let mut inverse = Columns::zeros(n, n);
    (0..n).for_each(|i| inverse[(i, i)] = 1.0);
    let mut columns = inverse.as_mut().transpose_mut();
    let at_once = block(n * n);
    for begin in (0..n).step_by(at_once) {
        if !goes_on() {
            return None;
        }
        let mut block = columns.as_mut().get_mut(.., begin..n.min(begin + at_once));
        let below = block.as_mut().get_mut(begin.., ..);
        Triangle::UnitLower.solve(factors.get(begin.., begin..), below);
        Triangle::Upper.solve(factors.as_ref(), block);
    }
    for column in columns_of(inverse.as_mut()) {
        let before = column.to_vec();
        order.iter().zip(before).for_each(|(&to, entry)| column[to] = entry);
    }
    Some(inverse)
}
