//! The smooth pieces of the law: which one a point is on, and the derivative there.
//!
//! On a branch the normal map has the derivative `dP/dy`, a block per pair, and `k dv/dy = 1 - dP/dy`:
//!
//! | branch | `dP/dy` |
//! |---|---|
//! | open, without tangential force | 0 |
//! | closed | 1 in the normal component |
//! | stick | 1 in the tangential components |
//! | slip along `h` | `slope h` in the column of the normal component, `q (1 - h hᵀ)` in the tangential ones, `q = g / |y_t|` |
//!
//! In the plane, and without friction, `q (1 - h hᵀ) = 0`: the law is piecewise linear, and the
//! equations of a branch are exact everywhere on it ([`Branch::rows`]).

use super::{Block, Bound, PairLaw, Vector, length};

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
        /// Unit vector of the slip: +1 or −1 in the plane.
        direction: [f64; 2],
        /// How much the force turns with the trial force, `g / |y_t|`; 0 in the plane.
        turning: f64,
    },
}

/// The equation of one component on a branch of a piecewise linear law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Row {
    /// The displacement has this value.
    Fixed(f64),
    /// `F_i + coupling F_n + offset = 0`, with the normal component `n` of its pair.
    Free {
        /// Coefficient of `F_n`.
        coupling: f64,
        /// A force.
        offset: f64,
    },
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

    /// `dP/dy`.
    pub fn derivative(&self, bound: Bound) -> Block {
        let mut block = [[0.0; 3]; 3];
        let normal = if self.closed { 1.0 } else { 0.0 };
        block[0][0] = normal;
        match self.tangential {
            Tangential::Free => {}
            Tangential::Stick => (block[1][1], block[2][2]) = (1.0, 1.0),
            Tangential::Slip { direction: h, turning } => {
                for c in 0..2 {
                    block[1 + c][0] = bound.slope * h[c] * normal;
                    for other in 0..2 {
                        let unit = if c == other { 1.0 } else { 0.0 };
                        block[1 + c][1 + other] = turning * (unit - h[c] * h[other]);
                    }
                }
            }
        }
        block
    }

    /// The equation of each component on this branch of the piecewise linear `law`: where `dP/dy` is 1
    /// the displacement is fixed at its reference, elsewhere the force is.
    #[inline]
    pub fn rows(&self, law: &PairLaw) -> [Row; 3] {
        let block = self.derivative(law.bound);
        let reference = law.reference();
        let offset = match self.tangential {
            Tangential::Slip { direction: h, .. } => {
                [0.0, law.bound.offset * h[0], law.bound.offset * h[1]]
            }
            _ => [0.0; 3],
        };
        let row = |i: usize| match block[i][i] {
            1.0 => Row::Fixed(reference[i]),
            // P = -F, so that tau = slope h p + offset h is the equation of F below.
            _ => Row::Free { coupling: if i == 0 { 0.0 } else { -block[i][0] }, offset: offset[i] },
        };
        [row(0), row(1), row(2)]
    }
}

impl PairLaw {
    /// Closed if there is an obstacle, and sticking if there is friction.
    pub fn stick(&self) -> Branch {
        let tangential = if self.has_friction() { Tangential::Stick } else { Tangential::Free };
        Branch { closed: self.has_obstacle(), tangential }
    }

    /// Slip along `direction` of a pair that is closed if there is an obstacle; without friction free.
    pub fn slip(&self, direction: [f64; 2]) -> Branch {
        let slip = Tangential::Slip { direction, turning: 0.0 };
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
        normal.min((length(&y[1..self.dim]) - threshold).abs())
    }
}
