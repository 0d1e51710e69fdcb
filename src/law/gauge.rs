//! The gauge of a tangential force, which the bound of the law limits, the friction of a slip, and the scale of slips.
//!
//! | law | gauge of `t` | friction of a slip with the trial force `y` |
//! |---|---|---|
//! | isotropic | its length | `g y / \|y\|` |
//! | with an ellipse | `\|W t\|` | that of the rule ([`super::ellipse`]) |

use super::{PairLaw, Plane, Rule, Vector, length};

impl PairLaw {
    /// The size of a tangential force that the bound limits: stick and slip meet where the gauge of the
    /// trial force is the threshold. `t` has one (2D) or two (3D) components.
    #[inline(always)]
    pub fn gauge(&self, t: &[f64]) -> f64 {
        match &self.ellipse {
            None => length(t),
            Some(ellipse) => length(&ellipse.disc_of(pair_of(t))),
        }
    }

    /// The force in the variables in which its gauge is its length.
    pub(super) fn disc_of(&self, t: [f64; 2]) -> [f64; 2] {
        self.ellipse.as_ref().map_or(t, |ellipse| ellipse.disc_of(t))
    }

    /// The gradient of the gauge at a tangential force, of which `size` is the gauge.
    pub(super) fn conormal(&self, t: [f64; 2], size: f64) -> [f64; 2] {
        let unit = self.disc_of(t).map(|t| t / size);
        self.ellipse.as_ref().map_or(unit, |ellipse| ellipse.by_disc(unit))
    }

    /// The largest work of tangential forces of gauge 1 on the motion `t`.
    pub fn dual_gauge(&self, t: &[f64]) -> f64 {
        match &self.ellipse {
            None => length(t),
            Some(ellipse) => length(&ellipse.dual_of(pair_of(t))),
        }
    }

    /// `k_n` and `k_t`, forces per length: what scales displacements, in `y = P' + k v`.
    pub fn scale(&self) -> Vector {
        [self.k_n, self.k_t, self.k_t]
    }

    /// Returns `true` if the pair has an ellipse and slips along its friction all the same.
    pub fn is_collinear(&self) -> bool {
        self.ellipse.as_ref().is_some_and(|ellipse| ellipse.rule == Rule::Collinear)
    }

    /// The friction of a slip whose trial force is `t`, under the bound `g`; `t` becomes it.
    #[inline]
    pub(super) fn bring_to_bound(&self, t: &mut [f64], g: f64) {
        match &self.ellipse {
            None => {
                let size = length(t);
                // The quotient of two forces far apart may be subnormal, with few digits.
                t.iter_mut().for_each(|t| *t = *t / size * g);
            }
            Some(ellipse) => t.copy_from_slice(&ellipse.friction(pair_of(t), g)),
        }
    }

    /// Brings a force back to the nearest one that the pair can carry under `threshold`.
    pub(super) fn bring_back(&self, t: &mut [f64], threshold: f64) {
        if self.gauge(t) > threshold {
            match &self.ellipse {
                None => self.bring_to_bound(t, threshold),
                Some(ellipse) => t.copy_from_slice(&ellipse.nearest_to(pair_of(t), threshold)),
            }
        }
    }

    /// The derivatives of [`Self::bring_to_bound`] in space: by the trial force, and by the bound at a given slip.
    pub(super) fn slopes_on_bound(&self, t: [f64; 2], g: f64) -> (Plane, [f64; 2]) {
        if let Some(ellipse) = &self.ellipse {
            return ellipse.slopes(t, g);
        }
        let size = length(&t);
        let h = t.map(|t| t / size);
        let across = [-h[1], h[0]];
        (across.map(|row| across.map(|column| g / size * row * column)), h)
    }
}

/// The two components of a vector in the tangent plane.
pub(super) fn pair_of(t: &[f64]) -> [f64; 2] {
    [t[0], t[1]]
}
