//! A pair whose piece of the law is frozen, with bounds on all that is computed of it: what a proof needs.
//!
//! The unknowns of a pair are the normal displacement if it is open, the tangential one if it slips or no
//! friction can act, and in space of a slip the vector `w`, which has no unit:
//!
//! ```text
//! h = w / |w|,   F_t = -g A h,   delta = unit B (1 - 1 / |w|) w,   |w| > 1           g = slope (a - F_n) + offset
//! ```
//!
//! `w` is the trial force divided by `g`, so that nothing is divided by the slip. `A` and `B` are 1 under an
//! isotropic law; with an ellipse ([`super::ellipse`]) `A = W⁻¹`, and `B = Wᵀ` of the associated rule, `W⁻¹` of
//! the collinear one. `unit`, a length, is any positive number.
//!
//! | piece | equations | inside |
//! |---|---|---|
//! | open | `F_n = a` | `v_n < 0` |
//! | closed | `v_n = 0` | `F_n < a` |
//! | stick | `delta = 0` | `gauge(F_t) < g` |
//! | slip to the side `h` in the plane | `F_t = -g h` | `h delta > 0`, `g > 0` |
//! | slip in space | `F_t = -g A h` | `\|w\| > 1`, `g > 0` |
//! | no friction | `F_t = 0` | |
//! | tie | `v = 0` | everywhere |

use super::ellipse::{inverse, product, times, transposed};
use super::{PairLaw, Plane, Rule, State};
use crate::linalg::ball::{Ball, BallVector, length, product_up, sum_of_parts, sum_up};
use crate::linalg::double_double::two_sum;
use crate::linalg::tolerances::FEW_OPERATIONS;

/// The matrix that changes no tangential vector.
const UNITY: Plane<Ball> =
    [[Ball::exact(1.0), Ball::exact(0.0)], [Ball::exact(0.0), Ball::exact(1.0)]];

/// The tangential part of an enclosed piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Along {
    Free,
    Stick,
    /// In the plane, to the side +1 or −1.
    Side(f64),
    /// In space, with the unit of the slip.
    Turning(f64),
}

/// A pair on a piece that is given.
#[derive(Clone, Copy, Debug)]
pub struct EnclosedPiece {
    law: PairLaw,
    closed: bool,
    along: Along,
}

/// The numbers of a piece at a place, or on a neighbourhood of it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Local {
    /// `A h`: `F_t = -g A h`.
    pub push: [Ball; 2],
    /// Derivative of the tangential displacement by its unknowns.
    pub motion: Plane<Ball>,
    /// Derivative of `A h`.
    pub turn: Plane<Ball>,
    /// `|w|`.
    reach: Ball,
}

impl PairLaw {
    /// The pair on the piece of `state`; of the pieces of an open pair that may carry friction, and of the
    /// sides of a slip, the one at the displacement `v` beyond the reference and the force. `None` if the law
    /// has no such piece.
    pub fn enclosed_piece(&self, state: State, v: &[f64], force: &[f64]) -> Option<EnclosedPiece> {
        if self.tied {
            let held = EnclosedPiece { law: *self, closed: true, along: Along::Stick };
            return (state == State::Stick).then_some(held);
        }
        let closed = state != State::Open;
        if closed && !self.has_obstacle() {
            return None;
        }
        let threshold = if closed { self.threshold(force[0]) } else { self.bound.at(0.0) };
        let acts = self.bound.offset > 0.0 || (closed && self.bound.slope > 0.0);
        let trial = self.at_its_reference().trial(v, force);
        let gauge = self.gauge(&trial[1..self.dim]);
        let along = match state {
            State::Stick => acts.then_some(Along::Stick)?,
            _ if !acts => Along::Free,
            State::Open if !(gauge > threshold) => Along::Stick,
            _ if self.dim == 2 => (gauge > 0.0).then_some(Along::Side(trial[1].signum()))?,
            _ => (threshold > 0.0).then_some(Along::Turning(threshold / self.k_t))?,
        };
        Some(EnclosedPiece { law: *self, closed, along })
    }

    /// `d + low - reference`, enclosed.
    pub fn enclosed_beyond_reference(&self, d: &[f64], low: &[f64]) -> BallVector {
        let reference = self.reference();
        let mut v = BallVector::default();
        for c in 0..self.dim {
            let (difference, lost) = two_sum(d[c], -reference[c]);
            v[c] = sum_of_parts(difference, lost, low[c]);
        }
        v
    }
}

impl EnclosedPiece {
    /// Returns `true` if component `c` moves: its displacement is unknown, and its force is given.
    pub fn moves(&self, c: usize) -> bool {
        if c == 0 { !self.closed } else { self.along != Along::Stick }
    }

    /// Returns `true` if the friction of the pair follows its normal force.
    pub fn is_dragged(&self) -> bool {
        let slips = matches!(self.along, Along::Side(_) | Along::Turning(_));
        self.closed && slips && self.law.bound.slope > 0.0
    }

    /// Returns `true` if the equations of the piece are symmetric where the stiffness is.
    pub fn is_symmetric(&self) -> bool {
        !self.is_dragged() && !matches!(self.along, Along::Turning(_))
    }

    /// The unit that turns displacements into tangential unknowns, for scaling: that of `w`, else 1.
    pub fn unit(&self) -> f64 {
        if let Along::Turning(unit) = self.along { unit } else { 1.0 }
    }

    /// The displacement of a component that does not move.
    pub fn held(&self, c: usize) -> f64 {
        self.law.reference()[c]
    }

