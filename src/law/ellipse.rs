//! The friction ellipse of a law whose coefficient depends on the direction, in space.
//!
//! In the axes of the ellipse, turned by `angle` from `(t1, t2)` by `R`, its half-axes are `mu1 p` and `mu2 p`. With
//! `m` the larger of both coefficients and `c = (mu1, mu2) / m`,
//!
//! ```text
//! W = diag(1 / c) R,   gauge(t) = |W t|,   gauge(tau) <= g = m p
//! ```
//!
//! so that `W` makes a disc of the ellipse, a gauge is a force, and equal coefficients are Coulomb's law
//! with `m`. The rule says along what a pair slips, and with it which friction belongs to a trial force
//! `y = tau + k delta` outside of the ellipse:
//!
//! - associated: the slip is along the outward normal of the ellipse, and the friction is the point of the ellipse
//!   nearest to `y`. It moves by no more than `y` does, and by no more than the bound does (`|dtau| <= |dg|`, as
//!   `c <= 1`), however flat the ellipse is.
//! - collinear: the slip is along the force, and the friction is `y` brought back to the ellipse along its own line.
//!
//! *The nearest point.* In the axes it is `tau = g c h`, with the unit vector `h = c y / (g c² + q)` and the
//! multiplier `q` at which its length is 1. One over this length is a concave function of `q`, so that Newton's method
//! rises to the root from below, and where the larger component alone is 1 is below it and near.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::linalg::ball::Ball;

/// A matrix of the two tangential components, by rows.
pub type Plane<T = f64> = [[T; 2]; 2];

/// Doubles, and balls.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
}

impl Real for f64 {}

impl Real for Ball {}

/// Along what a pair with a friction ellipse slips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Along the outward normal of the ellipse at the force.
    Associated,
    /// Along the force.
    Collinear,
}

/// A friction ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// `R`, by rows.
    turn: Plane,
    /// `c`.
    half_axes: [f64; 2],
    /// Along what the pair slips.
    pub rule: Rule,
}

/// The point of an ellipse that is nearest to a force, in the axes.
struct Nearest {
    /// `h`.
    h: [f64; 2],
    /// `g c² + q`, a force for each axis.
    divisors: [f64; 2],
}

/// Steps to the nearest point: they double the digits from the first ones on.
const MOST_STEPS: usize = 60;

/// Part of the smaller half-axis squared that a force inside of the ellipse leaves of it: the friction of a slip is
/// asked for a little inside too, and has no nearest point in the middle.
const LEFT_INSIDE: f64 = 0.5;

impl Ellipse {
    /// The ellipse of the coefficients `mu`, both positive, with axis 1 at `angle` (radians) from `t1`
    /// towards `t2`.
    pub fn new(mu: [f64; 2], angle: f64, rule: Rule) -> Self {
        let (sin, cos) = angle.sin_cos();
        let half_axes = mu.map(|coefficient| coefficient / mu[0].max(mu[1]));
        Ellipse { turn: [[cos, sin], [-sin, cos]], half_axes, rule }
    }

    /// `diag(c) v`.
    fn times_axes(&self, v: [f64; 2]) -> [f64; 2] {
        [self.half_axes[0] * v[0], self.half_axes[1] * v[1]]
    }

    /// `diag(1 / c) v`.
    fn over_axes(&self, v: [f64; 2]) -> [f64; 2] {
        [v[0] / self.half_axes[0], v[1] / self.half_axes[1]]
    }

    /// `Rᵀ v`.
    fn turned_back(&self, v: [f64; 2]) -> [f64; 2] {
        product(&transposed(&self.turn), v)
    }

    /// The norm of `W` that its entries have together.
    pub fn norm(&self) -> f64 {
        length(self.over_axes([1.0; 2]))
    }

    /// `W t`.
    pub fn disc_of(&self, t: [f64; 2]) -> [f64; 2] {
        self.over_axes(product(&self.turn, t))
    }

    /// `Wᵀ t`.
    pub fn by_disc(&self, t: [f64; 2]) -> [f64; 2] {
        self.turned_back(self.over_axes(t))
    }

