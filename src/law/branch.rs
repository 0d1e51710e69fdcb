//! The smooth pieces of the law: which one a point is on, and the derivative there.
//!
//! On a branch the normal map has the derivative `dP/dy`, a block per pair, and `k dv/dy = 1 - dP/dy`:
//!
//! | branch | `dP/dy` |
//! |---|---|
//! | open, without tangential force | 0 |
//! | closed | 1 in the normal component |
//! | stick | 1 in the tangential components |
//! | slip | `slope h` in the column of the normal component, `T = q (1 - h cᵀ)` in the tangential ones |
//!
//! with `q = g / gauge(y_t)`, `h = y_t / gauge(y_t)` and `c = Q h`, `Q` the form of the gauge: `c . h = 1`,
//! so that `T h = 0`. Of an isotropic law `h = c` is the unit vector of the slip.
//!
//! In the plane, and without friction, `T = 0`: the law is piecewise linear, and the equations of a
//! branch are exact everywhere on it ([`Branch::rows`]).

use super::{Block, PairLaw, Vector};

/// A branch of the law of one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Whether the pair is in contact.
    pub closed: bool,
    /// What it does tangentially.
    pub tangential: Tangential,
}

/// What a pair does tangentially.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tangential {
    /// No tangential force can act.
    Free,
    /// No slip.
    Stick,
    /// Slip along a direction.
    Slip {
        /// Direction of the friction that `tau` balances, of gauge 1: +1 or −1 in the plane, the unit
        /// vector of the slip under an isotropic law.
        direction: [f64; 2],
    },
}

/// The equation of one component on a branch of a piecewise linear law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Row {
    /// The displacement has this value.
    Fixed(f64),
    /// `F_i + coupling F_n + offset = 0`, with the normal component `n` of its pair.
    Free {
        /// Coefficient of `F_n`; 0 in the equation of `F_n` itself.
        coupling: f64,
        /// A force.
        offset: f64,
    },
}

impl Row {
    /// No force.
    const FREE: Row = Row::Free { coupling: 0.0, offset: 0.0 };
}

impl Branch {
    /// Open, without tangential force.
    pub const OPEN: Branch = Branch { closed: false, tangential: Tangential::Free };

    /// What a pair does next that was on this branch: `next`, but if its slip would turn back, it
    /// sticks first. From one slip to the other it passes stick.
    pub fn without_reversal(&self, law: &PairLaw, next: Branch) -> Branch {
        match (self.tangential, next.tangential) {
            (Tangential::Slip { direction: before, .. }, Tangential::Slip { direction: h, .. })
                if next.closed && before[0] * h[0] + before[1] * h[1] < 0.0 =>
            {
                law.stick()
            }
            _ => next,
        }
    }

    /// The equation of each component on this branch of the piecewise linear `law`: where `dP/dy` is 1
    /// the displacement is fixed at its reference, elsewhere the force is.
    #[inline]
    pub fn rows(&self, law: &PairLaw) -> [Row; 3] {
        let reference = law.reference();
        let normal = match self.closed {
            true => Row::Fixed(reference[0]),
            false => Row::Free { coupling: 0.0, offset: -law.tension },
        };
        // P' = (a - F_n, -F_t), so that tau = slope h p' + offset h is the equation of F below.
        let slope = if self.closed { law.bound.slope } else { 0.0 };
        let offset = slope * law.tension + law.bound.offset;
        let tangential = |c: usize| match self.tangential {
            Tangential::Free => Row::FREE,
            Tangential::Stick => Row::Fixed(reference[c]),
            Tangential::Slip { direction: h } => {
                Row::Free { coupling: -slope * h[c - 1], offset: offset * h[c - 1] }
            }
        };
        [normal, tangential(1), tangential(2)]
    }
}

impl PairLaw {
    /// `dP/dy` at the coordinates `y` of the chart.
    pub fn derivative(&self, y: &Vector) -> Block {
        self.derivative_on(self.piece(y), y)
    }

    /// Closed if there is an obstacle, and sticking if there is friction.
    pub fn stick(&self) -> Branch {
        let tangential = if self.has_friction() { Tangential::Stick } else { Tangential::Free };
        Branch { closed: self.has_obstacle(), tangential }
    }

    /// Slip along `direction` of a pair that is closed if there is an obstacle; without friction free.
    pub fn slip(&self, direction: [f64; 2]) -> Branch {
        let slip = Tangential::Slip { direction };
        let tangential = if self.has_friction() { slip } else { Tangential::Free };
        Branch { closed: self.has_obstacle(), tangential }
    }

    /// All branches in the plane.
    pub fn planar_branches(&self) -> [Branch; 4] {
        [Branch::OPEN, self.stick(), self.slip([-1.0, 0.0]), self.slip([1.0, 0.0])]
    }

    /// Distance of the trial forces `y` from where branches meet, a force.
    pub fn distance_to_kink(&self, y: &Vector) -> f64 {
        let threshold = self.bound.at(y[0].max(0.0));
        let normal = y[0].abs();
        if threshold == 0.0 {
            return normal;
        }
        normal.min((self.gauge(&y[1..self.dim]) - threshold).abs())
    }
}
