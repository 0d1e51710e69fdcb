//! Orthotropic friction: a coefficient for each of two axes of the tangent plane.

use super::Bound;

/// The bound of a pair with the coefficients `mu1` and `mu2`: on the gauge of its [`super::Ellipse`].
pub fn bound(mu: [f64; 2]) -> Bound {
    Bound { slope: mu[0].max(mu[1]), offset: 0.0 }
}
