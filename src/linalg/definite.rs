//! A symmetric positive definite matrix with a proved lower bound on its eigenvalues.
//!
//! If `A - c = L Lᵀ + E` with any `L`, then no eigenvalue of `A` is below `c - |E|`: `L Lᵀ` has none below zero.
//! `L` is Cholesky's factor, and `c` half of the least eigenvalue that inverse iteration finds. In whatever
//! order the sums are taken, `|E| <= gamma |L| |Lᵀ|` entry by entry, `gamma = (n + 1) u / (1 - (n + 1) u)`
//! (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, SIAM 2002, theorem 10.3): its row sums
//! take two products with a vector (S. M. Rump, *Verification of positive definiteness*, BIT 46 (2006)
//! 433-452, has the idea).

use super::ball::{product_up, sum_of_products_up, sum_up};
use super::columns::Columns;
use super::factor::{Factor, cholesky};
use super::matrix::tiles;
use super::tolerances::{FEW_OPERATIONS, SINGULAR};
use super::vector::{norm, norm_inf};
use super::watched::{GoesOn, filled};

/// Steps of inverse iteration: the shift may be half of the eigenvalue, and need not be exact.
const ITERATIONS: usize = 4;

/// Shifts that are tried, as parts of the eigenvalue that is found.
const SHIFTS: [f64; 2] = [0.5, 0.05];

/// Roundings of an entry of the factor beside those of the theorem: the shift, and a pivot whose inverse
/// multiplies. [`f64::EPSILON`] is twice the rounding `u`, which covers the rest.
const SPARE: f64 = 8.0;

/// A matrix with its factor.
pub struct Definite {
    factor: Factor,
    /// Not above any `x . A x / |x|²`.
    pub least: f64,
}

impl Definite {
    /// The matrix of `n` rows whose columns `fill(j, column)` writes, each entry known up to [`FEW_OPERATIONS`], relative;
    /// `None` if it is not proved to be positive definite, that its symmetric part is, or where `goes_on` says no.
    pub fn new(
        n: usize,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let mut matrix = filled((n, n), fill, goes_on)?;
        let sizes = lower_symmetric_part(&mut matrix);
        let lower = |j: usize, column: &mut [f64]| {
            column[j..].copy_from_slice(&matrix.column(j)[j..]);
        };
        let factor = Factor::new(n, true, SINGULAR, lower, goes_on)?;
        let found = least_eigenvalue(&factor);
        let doubt = product_up(FEW_OPERATIONS, norm_inf(&sizes));
        let bound = |part: f64| above(&matrix, part * found, doubt, goes_on);
        let least = SHIFTS.into_iter().find_map(bound)?;
        Some(Definite { factor, least })
    }

    /// Overwrites a right-hand side with the approximate solution.
    pub fn solve(&self, rhs: &mut [f64]) {
        self.factor.solve(rhs);
    }
}

/// Overwrites the lower triangle with that of the symmetric part, and returns bounds on the absolute sums of
/// its rows with those of the columns.
fn lower_symmetric_part(matrix: &mut Columns) -> Vec<f64> {
    let n = matrix.nrows();
    let mut sums = vec![0.0; n];
    for (columns, rows) in tiles(n) {
        for j in columns {
            for i in rows.start.max(j)..rows.end {
                let (below, above) = (matrix[(i, j)], matrix[(j, i)]);
                matrix[(i, j)] = if below == above { below } else { 0.5 * below + 0.5 * above };
                let size = below.abs() + above.abs();
                sums[i] += size;
                sums[j] += size;
            }
        }
    }
    sums.iter().map(|&sum| sum_of_products_up(sum, 2 * n)).collect()
}

/// The least eigenvalue, roughly.
fn least_eigenvalue(factor: &Factor) -> f64 {
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
/// by as much as rounding leaves, or where `goes_on` says no.
fn above(matrix: &Columns, shift: f64, doubt: f64, goes_on: GoesOn<'_>) -> Option<f64> {
    let n = matrix.nrows();
    let copy = |j: usize, column: &mut [f64]| {
        column.copy_from_slice(matrix.column(j));
        column[j] -= shift;
    };
    let mut factor = filled((n, n), copy, goes_on)?;
    cholesky(factor.as_mut(), goes_on)?;
    // |L| |Lᵀ| 1.
    let mut size = vec![0.0; n];
    for j in 0..n {
        let column = &factor.column(j)[j..];
        let across: f64 = column.iter().map(|entry| entry.abs()).sum();
        size[j..].iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry.abs() * across);
    }
    let gamma = (n as f64 + SPARE) * f64::EPSILON;
    let row = |size: f64| sum_up(product_up(gamma, sum_of_products_up(size, 2 * n)), doubt);
    let most = size.into_iter().map(row).fold(0.0, |most: f64, row| most.max(row));
    let proved = (shift - most).next_down();
    (proved > 0.0).then_some(proved)
}
