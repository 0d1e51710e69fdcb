//! Coulomb's law with cohesion and a tension cut-off: `p >= -a`, `|F_t| <= mu p + b`.
//!
//! With `p' = p + a` it is `p' >= 0`, `|F_t| <= mu p' + (b - mu a)`: a bound with a slope and an offset,
//! and a shift of the normal force. The law has no memory: an open pair carries the tension `a` and the
//! friction `b - mu a`, however far it is open.

use super::Bound;

/// The bound of a pair with the friction coefficient `mu >= 0`, the cohesion `b >= mu a` and the
/// tension `a >= 0`, both forces.
pub fn bound(mu: f64, b: f64, a: f64) -> Bound {
    // Not below 0 where `b = mu a` up to rounding.
    Bound { slope: mu, offset: (b - mu * a).max(0.0) }
}
