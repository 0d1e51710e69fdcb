//! Vectors of any length, and the 2 x 2 block of two tangents.

use nalgebra::Matrix2;

/// Largest eigenvalue of the symmetric matrix `[[a, b], [b, c]]`.
pub fn largest_eigenvalue(a: f64, b: f64, c: f64) -> f64 {
    Matrix2::new(a, b, b, c).symmetric_eigenvalues().max()
}

/// Euclidean norm that neither overflows nor underflows on the way; NaN if an entry is.
pub fn norm(values: &[f64]) -> f64 {
    let largest = norm_inf(values);
    if largest == 0.0 || !largest.is_finite() {
        return largest;
    }
    largest * values.iter().map(|value| (value / largest).powi(2)).sum::<f64>().sqrt()
}

/// Largest absolute value, 0 for an empty slice; NaN if an entry is.
pub fn norm_inf(values: &[f64]) -> f64 {
    largest_of(values.iter().copied())
}

/// Largest absolute value of `values`, 0 if there are none; NaN if one is.
pub fn largest_of(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, value: f64| {
        if value.is_nan() {
            value
        } else if value.abs() > most {
            value.abs()
        } else {
            most
        }
    };
    values.into_iter().fold(0.0, larger)
}

/// Inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Divides a vector that is not zero by its largest absolute value.
pub fn normalise(values: &mut [f64]) {
    let largest = norm_inf(values);
    values.iter_mut().for_each(|value| *value /= largest);
}

/// A Euclidean norm, entry by entry, that neither overflows nor underflows.
#[derive(Default)]
pub struct NormSum {
    largest: f64,
    /// Sum of the squares relative to `largest`.
    squares: f64,
}

impl NormSum {
    /// Adds an entry.
    pub fn add(&mut self, value: f64) {
        let size = value.abs();
        if size > self.largest {
            self.squares = 1.0 + self.squares * (self.largest / size).powi(2);
            self.largest = size;
        } else if size > 0.0 {
            self.squares += (size / self.largest).powi(2);
        } else if size.is_nan() {
            self.squares = f64::NAN;
            self.largest = f64::NAN;
        }
    }

    /// The norm of the entries so far; NaN if one of them is.
    pub fn root(&self) -> f64 {
        if self.largest.is_finite() { self.largest * self.squares.sqrt() } else { self.largest }
    }
}