    /// `w` at the displacement `v` beyond the reference; zero but for a slip in space.
    pub fn slip_vector(&self, v: &BallVector) -> [Ball; 2] {
        let Along::Turning(unit) = self.along else { return [Ball::default(); 2] };
        let [_, _, back] = self.shape();
        let unit = Ball::exact(unit);
        let own = product(&back, [v[1], v[2]]).map(|own| own / unit);
        let size = length(own);
        let reach = size + Ball::exact(1.0);
        own.map(|own| own / size * reach)
    }

    /// The piece at `w`.
    pub fn local(&self, w: [Ball; 2]) -> Local {
        match self.along {
            Along::Stick => Local::default(),
            Along::Free => Local { motion: UNITY, ..Local::default() },
            Along::Side(side) => {
                let push = [Ball::exact(side), Ball::exact(0.0)];
                Local { push, motion: UNITY, ..Local::default() }
            }
            Along::Turning(unit) => {
                let [forward, scale, _] = self.shape();
                let reach = length(w);
                let h = w.map(|w| w / reach);
                let (mut turn, mut motion) = (UNITY, UNITY);
                for i in 0..2 {
                    for j in 0..2 {
                        let across = UNITY[i][j] - h[i] * h[j];
                        turn[i][j] = across / reach;
                        // (1 - 1/|w|) + h hᵀ / |w|, without the cancellation of both.
                        motion[i][j] = UNITY[i][j] - turn[i][j];
                    }
                }
                let unit = Ball::exact(unit);
                let motion = times(&scale, &motion).map(|row| row.map(|entry| unit * entry));
                Local { push: product(&forward, h), motion, turn: times(&forward, &turn), reach }
            }
        }
    }

    /// `A`, `B` and `B⁻¹`.
    fn shape(&self) -> [Plane<Ball>; 3] {
        let Some(ellipse) = &self.law.ellipse else { return [UNITY; 3] };
        let disc = self.disc();
        let inverse = inverse(&disc);
        match ellipse.rule {
            Rule::Associated => [inverse, transposed(&disc), transposed(&inverse)],
            Rule::Collinear => [inverse, inverse, disc],
        }
    }

    /// `W`, enclosed; 1 without an ellipse.
    fn disc(&self) -> Plane<Ball> {
        let enclosed =
            |entry: f64| Ball::exact(entry).widened(product_up(FEW_OPERATIONS, entry.abs()));
        match &self.law.ellipse {
            None => UNITY,
            Some(ellipse) => {
                let columns = [ellipse.disc_of([1.0, 0.0]), ellipse.disc_of([0.0, 1.0])];
                transposed(&columns).map(|row| row.map(enclosed))
            }
        }
    }

    /// The bound `g` at the normal force.
    pub fn enclosed_threshold(&self, normal: Ball) -> Ball {
        let (slope, tension) = (Ball::exact(self.law.bound.slope), Ball::exact(self.law.tension));
        let terms = sum_up(self.law.bound.offset, (slope * tension).size());
        // The offset of a cohesive law is a difference of numbers that a host may have rounded; others are given.
        let doubt = if self.law.tension > 0.0 { product_up(FEW_OPERATIONS, terms) } else { 0.0 };
        let offset = Ball::new(self.law.bound.offset, doubt);
        if self.closed { slope * (tension - normal) + offset } else { offset }
    }

    /// The difference between the forces and those of the piece, for components that move.
    pub fn lack(&self, local: &Local, force: &BallVector) -> BallVector {
        let threshold = self.enclosed_threshold(force[0]);
        let mut lack = [force[0] - Ball::exact(self.law.tension), force[1], force[2]];
        for c in 1..self.law.dim {
            lack[c] = force[c] + threshold * local.push[c - 1];
        }
        lack
    }

    /// `-dF_t/dp` of the piece: how the friction follows the normal force.
    pub fn drag(&self, local: &Local) -> [Ball; 2] {
        if !self.is_dragged() {
            return [Ball::default(); 2];
        }
        let slope = Ball::exact(self.law.bound.slope);
        local.push.map(|push| slope * push)
    }

    /// The forces of the piece where the pair needs `force` for equilibrium: those of components that move
    /// are given by the law.
    pub fn force(&self, local: &Local, force: &BallVector) -> BallVector {
        let threshold = self.enclosed_threshold(force[0]);
        let mut given = *force;
        if self.moves(0) {
            given[0] = Ball::exact(self.law.tension);
        }
        for c in (1..self.law.dim).filter(|&c| self.moves(c)) {
            given[c] = match self.along {
                Along::Free => Ball::default(),
                _ => -(threshold * local.push[c - 1]),
            };
        }
        given
    }

    /// Returns `true` if the pair is inside its piece, clear of its boundaries, with every `v` and every force.
    pub fn is_inside(&self, local: &Local, v: &BallVector, force: &BallVector) -> bool {
        if self.law.tied {
            return true;
        }
        let pressure = Ball::exact(self.law.tension) - force[0];
        let normal = match (self.law.has_obstacle(), self.closed) {
            (false, _) => true,
            (true, true) => pressure.is_positive(),
            (true, false) => (-v[0]).is_positive(),
        };
        let threshold = self.enclosed_threshold(force[0]);
        let tangential = match self.along {
            Along::Free => true,
            Along::Stick => {
                let friction = product(&self.disc(), [force[1], force[2]]);
                let [first, second] = friction.map(Ball::size);
                let square = sum_up(product_up(first, first), product_up(second, second));
                (threshold - Ball::exact(square.sqrt().next_up())).is_positive()
            }
            Along::Side(side) => {
                threshold.is_positive() && (Ball::exact(side) * v[1]).is_positive()
            }
            Along::Turning(_) => {
                threshold.is_positive() && (local.reach - Ball::exact(1.0)).is_positive()
            }
        };
        normal && tangential
    }
}
