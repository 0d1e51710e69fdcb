//! The smooth pieces of the normal map: which one a point is on.
//!
//! On a piece the map has the derivative `dP/dy`, a block per pair, and `k dv/dy = 1 - dP/dy`:
//!
//! | piece | `dP/dy` |
//! |---|---|
//! | open, without tangential force | 0 |
//! | closed | 1 in the normal component |
//! | stick | 1 in the tangential components |
//! | slip | `slope h` in the column of the normal component, `T = q (1 - h cᵀ)` in the tangential ones |
//!
//! with `q = g / gauge(y_t)`, `h = y_t / gauge(y_t)` and `c = Q h`, `Q` the form of the gauge: `c . h = 1`,
//! so that `T h = 0`. Of an isotropic law `h = c` is the unit vector of the slip.
//!
//! A tie is on stick everywhere. In the plane, and without friction, `T = 0`: the law is piecewise linear, and the equations of a
//! piece are exact everywhere on it.

use super::{PairLaw, Vector};

/// A piece of the normal map of one pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Piece {
    /// `true` if the pressure follows `y_n`, and not the displacement.
    pub closed: bool,
    /// The tangential part.
    pub tangential: Tangential,
}

/// The tangential part of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Tangential {
    /// No tangential force can act.
    Free,
    /// No slip.
    Stick,
    /// The tangential force is on its bound.
    Slip {
        /// In the plane the sign of the trial force, +1 or −1; in space, where the direction changes along the
        /// piece, 0.
        side: i8,
    },
}

/// A boundary of a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Boundary {
    /// Between open and closed.
    Contact,
    /// Between stick and slip.
    Slip,
}

impl Piece {
    /// Open, without tangential force.
    pub const OPEN: Piece = Piece { closed: false, tangential: Tangential::Free };

    /// Returns `true` if a force may act on the pair.
    pub fn carries_force(self) -> bool {
        self != Piece::OPEN
    }

    /// Returns `true` if the slip is not held: the tangential force is on its bound, which may be zero.
    #[inline(always)]
    pub fn slips(self) -> bool {
        self.tangential != Tangential::Stick
    }
}

impl PairLaw {
    /// The piece of the normal map at the coordinates `y` of the chart.
    pub fn piece(&self, y: &Vector) -> Piece {
        if self.tied {
            return self.stick();
        }
        let closed = self.has_obstacle() && y[0] > 0.0;
        let threshold = self.bound.at(if closed { y[0] } else { 0.0 });
        let tangential = if threshold == 0.0 {
            Tangential::Free
        } else if self.gauge(&y[1..self.dim]) > threshold {
            self.slip_along(y[1])
        } else {
            Tangential::Stick
        };
        Piece { closed, tangential }
    }

    /// Slip of a pair whose first tangential coordinate has this sign.
    pub(super) fn slip_along(&self, y_t: f64) -> Tangential {
        let side = match self.dim {
            2 if y_t < 0.0 => -1,
            2 => 1,
            _ => 0,
        };
        Tangential::Slip { side }
    }

    /// Closed if there is an obstacle, and sticking if there is friction.
    pub fn stick(&self) -> Piece {
        let sticks = self.has_friction() || self.tied;
        let tangential = if sticks { Tangential::Stick } else { Tangential::Free };
        Piece { closed: self.has_obstacle(), tangential }
    }

    /// Slip to a side, +1 or −1, of a pair in the plane that is closed if there is an obstacle; without friction
    /// free.
    pub fn slip(&self, side: i8) -> Piece {
        let slip = Tangential::Slip { side };
        let tangential = if self.has_friction() { slip } else { Tangential::Free };
        Piece { closed: self.has_obstacle(), tangential }
    }

    /// The pieces in the plane of a pair that is free when it is open.
    pub fn planar_pieces(&self) -> [Piece; 4] {
        [Piece::OPEN, self.stick(), self.slip(-1), self.slip(1)]
    }

    /// The piece across a boundary of a pair in space.
    pub fn across(&self, piece: Piece, boundary: Boundary) -> Piece {
        let Piece { closed, tangential } = piece;
        let closed = closed != (boundary == Boundary::Contact);
        let acts = self.bound.at(if closed { 1.0 } else { 0.0 }) > 0.0;
        let slips = piece.slips() != (boundary == Boundary::Slip);
        let tangential = match tangential {
            _ if slips && !acts => Tangential::Free,
            _ if slips => Tangential::Slip { side: 0 },
            _ => Tangential::Stick,
        };
        Piece { closed, tangential }
    }

    /// Distance of the trial forces `y` from where pieces meet, a force.
    pub fn distance_to_kink(&self, y: &Vector) -> f64 {
        if self.tied {
            return f64::INFINITY;
        }
        let threshold = self.bound.at(y[0].max(0.0));
        let normal = y[0].abs();
        if threshold == 0.0 {
            return normal;
        }
        normal.min((self.gauge(&y[1..self.dim]) - threshold).abs())
    }
}
