//! Vectors of any length, and the 2 x 2 block of two tangents.

use nalgebra::Matrix2;

use super::simd::{AT_ONCE, vectorised};

/// Largest eigenvalue of the symmetric matrix `[[a, b], [b, c]]`.
pub fn largest_eigenvalue(a: f64, b: f64, c: f64) -> f64 {
    0.5 * a + 0.5 * c + (0.5 * a - 0.5 * c).hypot(b)
}

/// Both eigenvalues of the symmetric matrix `[[a, b], [b, c]]`, the smaller one first, and the unit vector that belongs to
/// it.
pub fn stiffness_axes(a: f64, b: f64, c: f64) -> ([f64; 2], [f64; 2]) {
    let eigen = Matrix2::new(a, b, b, c).symmetric_eigen();
    let (least, most) = (eigen.eigenvalues.imin(), eigen.eigenvalues.imax());
    let vector = eigen.eigenvectors.column(least);
    ([eigen.eigenvalues[least], eigen.eigenvalues[most]], [vector[0], vector[1]])
}

/// Euclidean norm that neither overflows nor underflows on the way; NaN if an entry is.
pub fn norm(values: &[f64]) -> f64 {
    norm_of(values.iter().copied())
}

/// As [`norm`].
#[inline]
pub fn norm_of(values: impl Iterator<Item = f64>) -> f64 {
    let mut sum = NormSum::default();
    values.for_each(|value| sum.add(value));
    sum.root()
}

/// The first entry that is infinite or NaN.
pub fn first_not_finite(values: &[f64]) -> Option<usize> {
    // Without an early end, for the vectoriser: nearly always all are finite, and zero times them is zero.
    let (chunks, last) = values.as_chunks::<AT_ONCE>();
    let mut zeros = [0.0; AT_ONCE];
    vectorised(
        #[inline(always)]
        || chunks.iter().for_each(|values| (0..AT_ONCE).for_each(|k| zeros[k] += 0.0 * values[k])),
    );
    let all = zeros == [0.0; AT_ONCE] && last.iter().all(|value| value.is_finite());
    if all { None } else { values.iter().position(|value| !value.is_finite()) }
}

/// Largest absolute value, 0 for an empty slice; NaN if an entry is.
pub fn norm_inf(values: &[f64]) -> f64 {
    largest_of(values.iter().copied())
}

/// Largest absolute value of `values`, 0 if there are none; NaN if one is.
pub fn largest_of(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |most: f64, size: f64| if size.is_nan() || size > most { size } else { most };
    values.into_iter().map(f64::abs).fold(0.0, larger)
}

/// Absolute values.
pub fn sizes(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| value.abs()).collect()
}

/// The values with their signs changed.
pub fn opposite(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| -value).collect()
}

/// Inner product.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The sum of vectors of a length, each times its share.
pub fn combination(
    length: usize,
    parts: impl IntoIterator<Item = (f64, impl AsRef<[f64]>)>,
) -> Vec<f64> {
    let mut sum = vec![0.0; length];
    for (share, vector) in parts {
        sum.iter_mut().zip(vector.as_ref()).for_each(|(sum, v)| *sum += share * v);
    }
    sum
}

/// Divides a vector that is not zero by its largest absolute value.
pub fn normalise(values: &mut [f64]) {
    let largest = norm_inf(values);
    values.iter_mut().for_each(|value| *value /= largest);
}

/// A Euclidean norm, entry by entry, that neither overflows nor underflows (Blue 1978): squares of
/// large and of small entries are scaled, each in its own sum, so that no entry takes a division.
#[derive(Default)]
pub struct NormSum {
    large: f64,
    usual: f64,
    small: f64,
}

/// Entries above are large: the squares of 1e26 entries below do not overflow. Entries below its inverse are small:
/// squares of those above are normal numbers.
const LARGE: f64 = 1e140;

/// Large entries are divided by it and small ones multiplied: what comes out has normal squares.
const SCALE: f64 = 1e200;

impl NormSum {
    /// Adds an entry.
    #[inline]
    pub fn add(&mut self, value: f64) {
        let size = value.abs();
        if size > LARGE {
            self.large += (size / SCALE).powi(2);
        } else if size < 1.0 / LARGE {
            self.small += (size * SCALE).powi(2);
        } else {
            self.usual += size * size;
        }
    }

    /// The norm of the entries so far; NaN if one of them is.
    pub fn root(&self) -> f64 {
        let usual = self.usual.sqrt();
        // `hypot` would drop a NaN beside an infinity.
        if usual.is_nan() || (self.large == 0.0 && self.small == 0.0) {
            return usual;
        }
        (self.large.sqrt() * SCALE).hypot(usual).hypot(self.small.sqrt() / SCALE)
    }
}

/// So many vectors of the same length that stand one behind the other.
pub fn columns(all: &[f64], count: usize) -> Vec<Vec<f64>> {
    let length = all.len() / count.max(1);
    (0..count).map(|k| all[length * k..length * (k + 1)].to_vec()).collect()
}
