//! Rank-1 updates of a matrix, kept until there are enough to be made together.
//!
//! `A - sum_k x_k y_kᵀ` as one matrix product reads and writes `A` once for all updates, where it is
//! beyond the cache; in between a column or a row of it is corrected when it is needed.

use crate::linalg::dense::subtract_outer;
use crate::linalg::simd;

/// The updates that are kept, of a matrix of `rows` rows and `columns` columns.
pub struct RankOneUpdates {
    rows: usize,
    columns: usize,
    /// The `x_k`, and the `y_k`, one after the other.
    x: Vec<f64>,
    y: Vec<f64>,
}

impl RankOneUpdates {
    /// None yet; there is room for `most`.
    pub fn new(rows: usize, columns: usize, most: usize) -> Self {
        let (x, y) = (Vec::with_capacity(most * rows), Vec::with_capacity(most * columns));
        RankOneUpdates { rows, columns, x, y }
    }

    /// Number of updates.
    pub fn count(&self) -> usize {
        self.x.len() / self.rows.max(1)
    }

    /// Keeps one more.
    pub fn push(&mut self, x: impl Iterator<Item = f64>, y: &[f64]) {
        self.x.extend(x);
        self.y.extend_from_slice(y);
    }

    /// Drops all updates.
    pub fn clear(&mut self) {
        self.x.clear();
        self.y.clear();
    }

    /// Brings a copy of column `j` up to date.
    pub fn correct_column(&self, j: usize, column: &mut [f64]) {
        self.each(|x, y| simd::axpy(column, -y[j], x));
    }

    /// Brings a copy of row `i` up to date.
    pub fn correct_row(&self, i: usize, row: &mut [f64]) {
        self.each(|x, y| simd::axpy(row, -x[i], y));
    }

    /// `sum_k x_k[i] y_k[j]`, by which entry `(i, j)` falls.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        let updates = self.x.chunks_exact(self.rows).zip(self.y.chunks_exact(self.columns));
        updates.map(|(x, y)| x[i] * y[j]).sum()
    }

    /// Makes the updates in the matrix, its columns `stride` entries apart, and drops them.
    pub fn settle(&mut self, matrix: &mut [f64], stride: usize) {
        subtract_outer(matrix, (self.rows, self.columns), stride, &self.x, &self.y);
        self.clear();
    }

    #[inline(always)]
    fn each(&self, mut change: impl FnMut(&[f64], &[f64])) {
        simd::vectorised(
            #[inline(always)]
            || {
                let x = self.x.chunks_exact(self.rows.max(1));
                x.zip(self.y.chunks_exact(self.columns)).for_each(|(x, y)| change(x, y));
            },
        );
    }
}
