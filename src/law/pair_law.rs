//! The law of one pair with its numbers.

use super::{Bound, Ellipse};
use crate::linalg::ball::Ball;
use crate::linalg::tolerances::ROUNDING;

/// A vector of a pair: normal and up to two tangential components.
pub type Vector = [f64; 3];

/// The vectors of pairs of `dim` components from a vector of all components.
pub fn by_pairs<T: Copy + Default>(dim: usize, values: &[T]) -> Vec<[T; 3]> {
    let of_pair = |own: &[T]| std::array::from_fn(|c| own.get(c).copied().unwrap_or_default());
    values.chunks_exact(dim).map(of_pair).collect()
}

/// The law of one pair with its numbers.
#[derive(Clone, Copy, Debug)]
pub struct PairLaw {
    /// Number of components, 2 or 3.
    pub(super) dim: usize,
    /// `+inf`: no obstacle.
    pub(super) gap: f64,
    pub(super) slip0: [f64; 2],
    /// The bound on the tangential force, or on its gauge.
    pub(crate) bound: Bound,
    /// `a`, the tension that the pair may carry, a force, at least 0.
    pub(super) tension: f64,
    /// `None`: isotropic.
    pub(super) ellipse: Option<Ellipse>,
    /// `v = 0` whatever the force: no piece but stick, and no bound.
    pub(crate) tied: bool,
    pub(super) k_n: f64,
    pub(super) k_t: f64,
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
        PairLaw { dim, gap, slip0, bound, tension: 0.0, ellipse: None, tied: false, k_n, k_t }
    }

    /// Gives the pair a tension `a >= 0` that it may carry: `p >= -a`.
    pub fn with_tension(self, tension: f64) -> Self {
        PairLaw { tension, ..self }
    }

    /// Gives a pair in space an ellipse in the place of the disc.
    pub fn with_ellipse(self, ellipse: Ellipse) -> Self {
        PairLaw { ellipse: Some(ellipse), ..self }
    }

    /// Ties the pair to its reference, if there is an obstacle.
    pub fn with_tie(self) -> Self {
        PairLaw { tied: self.has_obstacle(), ..self }
    }

    /// Gives the pair another bound.
    pub fn with_bound(self, bound: Bound) -> Self {
        PairLaw { bound, ..self }
    }

    /// Returns `true` if there is an obstacle that the pair can touch.
    pub fn has_obstacle(&self) -> bool {
        self.gap < f64::INFINITY
    }

    /// Returns `true` if a tangential force can act on the pair at all.
    pub fn has_friction(&self) -> bool {
        self.bound.at(if self.has_obstacle() { 1.0 } else { 0.0 }) > 0.0
    }

    /// Returns `true` if friction can act and grows with the pressure, as in Coulomb's law.
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
        self.enclosed_beyond_reference(d, low).map(Ball::middle)
    }

    /// Copies the law for [`Self::beyond_reference`]: its gap and its reference slip are zero.
    pub fn at_its_reference(&self) -> Self {
        let gap = if self.has_obstacle() { 0.0 } else { self.gap };
        PairLaw { gap, slip0: [0.0; 2], ..*self }
    }

    /// The normal displacement nearest to `d_n` that does not penetrate, and of a tie does not open.
    pub fn admissible(&self, d_n: f64) -> f64 {
        if self.tied { self.gap } else { d_n.min(self.gap) }
    }

    /// Bound on the tangential force at the normal force `f_n`, which may be tensile.
    pub fn threshold(&self, f_n: f64) -> f64 {
        self.bound.at((self.tension - f_n).max(0.0))
    }

    /// Returns `true` if zero displacement without a normal force is admissible: no interference, and no tension or
    /// tie across an open gap.
    pub fn admits_zero(&self) -> bool {
        if self.tension > 0.0 || self.tied { self.gap == 0.0 } else { self.gap >= 0.0 }
    }

    /// Returns `true` if a pair with the normal displacement `d_n` touches its obstacle, penetrates it, or is tied.
    pub fn touches(&self, d_n: f64) -> bool {
        self.tied || d_n >= self.gap
    }

    /// Largest displacement that contact itself has prescribed to the pair at `d_n`: by a gap that has
    /// closed but for rounding, and by an earlier slip.
    pub fn prescribed(&self, d_n: f64) -> f64 {
        let size = if self.has_obstacle() { self.gap.abs() } else { 0.0 };
        let gap = if self.touches(d_n + ROUNDING * size) { size } else { 0.0 };
        gap.max(self.slip0[0].abs()).max(self.slip0[1].abs())
    }
}
