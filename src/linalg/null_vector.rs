//! The null vector of a positive semi-definite matrix: a candidate, and how far it is from being one.

use super::sparse_matrix::{Csc, symmetric_magnitude, symmetric_times};
use super::tolerances::INVERSE_ITERATIONS;
use super::vector::{norm_inf, sizes};

/// The vector of `n` entries that `A` resists least, its largest entry 1, by inverse iteration from
/// the unit vector of entry `first`. `solve` overwrites its argument `b` with `A⁻¹ b`.
pub fn weakest(n: usize, first: usize, solve: impl Fn(&mut [f64])) -> Vec<f64> {
    let mut x = vec![0.0; n];
    x[first] = 1.0;
    for _ in 0..INVERSE_ITERATIONS {
        solve(&mut x);
        let most = norm_inf(&x);
        x.iter_mut().for_each(|x| *x /= most);
    }
    x
}

/// Largest entry of `A x`, relative to the largest sum of the sizes of its terms. `A` is symmetric, its
/// `lower` triangle given.
pub fn resistance(lower: &Csc, x: &[f64]) -> f64 {
    norm_inf(&symmetric_times(lower, x)) / norm_inf(&symmetric_magnitude(lower, &sizes(x)))
}
