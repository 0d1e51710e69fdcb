//! A pair on its piece to first order: what it contributes to the system of equations on given pieces.
//!
//! With `T = dtau/dy_t` and `drag = dtau/dp` at a given slip, a pair that slips or carries no friction has the
//! tangential unknown `x` with `dy_t = k x + drag dp`:
//!
//! ```text
//! dd_t = motion x = (1 - T) x,    dtau = drag dp + turn x = drag dp + T k x
//! ```
//!
//! because where the bound grows by a part and the slip stays, the trial force less `k` times the slip grows by that
//! part along the friction. Nothing is divided by the slip. An open pair has the normal displacement as its unknown.

use super::{Piece, Planar, Plane, Vector, ellipse};

/// The derivatives of a pair that moves along its tangents.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slopes {
    /// `dtau/dp` at a given slip, zero of an open pair.
    pub drag: [f64; 2],
    /// The tangential displacement by its unknowns.
    pub motion: Plane,
    /// The friction by the same.
    pub turn: Plane,
}

impl Slopes {
    /// True if the pair leaves a symmetric system symmetric: its friction follows nothing.
    pub fn is_plain(&self) -> bool {
        self.drag == [0.0; 2] && self.turn == [[0.0; 2]; 2]
    }

    /// How component `c` of the force follows the pressure.
    pub fn drag_of(&self, c: usize) -> f64 {
        if c == 0 { 0.0 } else { self.drag[c - 1] }
    }
}

/// A pair on its piece, to first order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearised {
    /// True if the pressure follows `y`, and not the displacement.
    pub closed: bool,
    /// True if the pair moves along its tangents.
    pub slips: bool,
    /// How it moves.
    pub slopes: Slopes,
    /// `k` of the normal component, and of the tangential ones.
    scale: [f64; 2],
}

impl Linearised {
    /// A variable of a complementarity problem as a pair of one component: closed at its bound, open where it is basic.
    pub fn of_variable(is_basic: bool, unit: f64) -> Self {
        let (closed, slips, slopes) = (!is_basic, false, Slopes::default());
        Linearised { closed, slips, slopes, scale: [unit, 0.0] }
    }

    /// A pair on a piece with its scales, `T` and its drag; zero where its friction follows nothing.
    pub(super) fn of_piece(
        piece: Piece,
        scale: [f64; 2],
        (turned, drag): (Plane, [f64; 2]),
    ) -> Self {
        let mut motion = [[1.0, 0.0], [0.0, 1.0]];
        let parts = motion.as_flattened_mut().iter_mut().zip(turned.as_flattened());
        parts.for_each(|(motion, turned)| *motion -= turned);
        let turn = turned.map(|row| row.map(|turned| turned * scale[1]));
        let slopes = Slopes { drag, motion, turn };
        Linearised { closed: piece.closed, slips: piece.slips(), slopes, scale }
    }

    /// `k v` of the pair's part of a vector, which has one to three components.
    pub fn scaled(&self, v: &[f64]) -> Vector {
        let [normal, tangential] = self.scale;
        let component = |c: usize| v.get(c).map_or(0.0, |v| tangential * v);
        [normal * v[0], component(1), component(2)]
    }

    /// `C = T (1 - T)⁻¹ k`: how friction turns with the slip, `dtau = drag dp + C ddelta`, a force per length. Of an
    /// isotropic law it is `g / |delta|` across the slip.
    ///
    /// One eigenvalue of `T` is 0 and the other its trace, so that `T (1 - T)⁻¹ = T / (1 - trace)`. Where a slip begins
    /// the divisor is taken as the rounding of the trace at least.
    pub fn curvature(&self) -> Plane {
        let [[first, _], [_, second]] = self.slopes.motion;
        let rest = (first + second - 1.0).max(f64::EPSILON);
        self.slopes.turn.map(|row| row.map(|entry| entry / rest))
    }

    /// True if component `c` is an unknown.
    pub fn moves(&self, c: usize) -> bool {
        if c == 0 { !self.closed } else { self.slips }
    }

    /// `dP/dy` in the plane, where a slip has no direction to turn in.
    fn planar(&self) -> [Planar; 2] {
        let one_if = |held: bool| if held { 1.0 } else { 0.0 };
        [[one_if(self.closed), 0.0], [self.slopes.drag[0], one_if(!self.slips)]]
    }

    /// The change of `k v` where the coordinates change by `y`.
    pub fn moved(&self, y: &Vector) -> Vector {
        let (normal, drag) = (if self.closed { y[0] } else { 0.0 }, self.slopes.drag);
        let unknown = [y[1] - drag[0] * normal, y[2] - drag[1] * normal];
        let [one, two] = match self.slips {
            true => ellipse::product(&self.slopes.motion, unknown),
            false => [0.0; 2],
        };
        [y[0] - normal, one, two]
    }

    /// The change of `1 - dP/dy` from here to `beyond` in the plane, as a sum of `u nᵀ`: each `u` with its `n`. One
    /// boundary changes it by one of them.
    pub fn change_to(&self, beyond: &Linearised) -> Vec<(Planar, Planar)> {
        let (before, beyond) = (self.planar(), beyond.planar());
        let rows: [Planar; 2] =
            std::array::from_fn(|r| std::array::from_fn(|c| before[r][c] - beyond[r][c]));
        let [one, other] = rows;
        if one[0] * other[1] != one[1] * other[0] {
            return vec![([1.0, 0.0], one), ([0.0, 1.0], other)];
        }
        let square = |row: &Planar| row[0] * row[0] + row[1] * row[1];
        let n = if square(&one) > square(&other) { one } else { other };
        let along = |row: &Planar| (row[0] * n[0] + row[1] * n[1]) / square(&n);
        if square(&n) > 0.0 { vec![([along(&one), along(&other)], n)] } else { Vec::new() }
    }

    /// Turns the changes of the unknowns, and of the pushes of the other components, into those of the coordinates.
    pub fn complete(&self, own: &mut [f64]) {
        let [normal, tangential] = self.scale;
        if !self.closed {
            own[0] *= normal;
        }
        if let [pressure, along @ ..] = own
            && self.slips
        {
            let parts = along.iter_mut().zip(self.slopes.drag);
            parts.for_each(|(own, drag)| *own = tangential * *own + drag * *pressure);
        }
    }
}
