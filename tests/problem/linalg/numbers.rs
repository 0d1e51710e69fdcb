//! Balls, rounding errors and powers of two.

use super::ball::{Ball, UNIT};
use super::double_double::{two_product, two_sum};
use super::power_of_two::{dot_in_own_unit, exponent, largest_exponent, times_power_of_two};

/// Quotients of whole numbers, compared by multiplication in 128 bits.
#[test]
fn results_are_within_their_balls() {
    let mut rng = fastrand::Rng::with_seed(1);
    for _ in 0..10_000 {
        let [a, b] = [0; 2].map(|_| rng.i64(1..1 << 40));
        let (x, y) = (Ball::exact(a as f64), Ball::exact(b as f64));
        // a / b * b / a = 1, and (sqrt(a))² = a.
        let one = x / y * y / x;
        assert!(one.distance_to(1.0) >= 0.0 && one.least() <= 1.0 && one.size() >= 1.0);
        assert!(one.radius() < 1e-14);
        let square = x.sqrt() * x.sqrt();
        assert!(square.least() <= a as f64 && square.size() >= a as f64);
        let difference = (x / y - Ball::exact(a as f64 / b as f64)) * y;
        // The remainder of the rounded quotient, exactly.
        let rest = (-(a as f64 / b as f64)).mul_add(b as f64, a as f64);
        assert!((difference.middle() - rest).abs() <= difference.radius() * (1.0 + UNIT));
    }
}

#[test]
fn what_is_not_known_is_not_positive() {
    let wide = Ball::new(1.0, 1.0);
    for nothing in
        [wide.sqrt(), Ball::exact(1.0) / wide, Ball::exact(f64::MAX) * Ball::new(2.0, 0.0)]
    {
        assert!(!nothing.is_positive() && !(-nothing).is_positive());
    }
    let least = f64::from_bits(1);
    assert!((Ball::exact(least) * Ball::exact(0.25)).size() >= least * 0.5);
}

/// Whole numbers below 2^100: what 128-bit integers give exactly.
#[test]
fn products_and_sums_of_whole_numbers_are_exact() {
    let mut rng = fastrand::Rng::with_seed(1);
    let whole = |(high, low): (f64, f64)| high as i128 + low as i128;
    for _ in 0..10_000 {
        let [p, q] = [0; 2].map(|_| rng.i64(-(1 << 50)..1 << 50));
        let [a, b] = [p as f64, q as f64];
        let (product, exact) = (two_product(a, b), i128::from(p) * i128::from(q));
        assert_eq!(whole(product), exact);
        // A whole number, so large that the sum drops digits.
        let large = product.0;
        assert_eq!(whole(two_sum(large, a)), large as i128 + i128::from(p));
        assert_eq!(whole(two_sum(b, large)), large as i128 + i128::from(q));
    }
}

/// `(1 + e)(1 - e) - 1 = -e²`, which double precision loses.
#[test]
fn cancellation_leaves_the_digits() {
    let e = 2_f64.powi(-40);
    assert_eq!(two_product(1.0 + e, 1.0 - e), (1.0, -e * e));
    assert_eq!(two_sum(1.0, -e * e), (1.0, -e * e));
}

#[test]
fn exponents_are_exact() {
    for e in -1074..1024 {
        let power = times_power_of_two(1.0, e);
        assert_eq!(exponent(power), e);
        assert_eq!(exponent(-power), e);
        assert_eq!(times_power_of_two(power, -e), 1.0);
    }
    assert_eq!(exponent(f64::MAX), 1023);
    assert_eq!(times_power_of_two(1.5, 2000), f64::INFINITY);
    assert_eq!(times_power_of_two(1.5, -2200), 0.0);
    assert_eq!(largest_exponent([0.0, 5e-324, -3.0]), Some(1));
    assert_eq!(largest_exponent([0.0]), None);
    let dot = |a: [f64; 2], b: [f64; 2]| dot_in_own_unit(a.into_iter().zip(b));
    assert_eq!(dot([1e308, 1.0], [-1.5e308, 1e-320]).sum.signum(), -1.0);
    let smallest = dot([0.0, 5e-324], [1.0, 5e-324]);
    assert_eq!((smallest.sum, smallest.terms, smallest.unit), (1.0, 1.0, -2148));
}
