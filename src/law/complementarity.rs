//! The law as complementarity of non-negative variables, in the plane and without friction.
//!
//! With the clearance `w = gap - d_n` and the slip `delta = a - b` (`a, b >= 0`):
//!
//! ```text
//! p'              >= 0,  w >= 0,  p' w = 0
//! g(p') - tau     >= 0,  a >= 0,  (g(p') - tau) a = 0
//! g(p') + tau     >= 0,  b >= 0,  (g(p') + tau) b = 0
//! ```
//!
//! with the pressure `p'` beside the tension that the pair may carry: that of equilibrium under
//! [`Contact::load_with_tension`]. A pair without an obstacle has no `w`, and one that has no friction either no `a` and
//! `b`. Without friction only the first line is left. In `x = -d_n` it is an LCP
//! with the lower bound `-gap`, and `w`, the variable that the bound is complementary to, is `p'`.

use super::{Contact, PairLaw, Piece, Tangential};
use crate::problem::Relation;

impl PairLaw {
    /// The piece on which the values of the pair's variables are; those that it has not are 0.
    pub fn piece_of_variables(&self, w: f64, a: f64, b: f64) -> Piece {
        let closed = self.has_obstacle() && w == 0.0;
        let acts = self.bound.at(if closed { 1.0 } else { 0.0 }) > 0.0;
        let slip = |side| Tangential::Slip { side };
        let tangential = match (a, b) {
            _ if !acts => Tangential::Free,
            (a, b) if a > b => slip(1),
            (a, b) if a < b => slip(-1),
            _ => Tangential::Stick,
        };
        Piece { closed, tangential }
    }
}

/// Lower bounds of `x = -d` without friction: `-gap` of normal components, `-inf` of components that
/// carry no contact force.
pub fn lower_bounds<R: Relation>(contact: &Contact<'_, R>) -> Vec<f64> {
    let dim = contact.dim();
    let mut lower = vec![f64::NEG_INFINITY; contact.unknowns()];
    for (law, lower) in contact.pairs().iter().zip(lower.iter_mut().step_by(dim)) {
        *lower = -law.gap;
    }
    lower
}
