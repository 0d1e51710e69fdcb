//! Blocks of one pair.

use nalgebra::Matrix2;

/// Largest eigenvalue of the symmetric matrix `[[a, b], [b, c]]`.
pub fn largest_eigenvalue(a: f64, b: f64, c: f64) -> f64 {
    Matrix2::new(a, b, b, c).symmetric_eigenvalues().max()
}

/// Euclidean norm that neither overflows nor underflows on the way; NaN if an entry is.
pub fn norm(values: &[f64]) -> f64 {
    let largest = largest(values);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * values.iter().map(|value| (value / largest).powi(2)).sum::<f64>().sqrt()
}

/// Largest absolute value, 0 for an empty slice; NaN if an entry is.
pub fn largest(values: &[f64]) -> f64 {
    let larger = |most: f64, value: &f64| {
        if value.is_nan() {
            *value
        } else if value.abs() > most {
            value.abs()
        } else {
            most
        }
    };
    values.iter().fold(0.0, larger)
}
