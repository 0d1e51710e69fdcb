//! The normal map on a piece that is given, not read off the point.
//!
//! On a piece the map is analytic, and its formulas hold beyond the piece's boundaries too. A method
//! that follows a curve through the pieces one by one ([`crate::solve`]'s path) keeps the pieces of all
//! pairs as a state of its own, and crosses one boundary at a time:
//!
//! | boundary | function of `y` | on one side | on the other |
//! |---|---|---|---|
//! | contact | `y_n` | open: not positive | closed: positive |
//! | slip | `gauge(y_t) - g(p')` | stick: not positive | slip: positive |
//!
//! An open pair whose bound is a cone has no boundary of slip: its tangential force is zero.

use super::{Boundary, Linearised, PairLaw, Piece, Tangential, Vector};

/// Part of its bound that the friction of a pair has that has just been made to stick.
const INSIDE: f64 = 0.999;

impl PairLaw {
    /// Returns `true` if a pair that is open carries no force at all. A tie does not open.
    pub fn is_free_when_open(&self) -> bool {
        self.bound.is_cone() && self.tension == 0.0 && !self.tied
    }

    /// The piece, if its pair can be held on it while others are in question: open without a force, or sticking at its
    /// reference ([`Self::reference`]). `None`: it slips, or carries a force when it is open.
    pub fn decided(&self, piece: Piece) -> Option<Piece> {
        let sticks = piece.tangential == Tangential::Stick;
        Some(piece).filter(|_| if piece.closed { sticks } else { self.is_free_when_open() })
    }

    /// The coordinates `y`, or, where the pair slips there against the direction in which it slipped at
    /// `before`, coordinates next to them at which it sticks: a slip that reverses passes through stick, and a
    /// method that leaves stick out may go to and fro for ever.
    pub fn without_reversal(&self, before: &Vector, y: Vector) -> Vector {
        let (was, is) = (self.piece(before), self.piece(&y));
        let along: f64 = (1..self.dim).map(|c| before[c] * y[c]).sum();
        let threshold = self.bound.at(y[0]);
        if !(was.slips() && is.slips() && was.closed && is.closed)
            || along >= 0.0
            || threshold == 0.0
        {
            return y;
        }
        let keep = INSIDE * threshold / self.gauge(&y[1..self.dim]);
        [y[0], keep * y[1], keep * y[2]]
    }

    /// Coordinates inside a piece of the plane, of the size of a force.
    pub fn inside(&self, piece: Piece, size: f64) -> Vector {
        let normal = if piece.closed { size } else { -size };
        let beyond = self.bound.at(if piece.closed { size } else { 0.0 }) + size;
        match piece.tangential {
            Tangential::Slip { side } => [normal, f64::from(side) * beyond, 0.0],
            _ => [normal, 0.0, 0.0],
        }
    }

    /// The pressure `p'` on a piece, and the bound on the tangential force that belongs to it.
    fn pressure_on(&self, piece: Piece, y: &Vector) -> (f64, f64) {
        let pressure = if piece.closed { y[0] } else { 0.0 };
        (pressure, self.bound.at(pressure))
    }

    /// `P` on a piece at `y`.
    #[inline]
    pub fn push_on(&self, piece: Piece, y: &Vector) -> Vector {
        let (pressure, threshold) = self.pressure_on(piece, y);
        let mut push = [pressure - self.tension, y[1], y[2]];
        match piece.slips() {
            true if threshold == 0.0 => push[1..].fill(0.0),
            true => self.bring_to_bound(&mut push[1..self.dim], threshold),
            false => {}
        }
        push
    }

    /// `k (v - v')` at the displacement `d` with `force` beyond its coordinates `y`, `v'` that of the point
    /// of the piece at `y`: how far they are from the piece, a force.
    pub fn distance_to_piece(&self, piece: Piece, y: &Vector, d: &[f64], force: &[f64]) -> Vector {
        let push = self.push_on(piece, y);
        let mut distance = [0.0; 3];
        distance[0] = if piece.closed { self.k_n * (d[0] - self.gap) } else { force[0] + push[0] };
        for c in 1..self.dim {
            distance[c] =
                if piece.slips() { force[c] + push[c] } else { self.k_t * self.slip_at(d, c) };
        }
        distance
    }

    /// The change of the displacement by a change `by` of `k v`.
    pub fn displacement_by(&self, by: &Vector) -> Vector {
        let scale = self.scale();
        std::array::from_fn(|c| by[c] / scale[c])
    }

