//! Numbers of twice the precision, for judges: a value is the sum of two doubles that do not overlap,
//! about 106 bits. It shares nothing with the library.
//!
//! Sums and products of two doubles with their exact errors: T. J. Dekker, Numerische Mathematik 18
//! (1971) 224-242; the error of a product by a fused multiply-add.

use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Quad {
    high: f64,
    low: f64,
}

/// `a + b` rounded, and the error of it.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// The sum where `|a| >= |b|`, or `a` is zero.
fn quick_sum(a: f64, b: f64) -> Quad {
    let high = a + b;
    Quad { high, low: b - (high - a) }
}

impl Quad {
    pub const ZERO: Quad = Quad { high: 0.0, low: 0.0 };
    pub const ONE: Quad = Quad { high: 1.0, low: 0.0 };

    /// The exact sum of two doubles.
    pub fn sum(a: f64, b: f64) -> Quad {
        let (high, low) = two_sum(a, b);
        Quad { high, low }
    }

    /// The exact product of two doubles that neither overflows nor underflows.
    pub fn product(a: f64, b: f64) -> Quad {
        let high = a * b;
        Quad { high, low: a.mul_add(b, -high) }
    }

    /// Rounded to a double.
    pub fn value(self) -> f64 {
        self.high
    }

    pub fn abs(self) -> Quad {
        if self.high < 0.0 { -self } else { self }
    }

    pub fn max(self, other: Quad) -> Quad {
        if self < other { other } else { self }
    }

    pub fn min(self, other: Quad) -> Quad {
        if other < self { other } else { self }
    }

    /// One step of Newton from the root of the leading double.
    pub fn sqrt(self) -> Quad {
        if self.high <= 0.0 {
            return Quad::ZERO;
        }
        let root = self.high.sqrt();
        let rest = self - Quad::product(root, root);
        quick_sum(root, rest.high / (2.0 * root))
    }

    /// By a power of two: exact.
    pub fn scaled(self, power: f64) -> Quad {
        Quad { high: self.high * power, low: self.low * power }
    }
}

impl From<f64> for Quad {
    fn from(high: f64) -> Quad {
        Quad { high, low: 0.0 }
    }
}

impl Neg for Quad {
    type Output = Quad;
    fn neg(self) -> Quad {
        Quad { high: -self.high, low: -self.low }
    }
}

impl Add for Quad {
    type Output = Quad;
    fn add(self, other: Quad) -> Quad {
        let (high, error) = two_sum(self.high, other.high);
        let (low, rest) = two_sum(self.low, other.low);
        let sum = quick_sum(high, error + low);
        quick_sum(sum.high, sum.low + rest)
    }
}

impl Sub for Quad {
    type Output = Quad;
    fn sub(self, other: Quad) -> Quad {
        self + -other
    }
}

impl Mul for Quad {
    type Output = Quad;
    fn mul(self, other: Quad) -> Quad {
        let Quad { high, low } = Quad::product(self.high, other.high);
        quick_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Mul<f64> for Quad {
    type Output = Quad;
    fn mul(self, other: f64) -> Quad {
        self * Quad::from(other)
    }
}

impl Div for Quad {
    type Output = Quad;
    /// Long division by doubles, three digits.
    fn div(self, other: Quad) -> Quad {
        let first = self.high / other.high;
        let rest = self - other * first;
        let second = rest.high / other.high;
        let rest = rest - other * second;
        quick_sum(first, second) + Quad::from(rest.high / other.high)
    }
}

impl AddAssign for Quad {
    fn add_assign(&mut self, other: Quad) {
        *self = *self + other;
    }
}

impl SubAssign for Quad {
    fn sub_assign(&mut self, other: Quad) {
        *self = *self - other;
    }
}

impl Sum for Quad {
    fn sum<I: Iterator<Item = Quad>>(values: I) -> Quad {
        values.fold(Quad::ZERO, |sum, value| sum + value)
    }
}

pub fn largest(values: &[Quad]) -> Quad {
    values.iter().fold(Quad::ZERO, |most, value| most.max(value.abs()))
}

/// Euclidean norm. A power of two keeps the squares from overflow and underflow.
pub fn norm(values: &[Quad]) -> Quad {
    let most = largest(values).value();
    if most == 0.0 || !most.is_finite() {
        return Quad::from(most);
    }
    let exponent = most.log2().floor() as i32;
    // In two steps, as 2^-1023 and less are no normal numbers.
    let (half, rest) = (2_f64.powi(-exponent / 2), 2_f64.powi(-exponent - (-exponent / 2)));
    let scaled = values.iter().map(|value| value.scaled(half).scaled(rest));
    let root = scaled.map(|value| value * value).sum::<Quad>().sqrt();
    root.scaled(1.0 / half).scaled(1.0 / rest)
}

/// Pivots below this part of their row are zero: what 30 digits leave of a singular matrix of ordinary
/// size, far below the least eigenvalue that a matrix of doubles has beyond their rounding.
const SINGULAR: f64 = 1e-26;

/// Solves a square system, `matrix` by rows; `None` if it is singular. Partial pivoting on rows of one
/// size.
pub fn solve(mut matrix: Vec<Vec<Quad>>, mut rhs: Vec<Quad>) -> Option<Vec<Quad>> {
    let n = rhs.len();
    for (row, rhs) in matrix.iter_mut().zip(&mut rhs) {
        let size = largest(row);
        if size == Quad::ZERO || !size.value().is_finite() {
            return None;
        }
        row.iter_mut().for_each(|entry| *entry = *entry / size);
        *rhs = *rhs / size;
    }
    for step in 0..n {
        let size = |i: usize| matrix[i][step].abs().value();
        let pivot = (step..n).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        if size(pivot) < SINGULAR {
            return None;
        }
        matrix.swap(step, pivot);
        rhs.swap(step, pivot);
        let (above, below) = matrix.split_at_mut(step + 1);
        let (row, known) = (&above[step], rhs[step]);
        for (other, rhs) in below.iter_mut().zip(&mut rhs[step + 1..]) {
            let factor = other[step] / row[step];
            if factor == Quad::ZERO {
                continue;
            }
            for (entry, pivot) in other[step + 1..].iter_mut().zip(&row[step + 1..]) {
                *entry -= factor * *pivot;
            }
            *rhs -= factor * known;
        }
    }
    for i in (0..n).rev() {
        let known: Quad = (i + 1..n).map(|j| matrix[i][j] * rhs[j]).sum();
        rhs[i] = (rhs[i] - known) / matrix[i][i];
    }
    Some(rhs)
}

/// `true` if a symmetric matrix is positive definite: Cholesky's factor exists.
pub fn is_definite(mut matrix: Vec<Vec<Quad>>) -> bool {
    let n = matrix.len();
    for step in 0..n {
        let pivot = matrix[step][step];
        if !(pivot > Quad::ZERO) {
            return false;
        }
        let column: Vec<Quad> = matrix.iter().map(|row| row[step]).collect();
        for (i, row) in matrix.iter_mut().enumerate().skip(step + 1) {
            let factor = row[step] / pivot;
            for (entry, other) in row[step + 1..=i].iter_mut().zip(&column[step + 1..=i]) {
                *entry -= factor * *other;
            }
        }
    }
    true
}