    /// `W⁻¹ t`.
    pub fn from_disc(&self, t: [f64; 2]) -> [f64; 2] {
        self.turned_back(self.times_axes(t))
    }

    /// `W⁻ᵀ t`: its length is the largest `tau . t` of all `tau` of gauge 1.
    pub fn dual_of(&self, t: [f64; 2]) -> [f64; 2] {
        self.times_axes(product(&self.turn, t))
    }

    /// The friction on the ellipse of the bound `g` that belongs to the trial force `y` of a slip.
    pub fn friction(&self, y: [f64; 2], g: f64) -> [f64; 2] {
        match self.rule {
            Rule::Associated => self.nearest_to(y, g),
            Rule::Collinear => {
                let size = length(self.disc_of(y));
                y.map(|y| y / size * g)
            }
        }
    }

    /// The force on the ellipse of the bound `g` that is nearest to `y`.
    pub fn nearest_to(&self, y: [f64; 2], g: f64) -> [f64; 2] {
        self.from_disc(self.nearest(y, g).h.map(|h| g * h))
    }

    /// The derivative of [`Self::friction`] by `y`, and that by `g` at a given slip.
    pub fn slopes(&self, y: [f64; 2], g: f64) -> (Plane, [f64; 2]) {
        match self.rule {
            Rule::Associated => {
                // Along the ellipse, g u uᵀ / (p2 h1² + p1 h2²), with the divisors p.
                let Nearest { h: [one, two], divisors: [first, second] } = self.nearest(y, g);
                let u = self.turned_back(self.times_axes([-two, one]));
                let size = g / (second * one * one + first * two * two);
                (u.map(|row| u.map(|column| size * row * column)), self.from_disc([one, two]))
            }
            Rule::Collinear => {
                let disc = self.disc_of(y);
                let size = length(disc);
                let (h, normal) = (y.map(|y| y / size), self.by_disc(disc.map(|y| y / size)));
                let entry = |i: usize, j: usize| if i == j { 1.0 } else { 0.0 } - h[i] * normal[j];
                let row = |i: usize| [g / size * entry(i, 0), g / size * entry(i, 1)];
                ([row(0), row(1)], h)
            }
        }
    }

    /// The point of the ellipse of the bound `g` that is nearest to `y`.
    fn nearest(&self, y: [f64; 2], g: f64) -> Nearest {
        let squares = self.half_axes.map(|c| g * c * c);
        let sides = self.times_axes(product(&self.turn, y));
        let alone = (sides[0].abs() - squares[0]).max(sides[1].abs() - squares[1]);
        let mut multiplier = alone.max(-LEFT_INSIDE * squares[0].min(squares[1]));
        for step in 1.. {
            let divisors = squares.map(|square| square + multiplier);
            let h = [sides[0] / divisors[0], sides[1] / divisors[1]];
            let size = length(h);
            let slope = h[0] * h[0] / divisors[0] + h[1] * h[1] / divisors[1];
            let next = multiplier + (size - 1.0) * size * size / slope;
            if !(next > multiplier) || step == MOST_STEPS {
                return Nearest { h: h.map(|h| h / size), divisors };
            }
            multiplier = next;
        }
        unreachable!("the steps are counted")
    }
}

fn length(t: [f64; 2]) -> f64 {
    t[0].hypot(t[1])
}

/// `a t`.
pub fn product<T: Real>(a: &Plane<T>, t: [T; 2]) -> [T; 2] {
    a.map(|row| row[0] * t[0] + row[1] * t[1])
}

/// `a⁻¹`.
pub fn inverse<T: Real>(a: &Plane<T>) -> Plane<T> {
    let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    [
        [a[1][1] / determinant, -a[0][1] / determinant],
        [-a[1][0] / determinant, a[0][0] / determinant],
    ]
}

/// `a b`.
pub fn times<T: Real>(a: &Plane<T>, b: &Plane<T>) -> Plane<T> {
    let columns = transposed(b).map(|column| product(a, column));
    transposed(&columns)
}

/// `aᵀ`.
pub fn transposed<T: Real>(a: &Plane<T>) -> Plane<T> {
    [[a[0][0], a[1][0]], [a[0][1], a[1][1]]]
}
