//! Eigenvalues and eigenvectors of dense symmetric matrices: small ones by nalgebra, the largest of a large one by
//! Lanczos' method.
//!
//! faer's need 64 KiB of stack (`small_products.rs`).

use nalgebra::{DMatrix, SymmetricEigen};

use super::factor::Factor;
use super::gmres::orthogonalised;
use super::matrix::Matrix;
use super::tolerances::{ROUNDING, SINGULAR};
use super::vector::norm;
use super::watched::GoesOn;

/// Most directions of Lanczos' method: three digits of the largest eigenvalue wherever it stands out by a per cent.
const DIRECTIONS: usize = 60;

/// The largest eigenvalue of a symmetric positive semi-definite matrix from below, to rounding if it has no more than
/// [`DIRECTIONS`] rows; `None` if a number is not finite, or there is none, or where `goes_on` says no. C. Lanczos, J. Res. Nat. Bur. Standards 45 (1950)
/// 255-282, with full orthogonalisation.
pub fn largest_eigenvalue(matrix: &Matrix<'_>, goes_on: GoesOn<'_>) -> Option<f64> {
    let n = matrix.size();
    // A direction that no symmetry of a mesh leaves out.
    let first: Vec<f64> = (0..n).map(|i| 1.0 + 1.0 / (2.0 + i as f64)).collect();
    let mut basis: Vec<Vec<f64>> = Vec::new();
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let (mut next, mut left, mut was) = (first, 1.0, 1.0);
    while basis.len() < n.min(DIRECTIONS) && left > ROUNDING * was {
        if !goes_on() {
            return None;
        }
        let length = norm(&next);
        basis.push(next.iter().map(|v| v / length).collect());
        next = matrix.product(&basis[basis.len() - 1]);
        let column;
        (column, left, was) = orthogonalised(&mut next, &basis);
        columns.push(column);
    }
    let projected = finite(columns.len(), |i, j| columns[i.max(j)][i.min(j)])?;
    projected.symmetric_eigenvalues().iter().copied().reduce(f64::max)
}

/// True if all eigenvalues of a symmetric matrix are below `bound`, by more than rounding of a factorisation; no, where
/// `goes_on` says no.
pub fn is_below(matrix: &Matrix<'_>, bound: f64, goes_on: GoesOn<'_>) -> bool {
    let fill = |j: usize, column: &mut [f64]| {
        column.iter_mut().zip(matrix.column(j)).for_each(|(entry, own)| *entry = -own);
        column[j] += bound;
    };
    Factor::new(matrix.size(), true, SINGULAR, fill, goes_on).is_some()
}

/// Orthonormal eigenvectors of the symmetric `n x n` matrix `entry(i, j)`, by increasing eigenvalues; `None` as in
/// [`largest_eigenvalue`].
pub fn eigenvectors(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Vec<Vec<f64>>> {
    let found = SymmetricEigen::new(finite(n, entry)?);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&i, &j| found.eigenvalues[i].total_cmp(&found.eigenvalues[j]));
    let vector = |j: usize| found.eigenvectors.column(j).iter().copied().collect();
    Some(order.into_iter().map(vector).collect())
}

/// The matrix, if there is one: the iterations for eigenvalues end for numbers only.
fn finite(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<DMatrix<f64>> {
    let matrix = DMatrix::from_fn(n, n, entry);
    (n > 0 && matrix.iter().all(|entry| entry.is_finite())).then_some(matrix)
}
