//! The law of a contact pair: the only room that knows what open, stick and slip are, which sign a
//! penetration has, and that a pair without an obstacle has an infinite gap.
//!
//! One file for one notion: a friction law is a [`Bound`] on the tangential force
//! ([`frictionless`], [`coulomb`], [`tresca`], [`cohesive`], [`orthotropic`]), with a tension that the pair
//! may carry and, if it is not isotropic, an [`Ellipse`]; all else is the same for every law:
//!
//! | file | what it gives | who uses it |
//! |---|---|---|
//! | `gauge` | what the bound limits, and the scale of slips | all below, Newton's method in space |
//! | `natural_map` | how far a displacement and a force are from the law | certificate |
//! | `normal_map` | `y -> (v, P)`, the chart on which the law is one function | branches, Newton's method in space |
//! | `branch` | which smooth piece of the law a point is on, with the derivative there | active-set methods, uniqueness |
//! | `planar_piece` | the boundaries between the pieces in the plane | the linear path |
//! | `proximal` | the step of one pair in a sweep | sweeps |
//! | `held` | which states can be taken for decided, and how such a pair is held | `solve::undecided` |
//! | `complementarity` | the law as complementarity of non-negative variables | Lemke's method, block pivoting |
//! | `frozen` | a pair on a piece that is given, with bounds on all that is computed of it | proofs that a solution exists |
//! | `reach` | which obstacles are too far away to matter | `solve::far_obstacles` |
//! | `contradiction` | when normal forces prove that no displacements meet all gaps | `solve::dependent` |
//! | `recession` | what a rigid motion must satisfy to prove that no equilibrium exists | certificate |
//! | `remarks` | data that are legal and look like a mistake; pairs that touch | `solve::remarks` |
//!
//! Notation, for one pair: `v = d - (gap, slip0)`, so that `v_n` is the penetration (at most 0 if the
//! law is obeyed) and `delta = v_t` the slip; `P = -F = (p, tau)`, so that `p` is the pressure, and
//! `p' = p + a`, `P' = (p', tau)` with the tension `a` that the pair may carry, 0 but for cohesion. With
//! `k = (k_n, k_t)`, forces per length that only scale,
//!
//! ```text
//! v_n <= 0,  p' >= 0,  v_n p' = 0;   |tau| <= g(p'),  delta = lambda tau, lambda >= 0, zero where |tau| < g(p')
//! y = P' + k v                                                     (Alart and Curnier's trial forces)
//! ```
//!
//! With an ellipse the length of `tau` is its gauge, `k_t` is a matrix, and `k delta` is along `tau`.

mod bound;
pub mod branch;
pub mod cohesive;
pub mod complementarity;
mod contact;
mod contradiction;
pub mod coulomb;
pub mod ellipse;
pub mod frictionless;
mod frozen;
mod gauge;
mod held;
mod natural_map;
mod normal_map;
pub mod orthotropic;
pub mod piece;
mod planar_piece;
mod proximal;
mod reach;
mod recession;
mod remarks;
pub mod tresca;

pub use bound::{Bound, length};
pub use contact::Contact;
pub use contradiction::{exceed_gaps, first_penetration, pressing, without_friction};
pub use ellipse::{Ellipse, Plane, Rule};
pub(crate) use frozen::{FrozenPair, Local};
pub use held::Held;
pub use natural_map::Violation;
pub use planar_piece::{Exit, Planar};
pub use reach::gaps_within_reach;
pub use recession::{Recession, lift};
pub use remarks::{friction_is_large, gaps_are_negative, touching};

use crate::linalg::double_double::two_sum;

/// What a contact pair does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// Apart: no force; under Tresca's law no normal force, with cohesion the tension.
    Open,
    /// In contact with the tangential force on its bound; also every contact without friction.
    Slip,
    /// In contact without slip.
    Stick,
}

/// A vector of a pair: normal and up to two tangential components.
pub type Vector = [f64; 3];

/// A matrix of a pair, by rows.
pub type Block = [Vector; 3];

/// The law of one pair with its numbers.
#[derive(Clone, Copy, Debug)]
pub struct PairLaw {
    /// Number of components, 2 or 3.
    dim: usize,
    /// `+inf`: no obstacle.
    gap: f64,
    slip0: [f64; 2],
    bound: Bound,
    /// `a`, a force, at least 0.
    tension: f64,
    /// `None`: isotropic.
    ellipse: Option<Ellipse>,
    k_n: f64,
    k_t: f64,
}

