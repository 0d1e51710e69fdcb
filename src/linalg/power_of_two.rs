//! Scaling by powers of two, which is exact: how sums of products are taken whose terms would overflow or
//! underflow as they are.

use super::double_double::{two_product, two_sum};

/// Largest exponent that one multiplication carries; those of doubles lie between −1074 and 1023.
const STEP: i32 = 1000;

/// Exponent of two of a number that is finite and not zero: `2^e <= |x| < 2^(e + 1)`.
pub fn exponent(x: f64) -> i32 {
    let biased = |x: f64| (x.abs().to_bits() >> (f64::MANTISSA_DIGITS - 1)) as i32;
    match biased(x) {
        // A subnormal number.
        0 => biased(x * 2_f64.powi(STEP)) - (f64::MAX_EXP - 1) - STEP,
        biased => biased - (f64::MAX_EXP - 1),
    }
}

/// Largest exponent of the numbers that are not zero, which are finite; `None` if all are zero.
pub fn largest_exponent(values: impl IntoIterator<Item = f64>) -> Option<i32> {
    values.into_iter().filter(|&value| value != 0.0).map(exponent).max()
}

/// `x 2^e`: exact, but for what overflows or is subnormal.
pub fn times_power_of_two(mut x: f64, mut e: i32) -> f64 {
    while e.abs() > STEP && x != 0.0 && x.is_finite() {
        let step = e.clamp(-STEP, STEP);
        x *= 2_f64.powi(step);
        e -= step;
    }
    x * 2_f64.powi(e.clamp(-STEP, STEP))
}

/// An inner product in a unit of its own.
#[derive(Clone, Copy, Debug)]
pub struct OwnUnit {
    /// The sum, times `2^-unit`.
    pub sum: f64,
    /// The sum of the sizes of its terms, times `2^-unit`.
    pub terms: f64,
    /// The exponent of two of the unit.
    pub unit: i32,
}

/// Sum of the products of pairs of finite numbers, in twice the precision, rounded once, and the sum of the sizes of its
/// terms, in a unit of their own: the largest term is between 1 and 4, so that no term that counts overflows or
/// underflows.
pub fn dot_in_own_unit(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> OwnUnit {
    let products = pairs.filter(|(a, b)| *a != 0.0 && *b != 0.0);
    let sizes = products.clone().map(|(a, b)| exponent(a) + exponent(b));
    let unit = sizes.max().unwrap_or(0);
    let (mut sum, mut low, mut terms) = (0.0, 0.0, 0.0);
    for (a, b) in products {
        let (e, f) = (exponent(a), exponent(b));
        let (product, error) = two_product(times_power_of_two(a, -e), times_power_of_two(b, -f));
        let term = times_power_of_two(product, e + f - unit);
        let (next, lost) = two_sum(sum, term);
        (sum, low) = (next, low + (lost + times_power_of_two(error, e + f - unit)));
        terms += term.abs();
    }
    OwnUnit { sum: sum + low, terms, unit }
}
