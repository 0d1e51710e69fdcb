//! The homotopy from any point to the contact problem, and its values on given pieces.

use crate::law::{Piece, Vector, references};
use crate::linalg::vector::dot;
use crate::solve::pieces::Equations;

/// `H_s(y) = s (K d - f) + (1 - s) (k v - b) + P` on the normal map, with `b = k v + P` at the start. With
/// tension `k v` and `b` both stand for themselves plus the tension.
pub struct Homotopy<'e> {
    pub equations: &'e Equations<'e>,
    /// `b`, component by component.
    base: Vec<f64>,
    /// Size of the coordinates and loads, in scaled forces.
    pub size: f64,
}

/// A point of the curve or near it; a direction; or the coefficients of a function of directions.
#[derive(Clone)]
pub struct PathPoint {
    pub y: Vec<Vector>,
    pub s: f64,
}

/// The homotopy at a place on given pieces.
pub struct Value {
    /// `H`.
    pub lack: Vec<f64>,
    /// `dH/ds`.
    pub rate: Vec<f64>,
    /// Length of `H` in scaled forces.
    pub merit: f64,
    /// Length of the terms of `H`, whose rounding it carries.
    pub terms: f64,
    /// Length of `k v`.
    pub stretch: f64,
}

impl<'e> Homotopy<'e> {
    /// The homotopy that begins at `start`.
    pub fn new(equations: &'e Equations<'e>, start: &[Vector]) -> Self {
        let dim = equations.dim;
        let base: Vec<f64> = start.iter().flat_map(|y| y[..dim].iter().copied()).collect();
        // f - K (gap, slip0): the force that the law's corner would need.
        let corner: Vec<f64> = references(&equations.laws, dim).collect();
        let size = equations.length(&equations.force(&corner)).max(equations.length(&base));
        Homotopy { equations, base, size: if size > 0.0 { size } else { 1.0 } }
    }

    /// The homotopy at a place on given pieces.
    pub fn value(&self, pieces: &[Piece], place: &PathPoint) -> Value {
        let (equations, s) = (self.equations, place.s);
        let dim = equations.dim;
        let (d, push) = equations.values(pieces, &place.y);
        let force = equations.force(&d);
        let size = force.len();
        let (mut lack, mut rate) = (Vec::with_capacity(size), Vec::with_capacity(size));
        let mut stretch = Vec::with_capacity(size);
        for i in 0..size {
            let scaled = place.y[i / dim][i % dim] - push[i];
            let other = scaled - self.base[i];
            lack.push(s * force[i] + (1.0 - s) * other + push[i]);
            rate.push(force[i] - other);
            stretch.push(scaled);
        }
        let merit = equations.length(&lack);
        let stretch = equations.length(&stretch);
        Value { terms: equations.length(&push), lack, rate, merit, stretch }
    }

    /// Length of a point or direction, with coordinates in units of the homotopy's size and `s`.
    pub fn norm(&self, a: &PathPoint) -> f64 {
        self.dual(a).apply(a).sqrt()
    }

    /// The coefficients of the inner product with `a`, in the same units.
    pub fn dual(&self, a: &PathPoint) -> PathPoint {
        let dim = self.equations.dim;
        let mut dual = a.clone();
        for (at, y) in dual.y.iter_mut().enumerate() {
            for (y, root) in y.iter_mut().zip(&self.equations.root[dim * at..dim * (at + 1)]) {
                *y /= (root * self.size).powi(2);
            }
        }
        dual
    }
}

impl PathPoint {
    /// The coefficient of `s`.
    pub fn of_s(pairs: usize) -> Self {
        PathPoint { y: vec![[0.0; 3]; pairs], s: 1.0 }
    }

    /// The place `q` along a direction.
    pub fn along(&self, direction: &PathPoint, q: f64) -> Self {
        let y = self.y.iter().zip(&direction.y);
        let y = y.map(|(y, t)| std::array::from_fn(|c| y[c] + q * t[c])).collect();
        PathPoint { y, s: self.s + q * direction.s }
    }

    /// The direction from here to another place.
    pub fn to(&self, other: &PathPoint) -> Self {
        other.along(self, -1.0)
    }

    /// Multiplies by a number.
    pub fn scale(&mut self, by: f64) {
        self.s *= by;
        self.y.iter_mut().flatten().for_each(|y| *y *= by);
    }

    /// The value of a function, of which `self` holds the coefficients, at a direction.
    pub fn apply(&self, other: &PathPoint) -> f64 {
        let y = self.y.iter().zip(&other.y);
        self.s * other.s + y.map(|(a, b)| dot(a, b)).sum::<f64>()
    }
}
