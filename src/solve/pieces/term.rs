//! The change of a system where pairs pass to other pieces.
//!
//! They change `V = 1 - dP/dy` by a sum of `u nᵀ` and `J = K V / k + dP/dy` by `a nᵀ`, `a = (K / k - 1) u`.

use crate::law::{Linearised, Planar};

/// A term `u nᵀ` of the change of a pair.
#[derive(Default)]
pub struct Term {
    /// First component of the pair.
    pub first: usize,
    u: Planar,
    n: Planar,
}

/// The terms of pairs that pass from their pieces to others.
pub fn terms(
    dim: usize,
    pairs: &[Linearised],
    others: impl Iterator<Item = (usize, Linearised)>,
) -> Vec<Term> {
    let of_pair = |(pair, beyond): (usize, Linearised)| {
        let terms = pairs[pair].change_to(&beyond).into_iter();
        terms.map(move |(u, n)| Term { first: dim * pair, u, n })
    };
    others.filter(|(pair, beyond)| pairs[*pair] != *beyond).flat_map(of_pair).collect()
}

impl Term {
    /// `n.y` for the coordinates of the pair.
    pub fn along(&self, own: &[f64]) -> f64 {
        let second = if self.n[1] == 0.0 { 0.0 } else { self.n[1] * own[1] };
        self.n[0] * own[0] + second
    }

    /// The components of which `u` is made, each with its part.
    pub fn parts(&self) -> impl Iterator<Item = (usize, f64)> + use<> {
        let first = self.first;
        let parts = self.u.into_iter().enumerate().filter(|(_, u)| *u != 0.0);
        parts.map(move |(c, u)| (first + c, u))
    }
}
