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
    half_axes: [f64; 2],
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
            half_axes: [1.0, share],
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
        let squares = self.half_axes.map(|axis| axis * axis);
        let [first, second] = self.force(displacement);
        [first / squares[0], second / squares[1]]
    }

    /// The law of the pair in these coordinates.
    pub fn law(&self, law: &PairLaw) -> PairLaw {
        let slip0 = self.levelled(law.slip0);
        let levelled = PairLaw { slip0, k_t: self.stiffness, ..*law };
        let ellipse = Ellipse::new(self.half_axes, 0.0, Rule::Associated);
        if law.has_friction() { levelled.with_ellipse(ellipse) } else { levelled }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Bound;
    use fastrand::Rng;

    const BOUND: Bound = Bound { slope: 0.5, offset: 0.0 };

    /// A block with these stiffnesses, its axes turned by `(c, s) = (4, 3) / 5`, so that few numbers are rounded.
    fn block([first, second]: [f64; 2]) -> [f64; 3] {
        let (c, s) = (0.8, 0.6);
        [first * c * c + second * s * s, (first - second) * c * s, first * s * s + second * c * c]
    }

    /// What the head of this file says: the block is `k_1` in both directions, a displacement comes back, and forces do the
    /// same work. Rounding of the larger stiffness, 1e4 times the smaller one at most, hides twelve digits at least.
    #[test]
    fn a_pair_is_as_stiff_along_both_tangents() {
        let rng = &mut Rng::with_seed(1);
        let law = PairLaw::new(3, 1.0, [2.0, -3.0], BOUND, (1.0, 1.0));
        for stiffnesses in [[2.0, 1024.0], [4096.0, 2.0], [3.0, 30_000.0]] {
            let [a, b, c] = block(stiffnesses);
            let levelled = LevelledTangents::of(&law, [a, b, c]).expect("they are far apart");
            let softer = stiffnesses[0].min(stiffnesses[1]);
            let force_of = |d: [f64; 2]| {
                let [x, y] = levelled.displacement(d);
                levelled.force([a * x + b * y, b * x + c * y])
            };
            for (i, unit) in [[1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
                let force = force_of(unit);
                for j in 0..2 {
                    let exact = if i == j { softer } else { 0.0 };
                    assert!((force[j] - exact).abs() <= 1e-10 * softer, "{force:?}");
                }
            }
            let [d, f] = [(); 2].map(|()| [(); 2].map(|()| rng.f64() - 0.5));
            let [own, back] = [levelled.levelled(d), levelled.displacement(levelled.levelled(d))];
            let force = levelled.force(f);
            let work = f[0] * d[0] + f[1] * d[1];
            assert!((force[0] * own[0] + force[1] * own[1] - work).abs() <= 1e-12, "{d:?}, {f:?}");
            assert!((0..2).all(|i| (back[i] - d[i]).abs() <= 1e-12), "{d:?}, {back:?}");
            // The law slips from the same place, with the softer stiffness.
            let own = levelled.law(&law);
            assert_eq!((own.slip0, own.k_t), (levelled.levelled(law.slip0), levelled.stiffness));
        }
    }

    /// Other coordinates are for pairs in space, with a disc of their own, whose stiffnesses are both positive and more than
    /// 100 times apart.
    #[test]
    fn other_coordinates_are_for_unlike_stiffnesses_alone() {
        let in_space = PairLaw::new(3, 1.0, [0.0; 2], BOUND, (1.0, 1.0));
        let ellipse = Ellipse::new([1.0, 0.5], 0.0, Rule::Associated);
        let plane = PairLaw::new(2, 1.0, [0.0; 2], BOUND, (1.0, 1.0));
        for (stiffnesses, expected) in [
            ([1.0, 1.0], false),
            ([1.0, 90.0], false),
            ([90.0, 1.0], false),
            ([1.0, 110.0], true),
            ([110.0, 1.0], true),
            ([1.0, 1e8], true),
            ([-1.0, 1e3], false),
            ([-1e3, 1.0], false),
            ([-1e3, -1.0], false),
            ([0.0, 0.0], false),
        ] {
            let block = block(stiffnesses);
            assert_eq!(
                LevelledTangents::of(&in_space, block).is_some(),
                expected,
                "{stiffnesses:?}"
            );
            for other in [plane, in_space.with_ellipse(ellipse)] {
                assert!(LevelledTangents::of(&other, block).is_none(), "{stiffnesses:?}");
            }
        }
    }
}
