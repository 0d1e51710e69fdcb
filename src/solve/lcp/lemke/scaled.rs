//! An LCP, scaled, as the tableau of Lemke's method reads it.

use crate::linalg::power_of_two::{largest_exponent, times_power_of_two};
use crate::linalg::simd;

/// Writes a column of a matrix.
type Fill<'p> = dyn Fn(usize, &mut [f64]) + Sync + 'p;

/// The problem that a tableau belongs to, in the variables `z_i / scale_i`, `w_i * scale_i`, so that its entries are of
/// similar size.
pub struct Scaled<'p> {
    /// Writes a column of `M`, which nobody needs to store a second time: the tableau begins as a copy of it, and reads
    /// columns again when it is refined or refactorised.
    fill: Box<Fill<'p>>,
    /// Row and column scales of `M`.
    scale: Vec<f64>,
    /// `q`, scaled, of size one.
    pub q: Vec<f64>,
    /// The exponent of two that `q` has lost.
    unit: i32,
    /// `d > 0`, scaled, of size one.
    pub covering: Vec<f64>,
}

impl<'p> Scaled<'p> {
    /// The LCP of a matrix whose columns `fill(j, column)` writes, `q` and a positive covering vector, to be scaled.
    pub fn new(
        fill: impl Fn(usize, &mut [f64]) + Sync + 'p,
        q: &[f64],
        covering: &[f64],
        scale: Vec<f64>,
    ) -> Self {
        // Powers of two: the pivots stay the same.
        let of_size_one = |values: &[f64]| -> (Vec<f64>, i32) {
            let first = largest_exponent(values.iter().copied()).unwrap_or(0);
            let scaled = values.iter().zip(&scale);
            let scaled = scaled.map(|(&value, scale)| times_power_of_two(value, -first) * scale);
            let scaled: Vec<f64> = scaled.collect();
            let second = largest_exponent(scaled.iter().copied()).unwrap_or(0);
            let of_size_one = scaled.iter().map(|&value| times_power_of_two(value, -second));
            (of_size_one.collect(), first + second)
        };
        let ((q, unit), (covering, _)) = (of_size_one(q), of_size_one(covering));
        Scaled { fill: Box::new(fill), scale, q, unit, covering }
    }

    /// Number of equations.
    pub fn size(&self) -> usize {
        self.q.len()
    }

    /// The `z` of the problem that is not scaled.
    pub fn unscaled(&self, z: impl Iterator<Item = f64>) -> Vec<f64> {
        let ray = self.unscaled_ray(z);
        ray.into_iter().map(|z| times_power_of_two(z, self.unit)).collect()
    }

    /// The direction of `z` in the problem that is not scaled.
    pub fn unscaled_ray(&self, z: impl Iterator<Item = f64>) -> Vec<f64> {
        z.zip(&self.scale).map(|(z, scale)| z.max(0.0) * scale).collect()
    }

    /// Writes column `j` of `M`, scaled.
    pub fn write_column(&self, j: usize, column: &mut [f64]) {
        (self.fill)(j, column);
        for (entry, row_scale) in column.iter_mut().zip(&self.scale) {
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
