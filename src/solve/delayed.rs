//! Rank-1 changes of a matrix, kept until there are enough to be made together.
//!
//! `A - sum_k x_k y_kᵀ` as one matrix product reads and writes `A` once for all changes, where it is
//! beyond the cache; in between a column or a row of it is corrected when it is needed.

use crate::linalg::direct;
use crate::linalg::kernels::{self, Simd};

/// The changes that are kept, of a matrix of `rows` rows and `columns` columns.
pub struct Delayed {
    rows: usize,
    columns: usize,
    /// The `x_k`, and the `y_k`, one after the other.
    x: Vec<f64>,
    y: Vec<f64>,
    simd: Simd,
}

impl Delayed {
    /// None yet.
    pub fn new(rows: usize, columns: usize, simd: Simd) -> Self {
        Delayed { rows, columns, x: Vec::new(), y: Vec::new(), simd }
    }

    /// Number of changes.
    pub fn count(&self) -> usize {
        self.x.len() / self.rows.max(1)
    }

    /// Keeps one more.
    pub fn push(&mut self, x: impl Iterator<Item = f64>, y: &[f64]) {
        self.x.extend(x);
        self.y.extend_from_slice(y);
    }

    /// Forgets them.
    pub fn clear(&mut self) {
        self.x.clear();
        self.y.clear();
    }

    /// Brings a copy of column `j` up to date.
    pub fn correct_column(&self, j: usize, column: &mut [f64]) {
        self.each(|x, y| kernels::subtract(column, y[j], x));
    }

    /// Brings a copy of row `i` up to date.
    pub fn correct_row(&self, i: usize, row: &mut [f64]) {
        self.each(|x, y| kernels::subtract(row, x[i], y));
    }

    /// What an entry loses.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        let changes = self.x.chunks_exact(self.rows).zip(self.y.chunks_exact(self.columns));
        changes.map(|(x, y)| x[i] * y[j]).sum()
    }

    /// Makes the changes in the matrix, its columns `stride` entries apart, and forgets them.
    pub fn settle(&mut self, matrix: &mut [f64], stride: usize) {
        direct::subtract_outer(matrix, (self.rows, self.columns), stride, &self.x, &self.y);
        self.clear();
    }

    #[inline(always)]
    fn each(&self, mut change: impl FnMut(&[f64], &[f64])) {
        kernels::vectorised(
            self.simd,
            #[inline(always)]
            || {
                let x = self.x.chunks_exact(self.rows.max(1));
                x.zip(self.y.chunks_exact(self.columns)).for_each(|(x, y)| change(x, y));
            },
        );
    }
}
