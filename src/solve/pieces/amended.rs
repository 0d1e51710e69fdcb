//! A factorised system, and those of other pieces near by, each by one change of the factorised one.
//!
//! As in `updated`, `J'⁻¹ b = J⁻¹ b - Z M⁻¹ Nᵀ J⁻¹ b`. That takes the unknowns of `Z` and the pairs that change; the pushes
//! of all other components follow from the displacements, by one product with `K` for each right-hand side.

use super::columns::Columns;
use super::equations::{Equations, Step};
use super::system::System;
use super::term::{Term, terms};
use crate::law::{Linearised, by_pairs};
use crate::linalg::dense::subtract_product;
use crate::linalg::factor::Factor;
use crate::linalg::simd::subtract_columns;
use crate::linalg::tolerances::{SINGULAR, SUSPICIOUS_PIVOT};
use crate::linalg::watched::{GoesOn, written};

/// A factorised system with a change. Its functions take the equations, whose matrix stays.
pub struct Amended {
    /// The system that was factorised.
    pub base: System,
    /// The unknowns of columns of `J⁻¹ (K / k - 1)`.
    columns: Columns,
    change: Option<Change>,
}

/// The change to other pieces.
struct Change {
    /// All pairs on their pieces of today.
    pairs: Vec<Linearised>,
    changed: Changed,
    /// The terms, each with the place of its pair's coordinates among those of the pairs that change.
    terms: Vec<(usize, Term)>,
    /// The coordinates of the pairs that change in each known column.
    coordinates: Vec<f64>,
    /// `M`, by columns, and its factor.
    matrix: Vec<f64>,
    factor: Factor,
}

/// The pairs that change.
struct Changed {
    pairs: Vec<usize>,
    /// Where each of their components is among the unknowns, with its unit; `None`: it was no unknown.
    places: Vec<Option<(usize, f64)>>,
    /// Those that were none, and their rows of `K`.
    held: Vec<usize>,
    rows: Vec<f64>,
}

impl Amended {
    /// A system of these equations that is factorised.
    pub fn of(equations: &Equations<'_>, base: System) -> Self {
        let columns = Columns::none(equations.root.len());
        Amended { base, columns, change: None }
    }

    /// The pairs on their pieces.
    pub fn pairs(&self) -> &[Linearised] {
        self.change.as_ref().map_or(self.base.pairs(), |change| &change.pairs)
    }

    fn terms(&self, dim: usize, pairs: &[Linearised]) -> Vec<Term> {
        terms(dim, self.base.pairs(), pairs.iter().copied().enumerate())
    }

    /// Operations of [`Self::go_to`]: a solution for each column that is new, the pairs that change, and `M`. Those of a
    /// solution take twice the time that those of a factorisation take.
    pub fn work(&self, dim: usize, pairs: &[Linearised]) -> f64 {
        let terms = self.terms(dim, pairs);
        let lacking = self.columns.lacking(terms.iter().flat_map(Term::parts)).len() as f64;
        let (size, count) = (self.base.size() as f64, terms.len() as f64);
        4.0 * size * size * lacking + 2.0 * count * count * (size + count)
    }

    /// Goes to the system of pairs on their pieces; `None` if it is singular, or where `goes_on` says no.
    pub fn go_to(
        &mut self,
        equations: &Equations<'_>,
        pairs: Vec<Linearised>,
        goes_on: GoesOn<'_>,
    ) -> Option<()> {
        let terms = self.terms(equations.dim, &pairs);
        // The memory of the change before.
        let before = self.change.take();
        let memory = |change: Change| [change.changed.rows, change.coordinates, change.matrix];
        let [rows, coordinates, matrix] = before.map_or_else(Default::default, memory);
        if terms.is_empty() {
            return Some(());
        }
        let all = usize::MAX;
        self.columns.prepare(&terms, all, goes_on, |components| {
            self.base.unknowns(&equations.change_columns(components))
        })?;
        let changed = self.changed(equations, &terms, rows);
        let placed = |term: Term| {
            let at = changed.pairs.binary_search(&(term.first / equations.dim));
            (equations.dim * at.expect("the pair of a term changes"), term)
        };
        let terms: Vec<(usize, Term)> = terms.into_iter().map(placed).collect();
        let known = self.columns.components();
        let pushes = written(Vec::new(), (changed.held.len(), known.len()), |place, column| {
            let entries = changed.held.iter().map(|&i| equations.change_entry(i, known[place]));
            column.iter_mut().zip(entries).for_each(|(push, entry)| *push = entry);
        });
        let coordinates =
            changed.coordinates(&self.base, self.columns.values(), pushes, coordinates);
        let (count, size) = (terms.len(), changed.places.len());
        let matrix = written(matrix, (count, count), |j, column| {
            let mut z = vec![0.0; size];
            for (place, u) in self.columns.parts(&terms[j].1) {
                let own = &coordinates[size * place..size * (place + 1)];
                z.iter_mut().zip(own).for_each(|(z, own)| *z += u * own);
            }
            let along = terms.iter().map(|(at, row)| row.along(&z[*at..]));
            column.iter_mut().zip(along).for_each(|(entry, along)| *entry = along);
            column[j] += 1.0;
        });
        let fill = |j: usize, entries: &mut [f64]| {
            entries.copy_from_slice(&matrix[count * j..count * (j + 1)]);
        };
        let factor = Factor::new(count, false, SINGULAR, fill, goes_on)?;
        self.change = Some(Change { pairs, changed, terms, coordinates, matrix, factor });
        Some(())
    }

