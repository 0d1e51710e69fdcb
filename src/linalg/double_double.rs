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

/// Twice the working precision, by which tests judge: a number as the sum of two doubles, `high + low` with
/// `|low| <= ulp(high) / 2`.
///
/// With `u = 2^-53`, and where nothing overflows or is subnormal:
///
/// | operation | error |
/// |---|---|
/// | [`DoubleDouble::plus`] | `3 u² (\|a\| + \|b\|)` at most |
/// | [`DoubleDouble::times`] | `8 u² \|a b\|` at most |
/// | [`dot`] | `n² u² sum \|a_i b_i\|` at most, before it is rounded: that of a sum taken in twice the precision |
#[cfg(test)]
pub mod reference {
    use super::{two_product, two_sum};

    /// `high + low`.
    #[derive(Clone, Copy, Debug, Default, PartialEq)]
    pub struct DoubleDouble {
        high: f64,
        low: f64,
    }

    impl DoubleDouble {
        /// `a + b`, exactly.
        pub fn sum(a: f64, b: f64) -> Self {
            let (high, low) = two_sum(a, b);
            DoubleDouble { high, low }
        }

        /// The number rounded to a double, and what is left of it.
        pub fn parts(self) -> (f64, f64) {
            (self.high, self.low)
        }

        /// `self + other`.
        pub fn plus(self, other: Self) -> Self {
            let (high, first) = two_sum(self.high, other.high);
            let (low, second) = two_sum(self.low, other.low);
            let (high, first) = two_sum(high, first + low);
            Self::sum(high, first + second)
        }

        /// `self other`.
        pub fn times(self, other: Self) -> Self {
            let (high, low) = two_product(self.high, other.high);
            Self::sum(high, low + (self.high * other.low + self.low * other.high))
        }

        /// `-self`.
        pub fn negated(self) -> Self {
            DoubleDouble { high: -self.high, low: -self.low }
        }
    }

    /// Inner product.
    pub fn dot(a: &[f64], b: &[f64]) -> DoubleDouble {
        let (mut high, mut low) = (0.0, 0.0);
        for (&a, &b) in a.iter().zip(b) {
            let (product, error) = two_product(a, b);
            let (sum, lost) = two_sum(high, product);
            high = sum;
            low += error + lost;
        }
        DoubleDouble::sum(high, low)
    }
}

#[cfg(test)]
mod tests {
    use super::reference::{DoubleDouble, dot};

    /// Whole numbers below 2^100: what 128-bit integers give exactly.
    #[test]
    fn products_and_sums_of_whole_numbers_are_exact() {
        let mut rng = fastrand::Rng::with_seed(1);
        let whole = |x: DoubleDouble| x.parts().0 as i128 + x.parts().1 as i128;
        for _ in 0..10_000 {
            let numbers: Vec<i64> = (0..4).map(|_| rng.i64(-(1 << 50)..1 << 50)).collect();
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| numbers[i] as f64);
            let [p, q, r, s] = [0, 1, 2, 3].map(|i| i128::from(numbers[i]));
            let products = dot(&[a, c], &[b, d]);
            assert_eq!(whole(products), p * q + r * s);
            let (one, two) = (dot(&[a], &[b]), dot(&[c], &[d]));
            assert_eq!(whole(one.plus(two.negated())), p * q - r * s);
        }
    }

    /// `(1 + e)(1 - e) - 1 = -e²`, which double precision loses; and the product of two numbers of twice the
    /// precision, `(1 + e)² = 1 + 2 e + e²`, to `8 u²`, about 1e-31.
    #[test]
    fn cancellation_leaves_the_digits() {
        let e = 2_f64.powi(-40);
        let difference = dot(&[1.0 + e, -1.0], &[1.0 - e, 1.0]);
        assert_eq!(difference.parts(), (-e * e, 0.0));
        let e = 2_f64.powi(-60);
        let square = DoubleDouble::sum(1.0, e).times(DoubleDouble::sum(1.0, e));
        let rest = square.plus(DoubleDouble::sum(-1.0, -2.0 * e));
        assert!((rest.parts().0 - e * e).abs() <= 1e-31);
    }
}
