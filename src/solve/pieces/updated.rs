//! A factorised system where the law is linear on each piece, and the systems of other pieces near by.
//!
//! Pairs that change their pieces change `V = 1 - dP/dy` by a sum of `u nᵀ` and `J = K V / k + dP/dy` by
//! `a nᵀ`, `a = (K / k - 1) u`. With the columns `Z = J⁻¹ a` of the changes that are made together, `N` of their `n`, and
//! `M = 1 + Nᵀ Z`,
//!
//! ```text
//! J'⁻¹ b = J⁻¹ b - Z M⁻¹ Nᵀ J⁻¹ b,    det J' = det M det J
//! ```
//!
//! `Z` is a sum of columns of `J⁻¹ (K / k - 1)` on the pieces that were factorised (`columns`), which pass through the
//! changes since then in turn, as all solutions do. Pairs that change together pass no system between them, which may
//! be singular where that of all changes is not.

use super::columns::Columns;
use super::equations::{Equations, by_pairs};
use super::system::System;
use super::term::{Term, terms};
use crate::law::Linearised;
use crate::linalg::factor::Factor;
use crate::linalg::simd::subtract_columns;
use crate::linalg::tolerances::SINGULAR;
use crate::linalg::vector::dot;
use crate::linalg::watched::{BLOCK, GoesOn};

/// Changes that are made together.
pub struct Change {
    pairs: Vec<(usize, Linearised)>,
    terms: Vec<Term>,
    /// `Z`, by columns: where the pivot of a single term is zero, `J` is singular along it beyond the boundary.
    pub z: Vec<f64>,
    /// `M`, by columns.
    matrix: Vec<f64>,
    /// For each term `n.z` of the terms that were made before.
    before: Vec<Vec<f64>>,
}

impl Change {
    /// The first entry of `M`: of a single term the factor by which it changes the determinant.
    pub fn pivot(&self) -> f64 {
        self.matrix.first().copied().unwrap_or(1.0)
    }
}

/// Changes that have been made.
struct Made {
    terms: Vec<Term>,
    before: Vec<Vec<f64>>,
    /// `M⁻¹`, by columns.
    inverse: Vec<f64>,
    sign: i8,
}

/// A factorised system with changes since then.
pub struct Updated<'e> {
    equations: &'e Equations<'e>,
    base: System,
    /// The pairs on their pieces of today.
    pairs: Vec<Linearised>,
    columns: Columns,
    changes: Vec<Made>,
    /// `Z` of all changes.
    directions: Vec<f64>,
}

impl<'e> Updated<'e> {
    /// Factorises the system of pairs on their pieces; `None` if a pivot is below `least`, relative to the
    /// largest, or where `goes_on` says no.
    pub fn new(
        equations: &'e Equations<'e>,
        pairs: Vec<Linearised>,
        least: f64,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let base = System::new(equations, (pairs.clone(), 1.0), None, least, goes_on)?;
        let columns = Columns::none(equations.root.len(), equations.root.len());
        let (changes, directions) = (Vec::new(), Vec::new());
        Some(Updated { equations, base, pairs, columns, changes, directions })
    }

    /// Terms since the factorisation.
    pub fn age(&self) -> usize {
        self.changes.iter().map(|made| made.terms.len()).sum()
    }

    /// Sign of `det J`.
    pub fn sign(&self) -> i8 {
        self.changes.iter().fold(self.base.orientation(), |sign, made| sign * made.sign)
    }

    /// `J⁻¹ b`.
    pub fn solve(&mut self, b: &[f64]) -> Vec<f64> {
        let mut x = self.base.solve(self.equations, b);
        self.pass(&mut x);
        x
    }

    /// The terms of a change of pairs.
    fn terms(&self, pairs: &[(usize, Linearised)]) -> Vec<Term> {
        terms(self.equations.dim, &self.pairs, pairs.iter().copied())
    }

    /// True if a change needs columns that are not known.
    pub fn lacks_columns(&self, pairs: &[(usize, Linearised)]) -> bool {
        !self.columns.lacking(self.terms(pairs).iter().flat_map(Term::parts)).is_empty()
    }

    /// Makes columns for changes of pairs, at most so many, so far as they are not known; `None` where `goes_on` says no.
    pub fn prepare(
        &mut self,
        likely: &[(usize, Linearised)],
        most: usize,
        goes_on: GoesOn<'_>,
    ) -> Option<()> {
        let (terms, equations) = (self.terms(likely), self.equations);
        self.columns.prepare(&terms, most, goes_on, |components| {
            self.base.solve(equations, &equations.change_columns(components))
        })
    }

