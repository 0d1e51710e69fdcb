//! Eigenvalues and eigenvectors of dense symmetric matrices, by nalgebra.
//!
//! faer's need 64 KiB of stack (`small_products.rs`).

use nalgebra::{DMatrix, SymmetricEigen};

/// Largest eigenvalue of the symmetric `n x n` matrix `entry(i, j)`; `None` if an entry is not finite, or there is
/// none.
pub fn largest_eigenvalue(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<f64> {
    let matrix = finite(n, entry)?;
    matrix.symmetric_eigenvalues().iter().copied().reduce(f64::max)
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
