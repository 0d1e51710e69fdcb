//! A view of a dense square matrix.

use super::simd::{Simd, axpy_twice, vectorised};

/// A square matrix, column-major, in the caller's memory.
#[derive(Clone, Copy, Debug)]
pub struct Matrix<'a> {
    size: usize,
    entries: &'a [f64],
    ld: usize,
}

impl<'a> Matrix<'a> {
    /// Views `size` columns of `size` entries, `ld >= max(1, size)` entries from one column to the
    /// next.
    pub fn new(size: usize, entries: &'a [f64], ld: usize) -> Self {
        Matrix { size, entries, ld }
    }

    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.size
    }

    /// Column `j`.
    #[inline(always)]
    pub fn column(&self, j: usize) -> &'a [f64] {
        &self.entries[j * self.ld..j * self.ld + self.size]
    }

    /// Entry in row `i` and column `j`.
    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.entries[j * self.ld + i]
    }

    /// Square roots of the diagonal, which is positive.
    pub fn diagonal_roots(&self) -> Vec<f64> {
        (0..self.size).map(|i| self.at(i, i).sqrt()).collect()
    }

    /// Adds the product with `x` to `sum`.
    pub fn add_product(&self, x: &[f64], sum: &mut [f64]) {
        for (j, &xj) in x.iter().enumerate() {
            if xj != 0.0 {
                for (sum, entry) in sum.iter_mut().zip(self.column(j)) {
                    *sum += entry * xj;
                }
            }
        }
    }

    /// The product with `x`.
    pub fn product(&self, x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        self.add_product(x, &mut product);
        product
    }

    /// The product with `x + x_low` less `b`, in twice the precision and rounded once.
    pub fn residual(&self, x: &[f64], x_low: &[f64], b: &[f64]) -> Vec<f64> {
        let mut high: Vec<f64> = b.iter().map(|b| -b).collect();
        let mut low = vec![0.0; self.size];
        vectorised(Simd::new(), || {
            for (j, (&xj, &xj_low)) in x.iter().zip(x_low).enumerate() {
                if xj != 0.0 {
                    axpy_twice((&mut high, &mut low), (xj, xj_low), self.column(j));
                }
            }
        });
        high.iter().zip(&low).map(|(high, low)| high + low).collect()
    }

    /// Visits each entry below the diagonal, `lower = at(i, j)`, with the one across it,
    /// `upper = at(j, i)`, until an error.
    pub fn pairs_across<E>(
        &self,
        visit: impl Fn(usize, usize, f64, f64) -> Result<(), E>,
    ) -> Result<(), E> {
        // Square tiles: the transposed entry is read from cache.
        const TILE: usize = 32;
        let n = self.size;
        for j0 in (0..n).step_by(TILE) {
            for i0 in (j0..n).step_by(TILE) {
                for j in j0..(j0 + TILE).min(n) {
                    for i in i0.max(j + 1)..(i0 + TILE).min(n) {
                        visit(i, j, self.column(j)[i], self.column(i)[j])?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Entries that a column-major matrix of `size` rows and columns has to the end of its last column.
///
/// # Errors
/// A sentence, if the leading dimension `ld` is less than `max(1, size)` or absurd.
pub fn required_length(name: &str, size: usize, ld: usize) -> Result<usize, String> {
    let least = size.max(1);
    if ld < least {
        return Err(format!(
            "the leading dimension of {name} is {ld}, it must be at least {least}"
        ));
    }
    let begin_of_last = size.saturating_sub(1).checked_mul(ld);
    begin_of_last
        .and_then(|begin| begin.checked_add(size))
        .ok_or_else(|| format!("the leading dimension of {name} is {ld}: the matrix cannot exist"))
}

/// Whether a square matrix of `size` rows fits the address space.
pub fn can_exist(size: usize) -> bool {
    size.checked_mul(size).is_some_and(|entries| entries <= isize::MAX as usize / size_of::<f64>())
}