    /// The displacement at `y` where the push is `push`.
    #[inline]
    pub fn displacement(&self, y: &Vector, push: &Vector) -> Vector {
        // Number by number: a loop of vectors over three would wait for each of them to be stored.
        let gap = if self.has_obstacle() { self.gap } else { 0.0 };
        let mut d = [gap + (y[0] - push[0] - self.tension) / self.k_n, 0.0, 0.0];
        for c in 1..self.dim {
            d[c] = self.slip0[c - 1] + (y[c] - push[c]) / self.k_t;
        }
        d
    }

    /// The pair on a piece at the coordinates `y`.
    pub fn linearised(&self, piece: Piece, y: &Vector) -> Linearised {
        let (_, threshold) = self.pressure_on(piece, y);
        let size = self.gauge(&y[1..self.dim]);
        let (turned, along) = match self.dim {
            _ if !piece.slips() || size == 0.0 => Default::default(),
            // In the plane a slip has no direction to turn in.
            2 => ([[0.0; 2]; 2], [y[1] / size, 0.0]),
            _ => self.slopes_on_bound([y[1], y[2]], threshold),
        };
        let slope = if piece.closed { self.bound.slope } else { 0.0 };
        let slopes = (turned, along.map(|along| slope * along));
        Linearised::of_piece(piece, [self.k_n, self.k_t], slopes)
    }

    /// The pair on a piece in the plane, where its derivative is the same everywhere.
    pub fn linearised_on(&self, piece: Piece) -> Linearised {
        self.linearised(piece, &self.inside(piece, 1.0))
    }

    /// Returns `true` if a piece has this boundary.
    pub fn has_boundary(&self, piece: Piece, boundary: Boundary) -> bool {
        match boundary {
            Boundary::Contact => self.has_obstacle(),
            Boundary::Slip if piece.closed => self.has_friction(),
            Boundary::Slip => !self.bound.is_cone(),
        }
    }

    /// The function of a boundary at `y`, with its gradient; a force.
    pub fn boundary(&self, piece: Piece, boundary: Boundary, y: &Vector) -> (f64, Vector) {
        if boundary == Boundary::Contact {
            return (y[0], [1.0, 0.0, 0.0]);
        }
        let (_, threshold) = self.pressure_on(piece, y);
        let size = self.gauge(&y[1..self.dim]);
        let normal = if piece.closed { -self.bound.slope } else { 0.0 };
        let [first, second] = self.conormal([y[1], y[2]], size);
        (size - threshold, [normal, first, if self.dim == 2 { 0.0 } else { second }])
    }

    /// How far `y` is outside a piece beyond a boundary, a force; not positive inside.
    pub fn excess(&self, piece: Piece, boundary: Boundary, y: &Vector) -> f64 {
        let (value, _) = self.boundary(piece, boundary, y);
        let upper = match boundary {
            Boundary::Contact => !piece.closed,
            Boundary::Slip => !piece.slips(),
        };
        if upper { value } else { -value }
    }

    /// The least `q >= 0` at which `y + q t` leaves a piece through a boundary; infinite if it never
    /// does. A point that is outside by rounding leaves at 0 if it moves on outwards, and has not left
    /// if it moves inwards.
    pub fn exit(&self, piece: Piece, boundary: Boundary, y: &Vector, t: &Vector) -> f64 {
        match boundary {
            Boundary::Contact => {
                let outwards = if piece.closed { -t[0] } else { t[0] };
                if outwards > 0.0 { (-y[0] / t[0]).max(0.0) } else { f64::INFINITY }
            }
            Boundary::Slip => {
                // gauge(y_t + q t_t)^2 - g(p' + q dp)^2 = a q^2 + 2 b q + c, positive where the pair
                // slips.
                let (_, g) = self.pressure_on(piece, y);
                let dg = if piece.closed { self.bound.slope * t[0] } else { 0.0 };
                let (mut a, mut b, mut c) = (-dg * dg, -g * dg, -g * g);
                let [y, t] = [y, t].map(|v| self.disc_of([v[1], v[2]]));
                for i in 0..self.dim - 1 {
                    a += t[i] * t[i];
                    b += y[i] * t[i];
                    c += y[i] * y[i];
                }
                if piece.slips() { falls_to_zero(a, b, c) } else { falls_to_zero(-a, -b, -c) }
            }
        }
    }
}

/// The least `q >= 0` at which `a q^2 + 2 b q + c`, positive at 0 but for rounding, falls through zero.
fn falls_to_zero(a: f64, b: f64, c: f64) -> f64 {
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return f64::INFINITY;
    }
    let root = discriminant.sqrt();
    // Takes that zero of the two where the slope 2 (a q + b) is negative, without cancellation.
    let zero = if b < 0.0 { c / (root - b) } else { (-b - root) / a };
    match b < 0.0 {
        true => zero.max(0.0),
        false if zero > 0.0 => zero,
        false => f64::INFINITY,
    }
}
