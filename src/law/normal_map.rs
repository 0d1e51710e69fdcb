//! The normal map `y -> (v, P)`: every point of the law, each from one `y`.
//!
//! ```text
//! p'  = max(y_n, 0),   p = p' - a,       k_n v_n = min(y_n, 0)
//! tau = y_t if gauge(y_t) <= g(p'), else g(p') y_t / gauge(y_t),     k delta = y_t - tau
//! ```
//!
//! and with an ellipse the friction of its rule ([`super::ellipse`]) in the place of the last one.
//!
//! `(v, P)` obeys the law if and only if it is of this form, with `y = P' + k v`, and `y` is then unique
//! (Robinson, *Normal maps induced by linear transformations*, 1992). It has no kink but where
//! pieces meet, and no singularity where a slip begins.

use super::{PairLaw, Vector};

impl PairLaw {
    /// The trial forces `y = P' + k v` of a displacement and a force; `y_n = -inf` without an obstacle.
    #[inline(always)]
    pub fn trial(&self, d: &[f64], force: &[f64]) -> Vector {
        let mut y = [0.0; 3];
        y[0] = self.k_n * (d[0] - self.gap) - (force[0] - self.tension);
        for c in 1..self.dim {
            y[c] = self.k_t * self.slip_at(d, c) - force[c];
        }
        y
    }

    /// The slip at the displacement `d` along component `c`.
    #[inline(always)]
    pub(super) fn slip_at(&self, d: &[f64], c: usize) -> f64 {
        d[c] - self.slip0[c - 1]
    }

    /// The coordinates `y = P' + k (d - reference)` of a displacement and a force on the chart that
    /// [`Self::point`] reads; of a pair without an obstacle `y_n` is `k_n d_n`.
    pub fn chart(&self, d: &[f64], force: &[f64]) -> Vector {
        let mut y = self.trial(d, force);
        if !self.has_obstacle() {
            y[0] = self.k_n * d[0];
        }
        y
    }

    /// The displacement `d` and the pressure and friction `P = -F` at the coordinates `y`; they obey the
    /// law.
    pub fn point(&self, y: &Vector) -> (Vector, Vector) {
        let push = self.push_on(self.piece(y), y);
        (self.displacement(y, &push), push)
    }
}
