//! Loops over contiguous columns, compiled for several instruction sets and chosen at run time.
//!
//! [`vectorised`] compiles its closure once more for AVX2 and for AVX-512, and runs the widest version that the
//! processor has; the loops are written for the vectoriser and inlined there. They multiply, then
//! add, unfused, and where they fuse they say so by `mul_add`, which rounds once everywhere: the result does
//! not depend on the instruction set. Processors without a fused operation compute it slowly.

use pulp::Arch;

use crate::workers::{pieces, reading};

/// Runs `work` with the widest vectors that the processor has, which is looked up once in a process.
#[inline(always)]
pub fn vectorised<R>(work: impl FnOnce() -> R) -> R {
    Arch::new().dispatch(work)
}

/// `y += a x`; to be called inside [`vectorised`].
#[inline(always)]
pub fn axpy(y: &mut [f64], a: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += a * x;
    }
}

/// Columns that are read in one pass: as fast as memory gives them, also by parts of their rows.
pub const AT_ONCE: usize = 8;

/// `y += x a`, the columns in one pass over `y`, in their order; to be called inside [`vectorised`].
#[inline(always)]
pub fn add_columns<const N: usize>(y: &mut [f64], a: [f64; N], x: [&[f64]; N]) {
    let x = x.map(|x| &x[..y.len()]);
    for (i, y) in y.iter_mut().enumerate() {
        *y = (0..N).fold(*y, |sum, c| sum + x[c][i] * a[c]);
    }
}

/// `y -= A x`, for contiguous columns of `A` as long as `y`. Threads share the rows.
pub fn subtract_columns(y: &mut [f64], columns: &[f64], x: &[f64]) {
    let size = y.len();
    pieces([y], reading(columns.len()), |first, [y]| {
        let rows = first..first + y.len();
        let column = |c: usize| &columns[size * c..size * (c + 1)][rows.clone()];
        vectorised(
            #[inline(always)]
            || {
                let (fours, left) = x.as_chunks::<4>();
                for (k, four) in fours.iter().enumerate() {
                    add_columns(y, four.map(|x| -x), std::array::from_fn(|c| column(4 * k + c)));
                }
                for (x, c) in left.iter().zip(4 * fours.len()..) {
                    axpy(y, -x, column(c));
                }
            },
        );
    });
}

/// [`add_columns`] with the absolute values of `x`.
#[inline(always)]
pub fn add_sizes<const N: usize>(y: &mut [f64], a: [f64; N], x: [&[f64]; N]) {
    let x = x.map(|x| &x[..y.len()]);
    for (i, y) in y.iter_mut().enumerate() {
        *y = (0..N).fold(*y, |sum, c| sum + x[c][i].abs() * a[c]);
    }
}

/// `high + low += x a`, the columns in one pass: `high` takes of each product what is a multiple of its
/// own last digit, without error as long as its exponent stays, and `low` the rest; and to `sizes` the absolute values of
/// the products. To be called inside [`vectorised`].
#[inline(always)]
pub fn add_twice<const N: usize>([high, low, sizes]: [&mut [f64]; 3], a: [f64; N], x: [&[f64]; N]) {
    let x = x.map(|x| &x[..high.len()]);
    for (i, ((high, low), size)) in high.iter_mut().zip(low).zip(sizes).enumerate() {
        // Sums of their own stay in registers.
        let mut sums = (*high, *low, *size);
        for (a, x) in a.iter().zip(x) {
            let sum = a.mul_add(x[i], sums.0);
            sums.1 += a.mul_add(x[i], sums.0 - sum);
            sums.0 = sum;
            sums.2 += (a * x[i]).abs();
        }
        (*high, *low, *size) = sums;
    }
}