    /// The pairs of terms; their rows are in `memory`.
    fn changed(&self, equations: &Equations<'_>, terms: &[Term], memory: Vec<f64>) -> Changed {
        let dim = equations.dim;
        let mut pairs: Vec<usize> = terms.iter().map(|term| term.first / dim).collect();
        pairs.dedup();
        let components = || pairs.iter().flat_map(|pair| dim * pair..dim * (pair + 1));
        let places: Vec<_> = components().map(|i| self.base.place(i)).collect();
        let held = components().zip(&places).filter(|(_, place)| place.is_none());
        let held: Vec<usize> = held.map(|(i, _)| i).collect();
        let rows = self.base.rows(equations, &held, memory);
        Changed { pairs, places, held, rows }
    }

    /// The displacements of `J⁻¹ b` where the law is linear on each piece.
    pub fn motion(&self, equations: &Equations<'_>, b: &[f64]) -> Vec<f64> {
        let dim = equations.dim;
        let mut x = self.base.unknowns(b);
        let Some(change) = &self.change else { return self.base.displacements(&x) };
        let held = change.changed.held.iter().map(|&i| b[i]).collect();
        let mut y = change.changed.coordinates(&self.base, &x, held, Vec::new());
        let mut along: Vec<f64> =
            change.terms.iter().map(|(at, term)| term.along(&y[*at..])).collect();
        change.factor.solve(&mut along);
        let mut parts = vec![0.0; self.columns.components().len()];
        for ((_, term), along) in change.terms.iter().zip(&along) {
            self.columns.parts(term).for_each(|(place, u)| parts[place] += u * along);
        }
        subtract_columns(&mut x, self.columns.values(), &parts);
        subtract_columns(&mut y, &change.coordinates, &parts);
        let mut dd = self.base.displacements(&x);
        for (&pair, y) in change.changed.pairs.iter().zip(by_pairs(dim, &y)) {
            let moved = change.pairs[pair].moved(&y);
            for (i, moved) in (dim * pair..dim * (pair + 1)).zip(moved) {
                dd[i] = moved / equations.root[i].powi(2);
            }
        }
        dd
    }

    /// `J⁻¹ b`.
    pub fn step(&mut self, equations: &Equations<'_>, b: &[f64]) -> Step {
        if !equations.are_linear() {
            let dy = self.base.solve(equations, b);
            return Step { dy, dd: Vec::new(), product: Vec::new() };
        }
        let dd = self.motion(equations, b);
        equations.step(self.pairs(), b, dd)
    }

    /// Sign of `det J`.
    pub fn sign(&self) -> i8 {
        self.base.orientation() * self.change.as_ref().map_or(1, |change| change.factor.sign)
    }

    /// The variables of a symmetric complementarity problem that were basic in the factorised system, and those that are
    /// since, if their block is positive definite beyond doubt; nothing otherwise, or where `goes_on` says no.
    ///
    /// `M` of the variables that became basic is the Schur complement of the block, in the units of its columns. Solutions
    /// lose the digits by which the pivots of the factorised system are small: the product of both least pivots decides.
    pub fn definite(&self, root: &[f64], goes_on: GoesOn<'_>) -> Vec<bool> {
        let (first, none) = (self.base.least_pivot(), Vec::new());
        if first <= SUSPICIOUS_PIVOT {
            return none;
        }
        let basic = |pairs: &[Linearised]| pairs.iter().map(|pair| pair.moves(0)).collect();
        let before: Vec<bool> = basic(self.base.pairs());
        let Some(change) = &self.change else { return before };
        let now: Vec<bool> = basic(&change.pairs);
        let count = change.terms.len();
        let became_basic: Vec<(usize, f64)> = (change.terms.iter().enumerate())
            .filter(|(_, (_, term))| now[term.first])
            .map(|(k, (_, term))| (k, root[term.first]))
            .collect();
        let fill = |j: usize, column: &mut [f64]| {
            let (own, root) = became_basic[j];
            for (entry, (row, other)) in column[j..].iter_mut().zip(&became_basic[j..]) {
                *entry = change.matrix[row + count * own] * (root / other);
            }
        };
        let schur = Factor::new(became_basic.len(), true, SINGULAR, fill, goes_on);
        if schur.is_none_or(|schur| first * schur.least_pivot <= SUSPICIOUS_PIVOT) {
            return none;
        }
        before.iter().zip(&now).map(|(before, now)| before | now).collect()
    }
}

impl Changed {
    /// The coordinates of the pairs that change, on their pieces of before, for each column of unknowns `x` and of the
    /// right-hand sides `b` of the components that were none; in `memory`.
    fn coordinates(&self, base: &System, x: &[f64], b: Vec<f64>, memory: Vec<f64>) -> Vec<f64> {
        let (dim, size, mut pushes) = (self.places.len() / self.pairs.len(), base.size(), b);
        subtract_product(&mut pushes, &self.rows, x, size);
        let known = x.len().checked_div(size).unwrap_or(pushes.len() / self.held.len().max(1));
        written(memory, (self.places.len(), known), |column, own| {
            let x = &x[size * column..];
            let mut pushes = pushes[self.held.len() * column..].iter();
            for (own, place) in own.iter_mut().zip(&self.places) {
                *own = match place {
                    Some((place, unit)) => x[*place] * unit,
                    None => *pushes.next().expect("one for each that was no unknown"),
                };
            }
            let pairs = self.pairs.iter().zip(own.chunks_exact_mut(dim));
            pairs.for_each(|(&pair, own)| base.pairs()[pair].complete(own));
        })
    }
}
