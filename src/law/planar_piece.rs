//! The pieces of the normal map in the plane, and the boundaries between them: what a path through
//! pieces needs.
//!
//! On a piece `P = D y + c` with its derivative `D` and `c = offset h` in the
//! tangential component of a slip, less the tension in the normal one, and `k v = y - D y - c_t`. Boundaries, inside positive:
//!
//! | piece | boundary | beyond it |
//! |---|---|---|
//! | open | `-y_n` | closed: slip to the side of `y_t`, if friction grows with the pressure only |
//! | closed | `y_n` | open |
//! | stick | `g(p) - h y_t`, `h = ±1` | slip to the side `h` |
//! | slip to the side `h` | `h y_t - g(p)` | stick |
//!
//! Where the bound has no offset a pair that sticks slips before it opens, because `g(p)` falls to zero
//! with the pressure. The derivative changes by a matrix of rank one, along the boundary's gradient.

use super::{PairLaw, Piece, Tangential};

/// Normal and tangential coordinate of a pair.
pub type Planar = [f64; 2];

/// Where a straight way leaves a piece.
#[derive(Clone, Copy, Debug)]
pub struct PieceExit {
    /// How far along the way; 0 if rounding has put the point beyond already.
    pub step: f64,
    /// The piece beyond.
    pub beyond: Piece,
}

/// Part of the slip of an open pair that may be kept, of what the clearance allows
/// ([`PairLaw::sure_start`]).
const KEPT_SLIP: f64 = 0.98;

/// Clearance of a pair that is opened, of what its slip demands: more than `1 / KEPT_SLIP`.
const OPENED: f64 = 1.05;

/// Part of the friction of a closed pair that is kept: enough to tell the pairs apart.
const KEPT_FRICTION: f64 = 1e-7;

impl PairLaw {
    /// Where the way `y + step rate`, `step >= 0`, leaves `piece` first.
    pub fn planar_exit(&self, piece: Piece, y: Planar, rate: Planar) -> Option<PieceExit> {
        let mut first: Option<PieceExit> = None;
        let mut look = |gradient: Planar, constant: f64, beyond: Piece| {
            let inside = gradient[0] * y[0] + gradient[1] * y[1] + constant;
            let change = gradient[0] * rate[0] + gradient[1] * rate[1];
            if change < 0.0 {
                let step = inside.max(0.0) / -change;
                if first.is_none_or(|first| step < first.step) {
                    first = Some(PieceExit { step, beyond });
                }
            }
        };
        let normal = if piece.closed { 1.0 } else { 0.0 };
        let (slope, offset) = (self.bound.slope * normal, self.bound.offset);
        let slips = |side| Tangential::Slip { side };
        match piece.tangential {
            Tangential::Free => {}
            Tangential::Stick => {
                for side in [1, -1] {
                    let beyond = Piece { tangential: slips(side), ..piece };
                    look([slope, -f64::from(side)], offset, beyond);
                }
            }
            Tangential::Slip { side } => {
                let stick = Piece { tangential: Tangential::Stick, ..piece };
                look([-slope, f64::from(side)], -offset, stick);
            }
        }
        let grips = self.bound.is_cone() && self.bound.slope > 0.0;
        let sticks = grips && piece.tangential == Tangential::Stick;
        if self.has_obstacle() && !sticks {
            let sign = if piece.closed { 1.0 } else { -1.0 };
            let tangential = match piece.tangential {
                _ if !grips => piece.tangential,
                _ if piece.closed => Tangential::Free,
                _ => {
                    // Where it closes, at y_n = 0.
                    let step = -y[0] / rate[0];
                    self.slip_along(y[1] + step * rate[1])
                }
            };
            look([sign, 0.0], 0.0, Piece { closed: !piece.closed, tangential });
        }
        first
    }

    /// The push that `piece` has at `y = 0`.
    pub fn constant(&self, piece: Piece) -> Planar {
        match piece.tangential {
            Tangential::Slip { side } => [-self.tension, f64::from(side) * self.bound.offset],
            _ => [-self.tension, 0.0],
        }
    }

    /// Coordinates near `y` that no other coordinates share their `K v + P` with, whatever the
    /// positive definite `K` (theorem H of the linear path): a closed pair sticks with the friction of
    /// zero pressure at most, and an open one has slipped less than its clearance divided by the
    /// slope.
    pub fn sure_start(&self, y: Planar) -> Planar {
        if self.bound.slope == 0.0 || !self.has_obstacle() {
            return y;
        }
        let bound = self.bound.at(0.0);
        if y[0] > 0.0 {
            let most = bound + KEPT_FRICTION * self.bound.slope * y[0];
            return [y[0], y[1].max(-most).min(most)];
        }
        let clearance = -y[0] / self.k_n;
        let most = bound + KEPT_SLIP * self.k_t * clearance / self.bound.slope;
        [y[0], y[1].max(-most).min(most)]
    }

    /// The pair open, as far as theorem H demands it for the given slip, and by `least` at least.
    fn opened(&self, y: Planar, slip: f64, least: f64) -> Planar {
        let clearance = OPENED * self.bound.slope * slip.abs();
        let normal = -(self.k_n * clearance).max(-y[0]).max(least);
        let bound = self.bound.at(0.0);
        let tangential = if slip == 0.0 {
            y[1].max(-bound).min(bound)
        } else {
            self.k_t * slip + bound.copysign(slip)
        };
        self.sure_start([normal, tangential])
    }

    /// Coordinates from which a path goes on at the displacements `d` with their `force`, where the pair was held
    /// open, or stuck. Coordinates that the law does not allow are replaced: a pair that penetrates is opened as far
    /// as its slip demands, and one that sticks in tension, or with too much friction, sticks
    /// with forces that the law allows. `J` keeps its sign in both. Forces of the size `least` are rounding.
    pub fn released(&self, d: &[f64], force: &[f64], least: f64) -> Planar {
        let y = self.chart(d, force);
        let (y, reference) = ([y[0], y[1]], self.reference());
        if !self.has_obstacle() {
            return y;
        }
        let slip = d[1] - reference[1];
        let inside = self.k_n * (d[0] - reference[0]);
        if inside > least {
            return self.opened(y, slip, least);
        }
        let sticks = inside.abs() <= least && self.k_t * slip.abs() <= least;
        if sticks && (y[0] <= 0.0 || y[1].abs() > self.bound.at(y[0])) {
            let pressure = y[0].max(least);
            let most = KEPT_SLIP * self.bound.at(pressure);
            return [pressure, y[1].max(-most).min(most)];
        }
        y
    }

    /// The pair pressed on its obstacle with the force `p > 0`, and stuck.
    pub fn pressed(&self, y: Planar, p: f64) -> Planar {
        if self.has_obstacle() { self.sure_start([p, y[1]]) } else { y }
    }
}
