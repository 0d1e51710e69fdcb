//! A symmetric positive definite matrix with a proved lower bound on its eigenvalues.
//!
//! If `A - c = L Lᵀ + E` with any `L`, then no eigenvalue of `A` is below `c - |E|`: `L Lᵀ` has none below zero.
//! `L` is Cholesky's factor, `c` half of the least eigenvalue that inverse iteration finds, and `E` is computed
//! with bounds on its rounding, so that nothing is assumed of the factorisation. It takes a quarter of what an
//! inverse takes (S. M. Rump, *Verification of positive definiteness*, BIT 46 (2006) 433-452, has the idea).

use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, Mat, Par};

use super::ball::{product_up, sum_of_products_up, sum_up};
use super::factor::{Factor, cholesky};
use super::vector::{norm, norm_inf};

/// Steps of inverse iteration: the shift may be half of the eigenvalue, and need not be exact.
const ITERATIONS: usize = 4;

/// Shifts that are tried, as parts of the eigenvalue that is found.
const SHIFTS: [f64; 2] = [0.5, 0.05];

/// Rounding of the entries as they are given, and of the shift, relative.
const GIVEN: f64 = 8.0 * f64::EPSILON;

/// A matrix with its factor.
pub struct Definite {
    factor: Factor,
    least: f64,
}

impl Definite {
    /// The matrix of `n` rows whose columns `fill(j, column)` writes, each entry known up to [`GIVEN`], relative;
    /// `None` if it is not proved to be positive definite: that its symmetric part is.
    pub fn new(n: usize, mut fill: impl FnMut(usize, &mut [f64])) -> Option<Self> {
        let mut matrix = Mat::zeros(n, n);
        for j in 0..n {
            fill(j, matrix.col_as_slice_mut(j));
        }
        let sizes = lower_symmetric_part(&mut matrix);
        let mut factor =
            Factor::new(n, true, |j, column| column.copy_from_slice(matrix.col_as_slice(j)))?;
        let found = least_eigenvalue(&mut factor);
        let doubt = product_up(GIVEN, norm_inf(&sizes));
        let bound = |part: f64| above(&matrix, part * found, doubt);
        let least = SHIFTS.into_iter().find_map(bound)?;
        Some(Definite { factor, least })
    }

    /// Overwrites a right-hand side with the approximate solution.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.factor.solve(rhs);
    }

    /// Not above any `x . A x / |x|²`.
    pub fn least(&self) -> f64 {
        self.least
    }
}

/// Overwrites the lower triangle with that of the symmetric part, and returns bounds on the absolute sums of
/// its rows with those of the columns.
fn lower_symmetric_part(matrix: &mut Mat<f64>) -> Vec<f64> {
    let n = matrix.nrows();
    let mut sums = vec![0.0; n];
    for j in 0..n {
        for i in j..n {
            let (below, above) = (matrix[(i, j)], matrix[(j, i)]);
            matrix[(i, j)] = if below == above { below } else { 0.5 * below + 0.5 * above };
            let size = below.abs() + above.abs();
            sums[i] += size;
            sums[j] += size;
        }
    }
    sums.iter().map(|&sum| sum_of_products_up(sum, 2 * n)).collect()
}

/// The least eigenvalue, roughly.
fn least_eigenvalue(factor: &mut Factor) -> f64 {
    // No symmetry of a structure has this vector without a part along the eigenvector.
    let mut x: Vec<f64> = (0..factor.size()).map(|i| 1.0 + (i as f64).sin()).collect();
    let mut found = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let before = norm(&x);
        x.iter_mut().for_each(|x| *x /= before);
        factor.solve(&mut x);
        found = 1.0 / norm(&x);
    }
    found
}

/// A positive bound below all eigenvalues of the symmetric matrix, of which the lower triangle is read and
/// which is known up to `doubt` in each absolute row sum; `None` if they are not proved to be above `shift`
/// by as much as rounding leaves.
fn above(matrix: &Mat<f64>, shift: f64, doubt: f64) -> Option<f64> {
    let n = matrix.nrows();
    let mut shifted = matrix.clone();
    (0..n).for_each(|i| shifted[(i, i)] -= shift);
    let mut factor = shifted.clone();
    cholesky(&mut factor)?;
    // The product overwrites the lower triangle by what is left.
    matmul(
        shifted.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        factor.as_ref(),
        BlockStructure::TriangularLower,
        factor.as_ref().transpose(),
        BlockStructure::TriangularUpper,
        -1.0,
        Par::Seq,
    );
    let (mut left, mut size, mut across) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
    for j in 0..n {
        for i in j..n {
            let (rest, entry) = (shifted[(i, j)].abs(), matrix[(i, j)].abs() + shift);
            left[i] += rest;
            size[i] += entry;
            if i > j {
                left[j] += rest;
                size[j] += entry;
            }
            across[j] += factor[(i, j)].abs();
        }
    }
    // |L| |Lᵀ| 1.
    for (j, across) in across.iter().enumerate() {
        for i in j..n {
            size[i] += factor[(i, j)].abs() * across;
        }
    }
    let rounding = (n as f64 + 8.0) * f64::EPSILON;
    let row = |(left, size): (&f64, &f64)| {
        sum_up(sum_of_products_up(*left, n), product_up(rounding, sum_of_products_up(*size, 3 * n)))
    };
    let most =
        left.iter().zip(&size).map(row).fold(doubt, |most, row| sum_up(row, doubt).max(most));
    let proved = (shift - most).next_down();
    (proved > 0.0).then_some(proved)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix 2 on the diagonal, −1 beside it, has the least eigenvalue `4 sin²(π / (2 (n + 1)))`.
    #[test]
    fn the_bound_is_below_the_least_eigenvalue() {
        for n in [1_usize, 2, 5, 40, 200] {
            let fill = |j: usize, column: &mut [f64]| {
                column[j] = 2.0;
                for i in [j.wrapping_sub(1), j + 1] {
                    if let Some(entry) = column.get_mut(i) {
                        *entry = -1.0;
                    }
                }
            };
            let bound = Definite::new(n, fill).expect("it is definite").least();
            let exact = 4.0 * (std::f64::consts::PI / (2.0 * (n as f64 + 1.0))).sin().powi(2);
            assert!(bound <= exact && bound > 0.04 * exact, "{n}: {bound:e}, {exact:e}");
        }
        // Singular, and indefinite.
        for beside in [1.0, 1.5] {
            let fill = |j: usize, column: &mut [f64]| {
                column.fill(beside);
                column[j] = 1.0;
            };
            assert!(Definite::new(2, fill).is_none());
        }
    }
}
