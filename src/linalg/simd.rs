//! Loops over contiguous columns, compiled for several instruction sets and chosen at run time.
//!
//! [`vectorised`] compiles its closure a second time for AVX2 and runs that version where the
//! processor has it; the loops are written for the vectoriser and inlined there. They multiply, then
//! add, unfused: the result does not depend on the instruction set.

use pulp::Arch;

use super::double_double::{two_product, two_sum};

/// The instruction set, detected once by the caller.
pub type Simd = Arch;

/// Runs `work` with the widest vectors that the processor has.
#[inline(always)]
pub fn vectorised<R>(simd: Simd, work: impl FnOnce() -> R) -> R {
    simd.dispatch(work)
}

/// `y += a x`; to be called inside [`vectorised`].
#[inline(always)]
pub fn axpy(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// `y += a x + b z`, in one pass over `y`; to be called inside [`vectorised`].
#[inline(always)]
pub fn axpy2(y: &mut [f64], (a, x): (f64, &[f64]), (b, z): (f64, &[f64])) {
    for ((y, x), z) in y.iter_mut().zip(x).zip(z) {
        *y += a * x + b * z;
    }
}

/// `high + low += (a + a_low) x`, in twice the precision; to be called inside [`vectorised`].
#[inline(always)]
pub fn axpy_twice((high, low): (&mut [f64], &mut [f64]), (a, a_low): (f64, f64), x: &[f64]) {
    for ((high, low), &x) in high.iter_mut().zip(low).zip(x) {
        let (product, error) = two_product(a, x);
        let (sum, lost) = two_sum(*high, product);
        *high = sum;
        *low += (error + lost) + a_low * x;
    }
}
