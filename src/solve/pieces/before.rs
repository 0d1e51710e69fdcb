//! The solution that a problem leaves for the next one with the same matrix.

use crate::law::{Piece, Vector};

/// The solution of the problem before with the same matrix.
#[derive(Default)]
pub struct Before {
    pub pieces: Vec<Piece>,
    /// Displacements, or the variables of a complementarity problem.
    pub d: Vec<f64>,
    /// Coordinates, and `K d`; empty for a complementarity problem.
    pub y: Vec<Vector>,
    pub product: Vec<f64>,
}

impl Before {
    /// The solution of a complementarity problem, whose variables are basic or at their bounds.
    pub fn of_variables(basic: &[bool], x: &[f64]) -> Self {
        let piece = |&basic: &bool| Piece { closed: !basic, ..Piece::OPEN };
        Before { pieces: basic.iter().map(piece).collect(), d: x.to_vec(), ..Before::default() }
    }
}
