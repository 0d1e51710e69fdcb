//! A factorised system, and those of other pieces near by, each by one change of the factorised one.
//!
//! As in `updated`, `J'⁻¹ b = J⁻¹ b - Z M⁻¹ Nᵀ J⁻¹ b`. That takes the unknowns of `Z` and the pairs that change; the pushes
//! of all other components follow from the displacements, by one product with `K` for each right-hand side.

use super::columns::Columns;
use super::equations::Equations;
use super::system::System;
use super::term::{Term, terms};
use crate::law::{Linearised, Vector};
use crate::linalg::dense::subtract_product;
use crate::linalg::factor::Factor;
use crate::linalg::simd::subtract_columns;
use crate::linalg::tolerances::{SINGULAR, SUSPICIOUS_PIVOT};
use crate::linalg::watched::{BLOCK, GoesOn};

/// A factorised system with a change.
pub struct Amended<'e> {
    equations: &'e Equations<'e>,
    base: System,
    /// The unknowns of columns of `J⁻¹ (K / k - 1)`.
    columns: Columns,
    change: Option<Change>,
}

/// The change to other pieces.
struct Change {
    /// All pairs on their pieces of today.
    pairs: Vec<Linearised>,
    terms: Vec<Term>,
    /// The components of pairs that change and that were no unknowns; their rows of `K`, and their pushes in each known
    /// column.
    held: Vec<usize>,
    rows: Vec<f64>,
    pushes: Vec<f64>,
    /// `M`, by columns, and its factor.
    matrix: Vec<f64>,
    factor: Factor,
}

impl<'e> Amended<'e> {
    /// A system of these equations that is factorised.
    pub fn of(equations: &'e Equations<'e>, base: System) -> Self {
        let columns = Columns::none(equations.root.len(), base.size());
        Amended { equations, base, columns, change: None }
    }

    /// The system that was factorised.
    pub fn into_base(self) -> System {
        self.base
    }

    /// Unknowns that were factorised.
    pub fn size(&self) -> usize {
        self.base.size()
    }

    /// True if the system that was factorised is that of `pairs`.
    pub fn is_of(&self, pairs: &[Linearised]) -> bool {
        self.base.pairs() == pairs
    }

    fn terms(&self, pairs: &[Linearised]) -> Vec<Term> {
        terms(self.equations.dim, self.base.pairs(), pairs.iter().copied().enumerate())
    }

    /// Operations of [`Self::go_to`]: a solution for each column that is new, the pairs that change, and `M`. Those of a
    /// solution take twice the time that those of a factorisation take.
    pub fn work(&self, pairs: &[Linearised]) -> f64 {
        let terms = self.terms(pairs);
        let lacking = self.columns.lacking(terms.iter().flat_map(Term::parts)).len() as f64;
        let (size, count) = (self.base.size() as f64, terms.len() as f64);
        4.0 * size * size * lacking + 2.0 * count * count * (size + count)
    }

    /// Goes to the system of pairs on their pieces; `None` if it is singular, or where `goes_on` says no.
    pub fn go_to(&mut self, pairs: Vec<Linearised>, goes_on: GoesOn<'_>) -> Option<()> {
        let (terms, equations) = (self.terms(&pairs), self.equations);
        self.change = None;
        if terms.is_empty() {
            return Some(());
        }
        self.prepare(&terms, goes_on)?;
        let dim = equations.dim;
        let mut held: Vec<usize> =
            terms.iter().flat_map(|own| own.first..own.first + dim).collect();
        held.dedup();
        held.retain(|&i| !self.base.pairs()[i / dim].moves(i % dim));
        let rows = self.base.rows(equations, &held);
        let (known, size) = (self.columns.components(), self.base.size());
        let mut pushes = Vec::with_capacity(held.len() * known.len());
        for &j in known {
            pushes.extend(held.iter().map(|&i| equations.change_entry(i, j)));
        }
        subtract_product(&mut pushes, &rows, self.columns.values(), size);
        let count = terms.len();
        let mut matrix = vec![0.0; count * count];
        for (column, term) in matrix.chunks_exact_mut(count).zip(&terms) {
            for (place, u) in term.parts().filter_map(|(i, u)| Some((self.columns.place(i)?, u))) {
                let x = &self.columns.values()[size * place..size * (place + 1)];
                let pushes = &pushes[held.len() * place..held.len() * (place + 1)];
                for (entry, row) in column.iter_mut().zip(&terms) {
                    *entry += u * row.along(&self.own(row.first, x, (&held, pushes)));
                }
            }
        }
        matrix.iter_mut().step_by(count + 1).for_each(|entry| *entry += 1.0);
        let fill = |j: usize, entries: &mut [f64]| {
            entries.copy_from_slice(&matrix[count * j..count * (j + 1)]);
        };
        let factor = Factor::new(count, false, SINGULAR, fill, goes_on)?;
        self.change = Some(Change { pairs, terms, held, rows, pushes, matrix, factor });
        Some(())
    }

