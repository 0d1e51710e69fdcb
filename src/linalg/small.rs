//! Blocks of one pair.

use nalgebra::Matrix2;

/// Largest eigenvalue of the symmetric matrix `[[a, b], [b, c]]`.
pub fn largest_eigenvalue(a: f64, b: f64, c: f64) -> f64 {
    Matrix2::new(a, b, b, c).symmetric_eigenvalues().max()
}

/// Euclidean norm that neither overflows nor underflows on the way.
pub fn norm(values: &[f64]) -> f64 {
    let largest = largest(values);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * values.iter().map(|value| (value / largest).powi(2)).sum::<f64>().sqrt()
}

/// Largest absolute value, 0 for an empty slice.
pub fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}
