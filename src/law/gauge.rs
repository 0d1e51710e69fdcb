//! The gauge of a tangential force, which the bound of the law limits, and the scale of slips.
//!
//! | law | gauge of `t` | scale `k` |
//! |---|---|---|
//! | isotropic | its length | `k_t` |
//! | with an ellipse | `\|W t\|` | that of the rule ([`super::ellipse`]) |

use super::{Ellipse, PairLaw, Plane, Rule, Vector, ellipse, length};

impl PairLaw {
    /// The size of a tangential force that the bound limits: stick and slip meet where the gauge of the
    /// trial force is the threshold. `t` has one (2D) or two (3D) components.
    #[inline(always)]
    pub fn gauge(&self, t: &[f64]) -> f64 {
        match &self.ellipse {
            None => length(t),
            Some(ellipse) => ellipse.gauge(pair_of(t)),
        }
    }

    /// `Q`, symmetric positive definite, of `gauge(t)² = t . Q t`. Of a planar pair its first entry
    /// counts.
    pub fn gauge_form(&self) -> Plane {
        self.ellipse.as_ref().map_or([[1.0, 0.0], [0.0, 1.0]], Ellipse::form)
    }

    /// The largest work of tangential forces of gauge 1 on the motion `t`.
    pub fn dual_gauge(&self, t: &[f64]) -> f64 {
        match &self.ellipse {
            None => length(t),
            Some(ellipse) => ellipse.dual_gauge(pair_of(t)),
        }
    }

    /// `k_n`, force per length: what scales the normal displacement.
    pub fn normal_scale(&self) -> f64 {
        self.k_n
    }

    /// `k`, force per length, symmetric positive definite: what scales the slip, in `y_t = tau + k delta`.
    pub fn tangential_scale(&self) -> Plane {
        match &self.ellipse {
            None => [[self.k_t, 0.0], [0.0, self.k_t]],
            Some(ellipse) => *ellipse.scale(),
        }
    }

    /// Diagonal of `k`: the units in which components of a pair are compared.
    pub fn scale(&self) -> Vector {
        let [[first, _], [_, second]] = self.tangential_scale();
        [self.k_n, first, second]
    }

    /// `k delta`.
    #[inline(always)]
    pub(super) fn scaled(&self, delta: [f64; 2]) -> [f64; 2] {
        match &self.ellipse {
            None => [self.k_t * delta[0], self.k_t * delta[1]],
            Some(ellipse) => ellipse.scaled(delta),
        }
    }

    /// `k⁻¹ force`.
    pub(super) fn unscaled(&self, force: [f64; 2]) -> [f64; 2] {
        match &self.ellipse {
            None => [force[0] / self.k_t, force[1] / self.k_t],
            Some(ellipse) => ellipse.unscaled(force),
        }
    }

    /// Returns `true` if the pair has an ellipse and slips along its friction all the same.
    pub fn is_collinear(&self) -> bool {
        self.ellipse.as_ref().is_some_and(|ellipse| ellipse.rule() == Rule::Collinear)
    }

    /// Brings a tangential force back to what the pair can carry under `threshold`, along its own line.
    pub(super) fn bring_back(&self, t: &mut [f64], threshold: f64) {
        let gauge = self.gauge(t);
        if gauge > threshold {
            // The quotient of two forces far apart may be subnormal, with few digits.
            t.iter_mut().for_each(|t| *t = *t / gauge * threshold);
        }
    }

    /// `k⁻¹ (1 - T) k` for the tangential block `T` of `dP/dy`: how a slip follows the unknown `x` of
    /// `dy_t = k x`.
    pub fn moves(&self, turned: &Plane) -> Plane {
        let mut rest = [[0.0; 2]; 2];
        for (i, row) in rest.iter_mut().enumerate() {
            for (j, rest) in row.iter_mut().enumerate() {
                *rest = if i == j { 1.0 } else { 0.0 } - turned[i][j];
            }
        }
        match &self.ellipse {
            // A multiple of 1 changes nothing.
            None => rest,
            Some(ellipse) => {
                let k = ellipse.scale();
                ellipse::times(&ellipse::inverse(k), &ellipse::times(&rest, k))
            }
        }
    }
}

impl PairLaw {
    /// `C = T (1 - T)⁻¹ k` for the tangential block `T` of `dP/dy`: how friction turns with the slip,
    /// `dtau = drag dp + C ddelta`, a force per length. Of an isotropic law it is `g / |delta|` across the slip.
    ///
    /// `T` has the eigenvalue 0 along the force and one other, its trace `q = g / |y_t|`, so that
    /// `T (1 - T)⁻¹ = T / (1 - q)`. Where a slip begins, `1 - q` is taken as the rounding of `q` at least.
    pub fn curvature(&self, turned: &Plane) -> Plane {
        let rest = (1.0 - turned[0][0] - turned[1][1]).max(f64::EPSILON);
        let across = ellipse::times(turned, &self.tangential_scale());
        across.map(|row| row.map(|entry| entry / rest))
    }
}

/// The two components of a vector in the tangent plane.
pub(super) fn pair_of(t: &[f64]) -> [f64; 2] {
    [t[0], t[1]]
}
