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

/// Adds steps to numbers in two parts.
pub fn add_to_parts((high, low): (&mut [f64], &mut [f64]), steps: impl IntoIterator<Item = f64>) {
    for ((high, low), step) in high.iter_mut().zip(low).zip(steps) {
        let (sum, lost) = two_sum(*high, step);
        (*high, *low) = two_sum(sum, lost + *low);
    }
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
