//! Loops over contiguous columns, compiled for several instruction sets and chosen at run time.
//!
//! `dispatch` recompiles its closure with AVX2 and FMA where the processor has them; the loops
//! are written for the vectoriser.

use pulp::Arch;

/// The instruction set, detected once by the caller and handed to each loop.
pub type Simd = Arch;

/// `y -= a x`.
#[inline]
pub fn subtract(simd: Simd, y: &mut [f64], a: f64, x: &[f64]) {
    simd.dispatch(
        #[inline(always)]
        || {
            for (y, x) in y.iter_mut().zip(x) {
                *y = (-a).mul_add(*x, *y);
            }
        },
    );
}

/// `y -= a x + b z`, in one pass over `y`.
#[inline]
pub fn subtract2(simd: Simd, y: &mut [f64], (a, x): (f64, &[f64]), (b, z): (f64, &[f64])) {
    simd.dispatch(
        #[inline(always)]
        || {
            for ((y, x), z) in y.iter_mut().zip(x).zip(z) {
                *y = (-b).mul_add(*z, (-a).mul_add(*x, *y));
            }
        },
    );
}
