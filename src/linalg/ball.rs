//! Real numbers known up to an error: a ball holds every number that is at most `radius` away from `middle`.
//!
//! Every operation returns a ball that holds each result of numbers in its operands. With `u = 2^-53` a
//! rounded result `x` is off by at most `u |x|`, and by half the least positive number where it is subnormal;
//! radii are rounded up after each operation. The rounding mode is not changed. A ball of which nothing is
//! known has a radius that is infinite or no number, and all its comparisons are false.
//!
//! S. M. Rump, *Verification methods: rigorous results using floating-point arithmetic*, Acta Numerica 19
//! (2010) 287-449, section 5 (midpoint and radius).

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The rounding of one operation, relative: `2^-53`.
pub const UNIT: f64 = f64::EPSILON / 2.0;

/// A number between `middle - radius` and `middle + radius`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ball {
    middle: f64,
    radius: f64,
}

/// A vector of a pair.
pub type BallVector = [Ball; 3];

impl Ball {
    /// The numbers at most `radius >= 0` away from `middle`.
    pub fn new(middle: f64, radius: f64) -> Self {
        Ball { middle, radius }
    }

    /// One double.
    pub const fn exact(middle: f64) -> Self {
        Ball { middle, radius: 0.0 }
    }

    /// The middle.
    pub fn middle(self) -> f64 {
        self.middle
    }

    /// The radius.
    pub fn radius(self) -> f64 {
        self.radius
    }

    /// A ball with this middle and a radius that is larger by `by >= 0`.
    pub fn widened(self, by: f64) -> Self {
        Ball { radius: sum_up(self.radius, by), ..self }
    }

    /// `true` if every number of the ball is positive.
    pub fn is_positive(self) -> bool {
        self.least() > 0.0
    }

    /// Not above any number of the ball.
    pub fn least(self) -> f64 {
        (self.middle - self.radius).next_down()
    }

    /// Not below the size of any number of the ball.
    pub fn size(self) -> f64 {
        sum_up(self.middle.abs(), self.radius)
    }

    /// Not below the distance of any number of the ball to `x`.
    pub fn distance_to(self, x: f64) -> f64 {
        sum_up((self.middle - x).abs().next_up(), self.radius)
    }

    /// Square root, of a ball of positive numbers.
    pub fn sqrt(self) -> Self {
        if !self.is_positive() {
            return Ball::new(f64::NAN, f64::INFINITY);
        }
        // |sqrt(a) - sqrt(b)| = |a - b| / (sqrt(a) + sqrt(b)).
        let least = self.least().sqrt().next_down();
        Ball::rounded(self.middle.sqrt(), (self.radius / least).next_up())
    }

    /// A rounded result whose exact value is at most `radius` from the result's exact middle.
    fn rounded(middle: f64, radius: f64) -> Self {
        Ball { middle, radius: sum_up((UNIT * middle.abs()).next_up(), radius) }
    }
}

/// `a + b` of numbers that are not negative, rounded up.
pub fn sum_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { a + b } else { (a + b).next_up() }
}

/// `a b` of numbers that are not negative, rounded up.
pub fn product_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 { a * b } else { (a * b).next_up() }
}

/// A bound on the sum of `terms` products of numbers that are not negative, of which doubles give `sum` in
/// any order: `n` roundings of products and sums, and what is subnormal.
pub fn sum_of_products_up(sum: f64, terms: usize) -> f64 {
    let count = terms as f64;
    sum_up(sum * (1.0 + (count + 8.0) * f64::EPSILON), count * f64::MIN_POSITIVE)
}

impl Add for Ball {
    type Output = Ball;

    fn add(self, other: Ball) -> Ball {
        let (middle, radius) = (self.middle + other.middle, sum_up(self.radius, other.radius));
        // A sum that is zero is exact.
        if middle == 0.0 { Ball { middle, radius } } else { Ball::rounded(middle, radius) }
    }
}

impl Neg for Ball {
    type Output = Ball;

    fn neg(self) -> Ball {
        Ball { middle: -self.middle, radius: self.radius }
    }
}

impl Sub for Ball {
    type Output = Ball;

    fn sub(self, other: Ball) -> Ball {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Ball;

    fn mul(self, other: Ball) -> Ball {
        let first = product_up(self.middle.abs(), other.radius);
        let second = product_up(self.radius, other.size());
        Ball::rounded(self.middle * other.middle, sum_up(first, second))
    }
}

impl Div for Ball {
    type Output = Ball;

    /// By a ball of numbers of one sign.
    fn div(self, other: Ball) -> Ball {
        let least = (other.middle.abs() - other.radius).next_down();
        if !(least > 0.0) {
            return Ball::new(f64::NAN, f64::INFINITY);
        }
        // a'/b' - a/b = ((a' - a) - (a/b) (b' - b)) / b'.
        let quotient = self.middle / other.middle;
        let part = product_up(quotient.abs().next_up(), other.radius);
        Ball::rounded(quotient, (sum_up(self.radius, part) / least).next_up())
    }
}

/// `a + b + c` of two doubles whose sum is exact up to `c`: see [`super::double_double::two_sum`].
pub fn sum_of_parts(high: f64, lost: f64, low: f64) -> Ball {
    Ball::exact(high) + (Ball::exact(lost) + Ball::exact(low))
}

/// Length, of a vector whose squares neither overflow nor underflow; without a bound otherwise.
pub fn length(t: [Ball; 2]) -> Ball {
    (t[0] * t[0] + t[1] * t[1]).sqrt()
}
