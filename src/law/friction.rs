//! The friction laws as numbers of a pair: of each its bound, its tension and its ellipse.
//!
//! The cohesive law, `p >= -a`, `|F_t| <= mu p + b`, is with `p' = p + a` the law `p' >= 0`,
//! `|F_t| <= mu p' + (b - mu a)`: a bound with a slope and an offset, and a shift of the normal force. It has no
//! memory: an open pair carries the tension `a` and the friction `b - mu a`, however far it is open.
//!
//! A tie has no bound: its force is whatever holds the pair at its reference. Of the pieces of the law it has stick alone.

use super::{Bound, Ellipse, PairLaw, Rule};
use crate::problem::Law;

impl Bound {
    /// No friction.
    pub const FRICTIONLESS: Bound = Bound { slope: 0.0, offset: 0.0 };

    /// Coulomb's law with the coefficient `mu >= 0` (paper, 6 and 9).
    pub fn coulomb(mu: f64) -> Bound {
        Bound { slope: mu, offset: 0.0 }
    }

    /// Tresca's law with the threshold `g >= 0`, a force, whether the pair is open or closed (paper, section
    /// 2.1, inside each step of Coulomb's fixed point).
    pub fn tresca(g: f64) -> Bound {
        Bound { slope: 0.0, offset: g }
    }

    /// Coulomb's law with the cohesion `b >= mu a` and the tension `a >= 0`, both forces.
    pub fn cohesive(mu: f64, b: f64, a: f64) -> Bound {
        // Rounded once: it is zero only if `b = mu a`, or where rounding has left `b` below that.
        Bound { slope: mu, offset: (-mu).mul_add(a, b).max(0.0) }
    }

    /// The law with a coefficient for each of two axes of the tangent plane, on the gauge of its [`Ellipse`].
    pub fn orthotropic([first, second]: [f64; 2]) -> Bound {
        Bound { slope: first.max(second), offset: 0.0 }
    }
}

impl PairLaw {
    /// Gives the pair its friction law with its parameters.
    pub(super) fn with_friction(self, (law, numbers): (Law, &[f64])) -> Self {
        let elliptic = |rule| {
            let (mu, angle) = ([numbers[0], numbers[1]], numbers[2]);
            let ellipse = Ellipse::new(mu, angle, rule);
            self.with_bound(Bound::orthotropic(mu)).with_ellipse(ellipse)
        };
        match law {
            Law::Frictionless | Law::ByPair => self.with_bound(Bound::FRICTIONLESS),
            Law::Coulomb => self.with_bound(Bound::coulomb(numbers[0])),
            Law::Tresca => self.with_bound(Bound::tresca(numbers[0])),
            Law::Cohesive => {
                let (mu, b, a) = (numbers[0], numbers[1], numbers[2]);
                self.with_bound(Bound::cohesive(mu, b, a)).with_tension(a)
            }
            Law::Orthotropic => elliptic(Rule::Associated),
            Law::OrthotropicCollinear => elliptic(Rule::Collinear),
            Law::Tied => self.with_bound(Bound::FRICTIONLESS).with_tie(),
        }
    }
}
