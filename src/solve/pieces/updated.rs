//! A factorised system where the law is linear on each piece, and those of a path that leads from piece to piece.
//!
//! A pair that passes a boundary changes `V = 1 - dP/dy` by `u nᵀ` and `J = K V / k + dP/dy` by `a nᵀ`,
//! `a = (K / k - 1) u`. With `z = J⁻¹ a`
//!
//! ```text
//! J'⁻¹ b = J⁻¹ b - z (n . J⁻¹ b) / (1 + n.z),    det J' = (1 + n.z) det J
//! ```
//!
//! `z` is a sum of columns of `J⁻¹ (K / k - 1)` on the pieces that were factorised (`columns`), which pass through the
//! changes since then in turn, as all solutions do.

use super::columns::Columns;
use super::equations::Equations;
use super::system::System;
use super::term::{Term, terms};
use crate::law::{Linearised, by_pairs};
use crate::linalg::simd::subtract_columns;
use crate::linalg::tolerances::SINGULAR_BASIS;
use crate::linalg::vector::dot;
use crate::linalg::watched::GoesOn;

/// The change of a pair that passes a boundary.
pub struct Change {
    term: Term,
    /// Where the pivot is zero, `J` is singular along it beyond the boundary.
    pub z: Vec<f64>,
    /// `1 + n.z`.
    pub pivot: f64,
}

/// A change that has been made.
struct Made {
    term: Term,
    /// `n.z` with the `z` of each change before it.
    before: Vec<f64>,
    pivot: f64,
}

/// A factorised system with changes since then.
pub struct Updated<'e> {
    equations: &'e Equations<'e>,
    base: System,
    /// The pairs on their pieces of today.
    pairs: Vec<Linearised>,
    columns: Columns,
    changes: Vec<Made>,
    /// The `z` of all changes.
    directions: Vec<f64>,
}

impl<'e> Updated<'e> {
    /// Factorises the system of pairs on their pieces; `None` if it is singular, or where `goes_on` says no.
    pub fn new(
        equations: &'e Equations<'e>,
        pairs: Vec<Linearised>,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let base = System::new(equations, (pairs.clone(), 1.0), SINGULAR_BASIS, goes_on)?;
        let columns = Columns::none(equations.root.len());
        let (changes, directions) = (Vec::new(), Vec::new());
        Some(Updated { equations, base, pairs, columns, changes, directions })
    }

    /// Changes since the factorisation.
    pub fn age(&self) -> usize {
        self.changes.len()
    }

    /// Sign of `det J`.
    pub fn sign(&self) -> i8 {
        let turns = self.changes.iter().filter(|made| made.pivot < 0.0).count();
        if turns.is_multiple_of(2) { self.base.orientation() } else { -self.base.orientation() }
    }

    /// `J⁻¹ b`.
    pub fn solve(&mut self, b: &[f64]) -> Vec<f64> {
        let mut x = self.base.solve(self.equations, b);
        self.pass(&mut x);
        x
    }

    /// The one term of a pair that passes a boundary; a zero one, if its derivative stays.
    fn term(&self, pair: usize, beyond: &Linearised) -> Term {
        let beyond = std::iter::once((pair, *beyond));
        terms(self.equations.dim, &self.pairs, beyond).pop().unwrap_or_default()
    }

    /// True if the change of a pair needs columns that are not known.
    pub fn lacks_columns(&self, pair: usize, beyond: &Linearised) -> bool {
        !self.columns.lacking(self.term(pair, beyond).parts()).is_empty()
    }

    /// Makes columns for changes of pairs, at most so many, so far as they are not known; `None` where `goes_on` says no.
    pub fn prepare(
        &mut self,
        likely: &[(usize, Linearised)],
        most: usize,
        goes_on: GoesOn<'_>,
    ) -> Option<()> {
        let equations = self.equations;
        let terms = terms(equations.dim, &self.pairs, likely.iter().copied());
        self.columns.prepare(&terms, most, goes_on, |components| {
            self.base.solve(equations, &equations.change_columns(components))
        })
    }

    /// Puts a pair on the piece beyond a boundary. The system follows with [`Self::make`] of the change that is returned.
    /// `None` where `goes_on` says no.
    pub fn change(
        &mut self,
        pair: usize,
        beyond: Linearised,
        goes_on: GoesOn<'_>,
    ) -> Option<Change> {
        let dim = self.equations.dim;
        if self.lacks_columns(pair, &beyond) {
            self.prepare(&[(pair, beyond)], dim, goes_on)?;
        }
        let term = self.term(pair, &beyond);
        self.pairs[pair] = beyond;
        let mut z = vec![0.0; self.equations.root.len()];
        for (place, u) in self.columns.parts(&term) {
            let column = &self.columns.values()[z.len() * place..];
            z.iter_mut().zip(column).for_each(|(z, column)| *z += u * column);
        }
        self.pass(&mut z);
        let pivot = 1.0 + term.along(&z[term.first..]);
        Some(Change { term, z, pivot })
    }

    /// Makes a change, whose pivot is not zero, and takes `x = J⁻¹ b` of the pieces before it to that of the pieces of today.
    pub fn make(&mut self, change: Change, x: &mut [f64]) {
        let Change { term, z, pivot } = change;
        let directions = self.directions.chunks_exact(x.len());
        let before = directions.map(|z| term.along(&z[term.first..])).collect();
        let made = Made { term, before, pivot };
        // Directions made before have left their parts in `x`.
        subtract_columns(x, &z, &[made.part(x, &[])]);
        self.directions.extend_from_slice(&z);
        self.changes.push(made);
    }

    /// Takes `J⁻¹ b` of the pieces that were factorised to that of the pieces of today. What each change subtracts
    /// depends on those before it through a few numbers, so that all directions are read once.
    fn pass(&self, x: &mut [f64]) {
        let mut parts = Vec::with_capacity(self.changes.len());
        self.changes.iter().for_each(|made| parts.push(made.part(x, &parts)));
        subtract_columns(x, &self.directions, &parts);
    }

    /// The displacements along which the coordinates move when they move by `y`, in the plane.
    pub fn motion(&self, y: &[f64]) -> Vec<f64> {
        let Equations { dim, root, .. } = self.equations;
        let mut dd = Vec::with_capacity(y.len());
        for ((pair, y), root) in
            self.pairs.iter().zip(by_pairs(*dim, y)).zip(root.chunks_exact(*dim))
        {
            let moved = pair.moved(&y);
            dd.extend(moved.iter().zip(root).map(|(moved, root)| moved / (root * root)));
        }
        dd
    }
}

impl Made {
    /// The multiple of its direction that this change subtracts, given those of the changes before it.
    fn part(&self, x: &[f64], parts: &[f64]) -> f64 {
        let along = self.term.along(&x[self.term.first..]) - dot(&self.before, parts);
        along * self.pivot.recip()
    }
}
