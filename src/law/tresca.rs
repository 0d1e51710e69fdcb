//! Tresca's law: a given threshold `g`, whether the pair is open or closed (paper, section 2.1, inside
//! each step of Coulomb's fixed point).

use super::Bound;

/// The bound of a pair with the threshold `g >= 0`, a force.
pub fn bound(g: f64) -> Bound {
    Bound { slope: 0.0, offset: g }
}
