//! A pair on its piece to first order: what it contributes to the system of equations on given pieces.
//!
//! With `T = dtau/dy_t` and `drag = dtau/dp`, `T drag = 0` under every law, a pair that slips or carries no
//! friction has the tangential unknown `x` with `dy_t = k x + drag dp`:
//!
//! ```text
//! dd_t = motion x = k⁻¹ (1 - T) k x,    dtau = drag dp + turn x = drag dp + T k x
//! ```
//!
//! Nothing is divided by the slip. An open pair has the normal displacement as its unknown.

use super::{PairBlock, PairLaw, Piece, Planar, Plane, Vector, ellipse};

/// The derivatives of a pair that moves along its tangents.
#[derive(Clone, Copy, Debug, Default)]
pub struct Slopes {
    /// `dtau/dp`, zero of an open pair.
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
}

/// A pair on its piece, to first order.
#[derive(Clone, Copy, Debug)]
pub struct Linearised {
    /// True if the pressure follows `y`, and not the displacement.
    pub closed: bool,
    /// True if the pair moves along its tangents.
    pub slips: bool,
    /// How it moves.
    pub slopes: Slopes,
    /// `k` of the normal component, and of the tangential ones.
    normal_scale: f64,
    scale: Plane,
}

impl Linearised {
    /// A variable of a complementarity problem as a pair of one component: closed at its bound, open where it is basic.
    pub fn of_variable(is_basic: bool, unit: f64) -> Self {
        let (closed, slips, slopes) = (!is_basic, false, Slopes::default());
        Linearised { closed, slips, slopes, normal_scale: unit, scale: Plane::default() }
    }

    /// `k v` of the pair's part of a vector, which has one to three components.
    pub fn scaled(&self, v: &[f64]) -> Vector {
        let component = |c: usize| v.get(c).copied().unwrap_or(0.0);
        let [one, two] = ellipse::product(&self.scale, [component(1), component(2)]);
        [self.normal_scale * v[0], one, two]
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

    /// The change of `k v` in the plane where the coordinates change by `y`.
    pub fn moved(&self, y: Planar) -> Planar {
        let [normal, tangential] = self.planar();
        [y[0] - normal[0] * y[0], y[1] - tangential[0] * y[0] - tangential[1] * y[1]]
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
        if !self.closed {
            own[0] *= self.normal_scale;
        }
        if !self.slips {
            return;
        }
        let (drag, scale) = (self.slopes.drag, &self.scale);
        match own {
            [normal, one] => *one = scale[0][0] * *one + drag[0] * *normal,
            [normal, one, other] => {
                let [first, second] = ellipse::product(scale, [*one, *other]);
                (*one, *other) = (first + drag[0] * *normal, second + drag[1] * *normal);
            }
            _ => {}
        }
    }
}

impl PairLaw {
    /// The pair on a piece at the coordinates `y`.
    pub fn linearised(&self, piece: Piece, y: &Vector) -> Linearised {
        self.linearised_by(&self.derivative_on(piece, y), piece.slips())
    }

    /// The pair on a piece in the plane, where its derivative is the same everywhere.
    pub fn linearised_on(&self, piece: Piece) -> Linearised {
        self.linearised(piece, &self.inside(piece, 1.0))
    }

    /// The pair where the piece has the derivative `dP/dy`.
    pub fn linearised_by(&self, derivative: &PairBlock, slips: bool) -> Linearised {
        let [_, [first, a, b], [second, c, d]] = *derivative;
        let (turned, scale) = ([[a, b], [c, d]], self.tangential_scale());
        let slopes = Slopes {
            drag: [first, second],
            motion: self.moves(&turned),
            turn: ellipse::times(&turned, &scale),
        };
        let closed = derivative[0][0] != 0.0;
        Linearised { closed, slips, slopes, normal_scale: self.normal_scale(), scale }
    }
}