    /// The change of pairs to the pieces beyond; `None` where `goes_on` says no.
    pub fn change(&mut self, pairs: &[(usize, Linearised)], goes_on: GoesOn<'_>) -> Option<Change> {
        let terms = self.terms(pairs);
        if self.lacks_columns(pairs) {
            self.prepare(pairs, 2 * terms.len(), goes_on)?;
        }
        let size = self.equations.root.len();
        let mut z = vec![0.0; size * terms.len()];
        for (term, z) in terms.iter().zip(z.chunks_exact_mut(size)) {
            for (i, u) in term.parts() {
                let column = self.columns.of(i).expect("it was prepared above");
                z.iter_mut().zip(column).for_each(|(z, column)| *z += u * column);
            }
            self.pass(z);
        }
        let mut matrix = Vec::with_capacity(terms.len() * terms.len());
        for (column, z) in z.chunks_exact(size).enumerate() {
            let one = |row: usize| if row == column { 1.0 } else { 0.0 };
            matrix
                .extend(terms.iter().enumerate().map(|(row, n)| one(row) + n.along(&z[n.first..])));
        }
        let made = || self.directions.chunks_exact(size);
        let before = terms
            .iter()
            .map(|term| made().map(|z| term.along(&z[term.first..])).collect())
            .collect();
        Some(Change { pairs: pairs.to_vec(), terms, z, matrix, before })
    }

    /// Makes a change. `None`: the new system is singular, and has to be factorised, or `goes_on` says no.
    pub fn make(&mut self, change: Change, goes_on: GoesOn<'_>) -> Option<()> {
        let Change { pairs, terms, z, matrix, before } = change;
        pairs.into_iter().for_each(|(pair, beyond)| self.pairs[pair] = beyond);
        let (inverse, sign) = inverse(&matrix, terms.len(), goes_on)?;
        self.changes.push(Made { terms, before, inverse, sign });
        self.directions.extend_from_slice(&z);
        Some(())
    }

    /// Takes `J⁻¹ b` of the pieces before the last change to that of the pieces of today.
    pub fn follow(&self, x: &mut [f64]) {
        let Some(made) = self.changes.last() else { return };
        let mut parts = Vec::with_capacity(made.terms.len());
        // Directions made before have left their parts in `x`.
        made.add_parts(x, &mut parts);
        subtract_columns(
            x,
            &self.directions[self.directions.len() - x.len() * parts.len()..],
            &parts,
        );
    }

    /// Takes `J⁻¹ b` of the pieces that were factorised to that of the pieces of today. What each change subtracts
    /// depends on those before it through a few numbers, so that all directions are read once.
    fn pass(&self, x: &mut [f64]) {
        let mut parts = Vec::with_capacity(self.directions.len() / x.len().max(1));
        self.changes.iter().for_each(|made| made.add_parts(x, &mut parts));
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
    /// The multiples of its directions that this change subtracts, given those of the changes before it: `M⁻¹ Nᵀ J⁻¹ b`.
    fn add_parts(&self, x: &[f64], parts: &mut Vec<f64>) {
        let count = self.terms.len();
        let before = |row: usize| self.before.get(row).map_or(0.0, |before| dot(before, parts));
        let along: Vec<f64> = self
            .terms
            .iter()
            .enumerate()
            .map(|(row, term)| term.along(&x[term.first..]) - before(row))
            .collect();
        let begin = parts.len();
        parts.resize(begin + count, 0.0);
        subtract_columns(&mut parts[begin..], &self.inverse, &along);
        parts[begin..].iter_mut().for_each(|part| *part = -*part);
    }
}

/// The inverse of an `n x n` matrix, and the sign of its determinant; `None` if it is singular, or where `goes_on` says no.
fn inverse(matrix: &[f64], n: usize, goes_on: GoesOn<'_>) -> Option<(Vec<f64>, i8)> {
    if let [only] = matrix {
        let sign = if *only < 0.0 { -1 } else { 1 };
        return (*only != 0.0).then(|| (vec![only.recip()], sign));
    }
    let fill = |j: usize, column: &mut [f64]| column.copy_from_slice(&matrix[n * j..n * (j + 1)]);
    let mut factor = Factor::new(n, false, SINGULAR, fill, goes_on)?;
    let mut inverse = vec![0.0; n * n];
    inverse.iter_mut().step_by(n + 1).for_each(|entry| *entry = 1.0);
    for columns in inverse.chunks_mut((BLOCK * n).max(1)) {
        if !goes_on() {
            return None;
        }
        factor.solve(columns);
    }
    Some((inverse, factor.sign()))
}
