//! No friction: `g = 0`.

use super::Bound;

/// The bound of a pair without friction.
pub fn bound() -> Bound {
    Bound { slope: 0.0, offset: 0.0 }
}