    /// Makes the columns that the terms need and that are not known; `None` where `goes_on` says no.
    fn prepare(&mut self, terms: &[Term], goes_on: GoesOn<'_>) -> Option<()> {
        let lacking = |columns: &Columns| columns.lacking(terms.iter().flat_map(Term::parts));
        let mut components = lacking(&self.columns);
        if !self.columns.make_room(components.len()) {
            components = lacking(&self.columns);
        }
        for components in components.chunks(BLOCK) {
            if !goes_on() {
                return None;
            }
            let columns = self.base.unknowns(&self.equations.change_columns(components));
            self.columns.add(components, &columns);
        }
        Some(())
    }

    /// The coordinates of a pair that changes, on its piece of before, from the unknowns and the pushes of the components
    /// that were none.
    fn own(&self, first: usize, x: &[f64], (held, pushes): (&[usize], &[f64])) -> Vector {
        let push = |i| pushes[held.binary_search(&i).expect("the pair changes")];
        self.base.own(first / self.equations.dim, x, push)
    }

    /// `J⁻¹ b`.
    pub fn solve(&mut self, b: &[f64]) -> Vec<f64> {
        let equations = self.equations;
        let Some(mut change) = self.change.take() else { return self.base.solve(equations, b) };
        let mut x = self.base.unknowns(b);
        let mut pushes: Vec<f64> = change.held.iter().map(|&i| b[i]).collect();
        subtract_product(&mut pushes, &change.rows, &x, x.len());
        let own =
            |first: usize, x: &[f64], pushes: &[f64]| self.own(first, x, (&change.held, pushes));
        let along = change.terms.iter().map(|term| term.along(&own(term.first, &x, &pushes)));
        let mut along: Vec<f64> = along.collect();
        change.factor.solve(&mut along);
        let mut parts = vec![0.0; self.columns.components().len()];
        for (term, along) in change.terms.iter().zip(&along) {
            let known = term.parts().filter_map(|(i, u)| Some((self.columns.place(i)?, u)));
            known.for_each(|(place, u)| parts[place] += u * along);
        }
        subtract_columns(&mut x, self.columns.values(), &parts);
        subtract_columns(&mut pushes, &change.pushes, &parts);
        let mut dd = self.base.displacements(&x);
        for first in change.terms.iter().map(|term| term.first) {
            let pair = first / equations.dim;
            let moved = change.pairs[pair].moved(&own(first, &x, &pushes));
            for (i, moved) in (first..first + equations.dim).zip(moved) {
                dd[i] = moved / equations.root[i].powi(2);
            }
        }
        let y = equations.with_pushes(&change.pairs, b, dd);
        self.change = Some(change);
        y
    }

    /// Sign of `det J`.
    pub fn sign(&self) -> i8 {
        self.base.orientation() * self.change.as_ref().map_or(1, |change| change.factor.sign())
    }

    /// The variables of a symmetric complementarity problem that were basic in the factorised system, and those that are
    /// since, if their block is positive definite beyond doubt; nothing otherwise, or where `goes_on` says no.
    ///
    /// `M` of the variables that became basic is the Schur complement of the block, in the units of its columns. Solutions
    /// lose the digits by which the pivots of the factorised system are small: the product of both least pivots decides.
    pub fn definite(&self, goes_on: GoesOn<'_>) -> Vec<bool> {
        let (first, none) = (self.base.least_pivot(), Vec::new());
        if first <= SUSPICIOUS_PIVOT {
            return none;
        }
        let basic = |pairs: &[Linearised]| pairs.iter().map(|pair| pair.moves(0)).collect();
        let before: Vec<bool> = basic(self.base.pairs());
        let Some(change) = &self.change else { return before };
        let now: Vec<bool> = basic(&change.pairs);
        let (root, count) = (&self.equations.root, change.terms.len());
        let became_basic: Vec<(usize, f64)> = (change.terms.iter().enumerate())
            .filter(|(_, term)| now[term.first])
            .map(|(k, term)| (k, root[term.first]))
            .collect();
        let fill = |j: usize, column: &mut [f64]| {
            let (own, root) = became_basic[j];
            for (entry, (row, other)) in column[j..].iter_mut().zip(&became_basic[j..]) {
                *entry = change.matrix[row + count * own] * (root / other);
            }
        };
        let schur = Factor::new(became_basic.len(), true, SINGULAR, fill, goes_on);
        if schur.is_none_or(|schur| first * schur.least_pivot() <= SUSPICIOUS_PIVOT) {
            return none;
        }
        before.iter().zip(&now).map(|(before, now)| before | now).collect()
    }
}
