//! Coulomb's law: `g(p) = mu p` (paper, 6 and 9).

use super::Bound;

/// The bound of a pair with the friction coefficient `mu >= 0`.
pub fn bound(mu: f64) -> Bound {
    Bound { slope: mu, offset: 0.0 }
}
