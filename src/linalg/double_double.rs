//! Twice the working precision: a number as the sum of two doubles, `high + low` with
//! `|low| <= ulp(high) / 2`.
//!
//! With `u = 2^-53`, and where nothing overflows or is subnormal:
//!
//! | operation | error |
//! |---|---|
//! | [`two_sum`], [`two_product`] | none: result and error are both returned |
//!
//! D. E. Knuth, *The Art of Computer Programming*, volume 2, 4.2.2 (the sum); T. Ogita, S. M. Rump and
//! S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005) 1955-1988 (the inner product).

/// `a + b` and its rounding error, exactly (Knuth).
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// `a b` and its rounding error, exactly, by a fused multiplication and addition.
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}
