//! The solution that a problem leaves for the next one with the same matrix.

use crate::law::{Piece, Vector};

/// The solution of the problem before with the same matrix.
pub struct Before {
    pub pieces: Vec<Piece>,
    /// Displacements, or the variables of a complementarity problem.
    pub d: Vec<f64>,
    /// `K d`.
    pub product: Vec<f64>,
    /// Coordinates; none of a complementarity problem.
    pub y: Vec<Vector>,
}

impl Before {
    /// The solution `M x + q = w` of a complementarity problem, whose variables are basic or at their bounds.
    pub fn of_variables(basic: &[bool], (x, w): (&[f64], &[f64]), q: &[f64]) -> Self {
        let piece = |&basic: &bool| Piece { closed: !basic, ..Piece::OPEN };
        let pieces = basic.iter().map(piece).collect();
        let product = w.iter().zip(q).map(|(w, q)| w - q).collect();
        Before { pieces, d: x.to_vec(), product, y: Vec::new() }
    }
}
