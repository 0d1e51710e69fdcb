//! An LCP, scaled, as the tableau of Lemke's method reads it.

use crate::linalg::simd;

/// The entries of an LCP matrix that nobody needs to store a second time: the tableau begins as a copy
/// of it, and reads columns again when it is refined or refactorised.
pub trait Entries {
    /// Writes column `j`.
    fn write_column(&self, j: usize, column: &mut [f64]);
}

/// The problem that a tableau belongs to, scaled so that its entries are of similar size.
pub struct Scaled<'p> {
    /// `M`.
    pub matrix: &'p dyn Entries,
    /// Row and column scales of `M`.
    pub scale: &'p [f64],
    /// `q`, scaled.
    pub q: Vec<f64>,
    /// `d > 0`, scaled.
    pub covering: Vec<f64>,
}

impl Scaled<'_> {
    /// Number of equations.
    pub fn size(&self) -> usize {
        self.q.len()
    }

    /// Writes column `j` of `M`, scaled.
    pub fn write_column(&self, j: usize, column: &mut [f64]) {
        self.matrix.write_column(j, column);
        for (entry, row_scale) in column.iter_mut().zip(self.scale) {
            *entry = row_scale * *entry * self.scale[j];
        }
    }

    /// Column of `variable` in `w - M z - d z0 = q`, added to `column` times `factor`; `memory` has room
    /// for a column.
    pub fn add_column(&self, variable: usize, factor: f64, column: &mut [f64], memory: &mut [f64]) {
        let n = self.size();
        match variable {
            i if i < n => column[i] += factor,
            j if j < 2 * n => {
                self.write_column(j - n, memory);
                simd::axpy(column, -factor, memory);
            }
            _ => simd::axpy(column, -factor, &self.covering),
        }
    }
}