impl PairLaw {
    /// The law of a pair in dimension `dim` with its gap (`+inf`: no obstacle), its reference slip, the
    /// bound on its tangential force and the stiffnesses that scale displacements into forces.
    pub fn new(
        dim: usize,
        gap: f64,
        slip0: [f64; 2],
        bound: Bound,
        (k_n, k_t): (f64, f64),
    ) -> Self {
        PairLaw { dim, gap, slip0, bound, tension: 0.0, ellipse: None, k_n, k_t }
    }

    /// The same law with a tension `a >= 0` that the pair may carry: `p >= -a`.
    pub fn with_tension(self, tension: f64) -> Self {
        PairLaw { tension, ..self }
    }

    /// The same law, of a pair in space, with an ellipse in the place of the disc.
    pub fn with_ellipse(self, ellipse: Ellipse) -> Self {
        PairLaw { ellipse: Some(ellipse), ..self }
    }

    /// The tension that the pair may carry, a force.
    pub fn tension(&self) -> f64 {
        self.tension
    }

    /// The bound on the tangential force, or on its gauge.
    pub fn bound(&self) -> Bound {
        self.bound
    }

    /// The same law with another bound.
    pub fn with_bound(self, bound: Bound) -> Self {
        PairLaw { bound, ..self }
    }

    /// Whether there is an obstacle that the pair can touch.
    pub fn has_obstacle(&self) -> bool {
        self.gap < f64::INFINITY
    }

    /// Whether a tangential force can act on the pair at all.
    pub fn has_friction(&self) -> bool {
        self.bound.at(if self.has_obstacle() { 1.0 } else { 0.0 }) > 0.0
    }

    /// Whether friction can act and grows with the pressure, as in Coulomb's law.
    pub fn is_coupled(&self) -> bool {
        self.has_obstacle() && self.bound.slope > 0.0
    }

    /// The point `v = 0` in terms of `d`: the gap and the reference slip. Zero in the normal
    /// component of a pair without an obstacle.
    pub fn reference(&self) -> Vector {
        [if self.has_obstacle() { self.gap } else { 0.0 }, self.slip0[0], self.slip0[1]]
    }

    /// `d - reference` for displacements `d + low` in two parts, `low` what rounding to doubles has left
    /// out of `d`: nothing is lost where `d` and the reference cancel.
    pub fn beyond_reference(&self, d: &[f64], low: &[f64]) -> Vector {
        let reference = self.reference();
        let mut v = [0.0; 3];
        for c in 0..self.dim {
            let (difference, lost) = two_sum(d[c], -reference[c]);
            v[c] = difference + (lost + low[c]);
        }
        v
    }

    /// The same law for [`Self::beyond_reference`]: its gap and its reference slip are zero.
    pub fn at_its_reference(&self) -> Self {
        let gap = if self.has_obstacle() { 0.0 } else { self.gap };
        PairLaw { gap, slip0: [0.0; 2], ..*self }
    }

    /// The normal displacement nearest to `d_n` that does not penetrate.
    pub fn admissible(&self, d_n: f64) -> f64 {
        d_n.min(self.gap)
    }

    /// Bound on the tangential force at the normal force `f_n`, which may be tensile.
    pub fn threshold(&self, f_n: f64) -> f64 {
        self.bound.at((self.tension - f_n).max(0.0))
    }

    /// Whether zero displacement without a normal force is admissible: no interference, and no tension
    /// across an open gap.
    pub fn admits_zero(&self) -> bool {
        if self.tension > 0.0 { self.gap == 0.0 } else { self.gap >= 0.0 }
    }

    /// Whether a pair with the normal displacement `d_n` touches its obstacle, or penetrates it.
    pub fn touches(&self, d_n: f64) -> bool {
        d_n >= self.gap
    }

    /// Largest displacement that contact itself has prescribed to the pair at `d_n`: by a gap that has
    /// closed and by an earlier slip.
    pub fn prescribed(&self, d_n: f64) -> f64 {
        let gap = if self.touches(d_n) { self.gap.abs() } else { 0.0 };
        gap.max(self.slip0[0].abs()).max(self.slip0[1].abs())
    }
}
