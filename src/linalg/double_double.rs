//! Sums and products with their rounding errors, exactly where nothing overflows or is subnormal.
//!
//! D. E. Knuth, *The Art of Computer Programming*, volume 2, 4.2.2 (the sum); T. Ogita, S. M. Rump and
//! S. Oishi, *Accurate sum and dot product*, SIAM J. Sci. Comput. 26 (2005) 1955-1988 (the inner product).

/// `a + b` and its rounding error, exactly (Knuth).
#[inline(always)]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// `a b` and its rounding error, exactly, by a fused multiplication and addition; to be called inside [`vectorised`], which
/// makes that one instruction.
///
/// [`vectorised`]: super::simd::vectorised
#[inline(always)]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let product = a * b;
    (product, a.mul_add(b, -product))
}
