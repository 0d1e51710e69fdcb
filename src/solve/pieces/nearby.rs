//! Systems that differ from a factorised one in the pieces of few pairs.
//!
//! Pairs on other pieces than those that were factorised change `J` by `A Nᵀ` (`term`). With `M = 1 + Nᵀ J⁻¹ A`
//!
//! ```text
//! J'⁻¹ b = J⁻¹ (b - A M⁻¹ Nᵀ J⁻¹ b),    det J' = det M det J
//! ```
//!
//! so that all components are wanted of two solutions alone. Of each column of `A` the displacements of the unknowns are
//! kept, from which the few components follow that `N` asks for. A pair that comes back to its piece costs nothing.

use super::columns::Columns;
use super::equations::Equations;
use super::system::System;
use super::term::{Term, terms};
use crate::law::Linearised;
use crate::linalg::factor::Factor;

/// A factorised system, and today's beside it.
pub struct Nearby<'e> {
    equations: &'e Equations<'e>,
    base: System<'e>,
    /// The displacements of the unknowns for each column that a change has asked for.
    columns: Columns,
    /// The terms of today's changes, and the factor of `M`.
    terms: Vec<Term>,
    factor: Option<Factor>,
}

impl<'e> Nearby<'e> {
    /// A factorised system without changes.
    pub fn of(equations: &'e Equations<'e>, base: System<'e>) -> Self {
        let columns = Columns::none(equations.root.len(), base.size());
        Nearby { equations, base, columns, terms: Vec::new(), factor: None }
    }

    /// Unknowns that were factorised.
    pub fn size(&self) -> usize {
        self.base.size()
    }

    /// The terms by which pairs on other pieces change the factorised system.
    pub fn terms_to(&self, pairs: &[Linearised]) -> Vec<Term> {
        let others = pairs.iter().copied().enumerate();
        terms(self.equations.dim, self.base.pairs(), others)
    }

    /// Operations of [`Self::go_to`]: a solution for each column that is new, and `M`.
    pub fn work(&self, terms: &[Term]) -> f64 {
        let lacking = self.columns.lacking(terms.iter().flat_map(Term::parts)).len() as f64;
        let (size, count) = (self.base.size() as f64, terms.len() as f64);
        2.0 * size * (size * lacking + count * count)
    }

    /// Goes to the system with these terms; `None` if it is singular.
    pub fn go_to(&mut self, terms: Vec<Term>) -> Option<()> {
        self.factor = None;
        let lacking = self.columns.lacking(terms.iter().flat_map(Term::parts));
        let lacking = match self.columns.make_room(lacking.len()) {
            true => lacking,
            false => self.columns.lacking(terms.iter().flat_map(Term::parts)),
        };
        let sides = self.equations.change_columns(&lacking);
        let columns = self.base.displacements(&sides);
        self.columns.add(&lacking, &columns);
        if !terms.is_empty() {
            let factor = Factor::new(terms.len(), false, |j, entries| {
                for (i, (entry, row)) in entries.iter_mut().zip(&terms).enumerate() {
                    *entry = self.along(row, &terms[j]) + if i == j { 1.0 } else { 0.0 };
                }
            })?;
            self.factor = Some(factor);
        }
        self.terms = terms;
        Some(())
    }

    /// `n.J⁻¹ a` for the `n` of one term and the column `a` of another.
    fn along(&self, row: &Term, column: &Term) -> f64 {
        let dim = self.equations.dim;
        let of_part = |(i, u): (usize, f64)| {
            let moved = self.columns.of(i).expect("it was made before");
            let b = |row: usize| self.equations.change_entry(row, i);
            u * row.of_pair(&self.base.of_pair(row.first / dim, b, moved))
        };
        column.parts().map(of_part).sum()
    }

    /// `J'⁻¹ b`.
    pub fn solve(&mut self, b: &[f64]) -> Vec<f64> {
        let Some(factor) = &mut self.factor else { return self.base.solve(b) };
        let dim = self.equations.dim;
        let moved = self.base.displacements(b);
        let base = &self.base;
        let along = |term: &Term| term.of_pair(&base.of_pair(term.first / dim, |i| b[i], &moved));
        let mut parts: Vec<f64> = self.terms.iter().map(along).collect();
        factor.solve(&mut parts);
        let mut b = b.to_vec();
        for (term, part) in self.terms.iter().zip(&parts) {
            for (i, u) in term.parts() {
                self.equations.subtract_change_column(i, u * part, &mut b);
            }
        }
        self.base.solve(&b)
    }

    /// Sign of `det J'`.
    pub fn orientation(&self) -> i8 {
        self.base.orientation() * self.factor.as_ref().map_or(1, Factor::sign)
    }
}
