//! The friction ellipse of a law whose coefficient depends on the direction, in space.
//!
//! In the axes of the ellipse, turned by `angle` from `(t1, t2)`, its half-axes are `mu1 p` and `mu2 p`.
//! With `m` the larger of both coefficients and `R` the turn,
//!
//! ```text
//! W = diag(m / mu1, m / mu2) R,   gauge(t) = |W t|,   gauge(tau) <= m p
//! ```
//!
//! so that `W` makes a disc of the ellipse, a gauge is a force, and equal coefficients are Coulomb's law
//! with `m`. The rule says along what a pair slips:
//!
//! - associated: along the outward normal of the ellipse, `Wᵀ W tau`. In the variables `W tau` and
//!   `W⁻ᵀ delta`, whose product is the work `tau . delta`, this is Coulomb's law with `m`. Displacements
//!   are scaled by `k = k~ (Wᵀ W)⁻¹`, `k~` the largest eigenvalue of `W K_tt Wᵀ`.
//! - collinear: along the force, as if the law were isotropic. `k = k_t`.
//!
//! With either scale the friction that belongs to the trial force `y` is `y` brought back to the
//! ellipse along its own line: `W k delta` is along `W tau` by the first rule, `k delta` along `tau` by
//! the second, and both say that `k delta` is along `tau`.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::linalg::vector::largest_eigenvalue;

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

impl<T> Real for T where
    T: Copy
        + Add<Output = T>
        + Sub<Output = T>
        + Mul<Output = T>
        + Div<Output = T>
        + Neg<Output = T>
{
}

/// Along what a pair with a friction ellipse slips.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Along the outward normal of the ellipse at the force.
    Associated,
    /// Along the force.
    Collinear,
}

/// A friction ellipse with the scale of displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// `W`.
    to_disc: Plane,
    /// `k`, force per length, symmetric positive definite.
    scale: Plane,
    rule: Rule,
}

impl Ellipse {
    /// The ellipse of the coefficients `mu`, both positive, with axis 1 at `angle` (radians) from `t1`
    /// towards `t2`; `block` is the stiffness of the pair's tangential components.
    pub fn new(mu: [f64; 2], angle: f64, rule: Rule, block: &Plane) -> Self {
        let (sin, cos) = angle.sin_cos();
        let [one, two] = mu.map(|coefficient| mu[0].max(mu[1]) / coefficient);
        let to_disc = [[one * cos, one * sin], [-two * sin, two * cos]];
        let stiffest = |block: &Plane| largest_eigenvalue(block[0][0], block[1][0], block[1][1]);
        let scale = match rule {
            Rule::Associated => {
                let inverse = inverse(&form(&to_disc));
                let stiffness = stiffest(&conjugate(&to_disc, block));
                inverse.map(|row| row.map(|entry| stiffness * entry))
            }
            Rule::Collinear => [[stiffest(block), 0.0], [0.0, stiffest(block)]],
        };
        Ellipse { to_disc, scale, rule }
    }

    /// Along what the pair slips.
    pub fn rule(&self) -> Rule {
        self.rule
    }

    /// `W t`.
    pub fn to_disc(&self, t: [f64; 2]) -> [f64; 2] {
        product(&self.to_disc, t)
    }

    /// `W⁻¹ t`.
    pub fn from_disc(&self, t: [f64; 2]) -> [f64; 2] {
        product(&inverse(&self.to_disc), t)
    }

    /// `|W t|`.
    pub fn gauge(&self, t: [f64; 2]) -> f64 {
        let [a, b] = self.to_disc(t);
        a.hypot(b)
    }

    /// The largest `tau . t` of all `tau` of gauge 1: `|W⁻ᵀ t|`.
    pub fn dual_gauge(&self, t: [f64; 2]) -> f64 {
        let [a, b] = product(&transposed(&inverse(&self.to_disc)), t);
        a.hypot(b)
    }

    /// The direction of the force in the ellipse that takes most work from the slip `t`: `(Wᵀ W)⁻¹ t`.
    pub fn most_opposed(&self, t: [f64; 2]) -> [f64; 2] {
        product(&inverse(&self.form()), t)
    }

    /// `Wᵀ W`.
    pub fn form(&self) -> Plane {
        form(&self.to_disc)
    }

    /// `k`.
    pub fn scale(&self) -> &Plane {
        &self.scale
    }

    /// `k delta`.
    pub fn scaled(&self, delta: [f64; 2]) -> [f64; 2] {
        product(&self.scale, delta)
    }

    /// `k⁻¹ force`.
    pub fn unscaled(&self, force: [f64; 2]) -> [f64; 2] {
        product(&inverse(&self.scale), force)
    }
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

/// `Wᵀ W`.
fn form(w: &Plane) -> Plane {
    times(&transposed(w), w)
}

/// `W a Wᵀ`.
fn conjugate(w: &Plane, a: &Plane) -> Plane {
    times(&times(w, a), &transposed(w))
}
