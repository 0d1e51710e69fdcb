//! Tangents of a pair in space along which its stiffness is the same.
//!
//! A pair has one `k_t`. Where supports nearly hold it along one tangent, its stiffnesses along both may be 1e12 apart,
//! and a displacement along the other is lost beside `k_t`. With the block `Q diag(k_1, k_2) Qᵀ` of the pair's tangents and
//! `s = (k_1 / k_2)^½` the coordinates
//!
//! ```text
//! d_t = Q diag(1, s) d_t',     F_t' = diag(1, s) Qᵀ F_t
//! ```
//!
//! have the block `k_1`. They make an ellipse with the half-axes `g` and `s g` of the disc `|F_t| <= g`, and a slip against
//! `F_t` is one along its outward normal, as `d_t' ~ -diag(1, 1 / s²) F_t'`: the associated rule.

use super::ellipse::{product, transposed};
use super::{Ellipse, PairLaw, Plane, Rule};
use crate::linalg::vector::stiffness_axes;
use crate::problem::FLATTEST;

/// Stiffnesses along both tangents that differ by less need no other coordinates. With 160 times one problem in plane strain,
/// whose third direction is held, takes 6 to 72 systems in the place of one; of 500 random problems with 30 to 1e10 times
/// none is left unsolved with this limit, and some are with 1000.
const UNLIKE: f64 = 100.0;

/// Tangents of a pair along which it is as stiff.
#[derive(Clone, Copy, Debug)]
pub struct LevelledTangents {
    /// `Q diag(1, s)`, by rows.
    basis: Plane,
    /// `s`.
    share: f64,
    /// `k_1`.
    stiffness: f64,
}

impl LevelledTangents {
    /// Those of a pair with the block of stiffness `[[a, b], [b, c]]` of its tangents; `None` where both stiffnesses are of one
    /// size, and where the pair has an ellipse of its own.
    pub fn of(law: &PairLaw, [a, b, c]: [f64; 3]) -> Option<Self> {
        if law.dim != 3 || law.ellipse.is_some() {
            return None;
        }
        let ([softer, stiffer], [x, y]) = stiffness_axes(a, b, c);
        let share = (softer / stiffer).max(0.0).sqrt().max(1.0 / FLATTEST);
        (softer > 0.0 && softer * UNLIKE < stiffer).then(|| LevelledTangents {
            basis: [[x, -y * share], [y, x * share]],
            share,
            stiffness: softer,
        })
    }

    /// `d_t` of `d_t'`.
    pub fn displacement(&self, levelled: [f64; 2]) -> [f64; 2] {
        product(&self.basis, levelled)
    }

    /// `F_t'` of `F_t`; of columns of `K` as of forces.
    pub fn force(&self, force: [f64; 2]) -> [f64; 2] {
        product(&transposed(&self.basis), force)
    }

    /// `d_t'` of `d_t`.
    pub fn levelled(&self, displacement: [f64; 2]) -> [f64; 2] {
        let [first, second] = self.force(displacement);
        [first, second / (self.share * self.share)]
    }

    /// The law of the pair in these coordinates.
    pub fn law(&self, law: &PairLaw) -> PairLaw {
        let slip0 = self.levelled(law.slip0);
        let levelled = PairLaw { slip0, k_t: self.stiffness, ..*law };
        let ellipse = Ellipse::new([1.0, self.share], 0.0, Rule::Associated);
        if law.has_friction() { levelled.with_ellipse(ellipse) } else { levelled }
    }
}
