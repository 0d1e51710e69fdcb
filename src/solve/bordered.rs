//! A factorised system, and the solution of others that differ from it in few rows.
//!
//! Unknowns are the free components; the others are held. With `A` the factorised matrix, a system in
//! which rows have changed is solved by bordering:
//!
//! ```text
//! [ A  B ] [x]   [r]      B: unit columns, which take a row of A out of force,
//! [ C  D ] [y] = [s]         and the columns of components that have become free
//! ```
//!
//! and `C` the equations in their place. `A⁻¹ B` is kept, so that a row that has changed costs one
//! solve in all later systems. The sign of the determinant follows: each unit column changes it.

use super::pieces::Row;
use crate::linalg::direct::{Direct, subtract_product};
use crate::problem::ContactProblem;

/// A factorised system.
pub struct Bordered {
    free: Vec<usize>,
    coupling: Vec<f64>,
    /// Of each unknown: where it is in `free`.
    place: Vec<Option<usize>>,
    direct: Direct,
    /// Columns of `A⁻¹ B`, contiguous, and of each border that has one where it is.
    solved: Vec<f64>,
    column_of_row: Vec<Option<usize>>,
    column_of_unknown: Vec<Option<usize>>,
}

/// A change since the system was factorised.
#[derive(Clone, Copy)]
struct Border {
    unknown: usize,
    /// Its row in the factorised system, if it has one.
    base: Option<usize>,
    /// The coupling of its new equation; `None`: it is held now.
    coupling: Option<f64>,
}

/// Below so many unknowns a new factorisation is cheaper than borders.
const SMALL: usize = 64;

/// Borders are used up to this part of the unknowns.
const MOST_BORDERS: f64 = 0.2;

/// What the systems are made of.
pub struct Coefficients<'a, 'p> {
    /// `K`.
    pub problem: &'a ContactProblem<'p>,
    /// Whether it is symmetric, as far as rounding goes.
    pub symmetric: bool,
    /// Rows and columns are scaled by this.
    pub scale: &'a [f64],
}

impl Coefficients<'_, '_> {
    /// The normal component of the pair of `i`.
    fn normal(&self, i: usize) -> usize {
        i - i % self.problem.dim()
    }

    /// Scaled entry of the equation of `i` with `coupling`.
    fn entry(&self, i: usize, coupling: f64, j: usize) -> f64 {
        let column = self.problem.column(j);
        let coupled = if coupling == 0.0 { 0.0 } else { coupling * column[self.normal(i)] };
        self.scale[i] * (column[i] + coupled) * self.scale[j]
    }

    /// Scaled equation of `i` over the unknowns `free`.
    fn row(&self, i: usize, coupling: f64, free: &[usize], row: &mut [f64]) {
        if !self.symmetric {
            for (row, &j) in row.iter_mut().zip(free) {
                *row = self.entry(i, coupling, j);
            }
            return;
        }
        // K is symmetric: its columns are contiguous, its rows are not.
        let (own, normal) = (self.problem.column(i), self.problem.column(self.normal(i)));
        for (row, &j) in row.iter_mut().zip(free) {
            *row = self.scale[i] * (own[j] + coupling * normal[j]) * self.scale[j];
        }
    }
}

impl Bordered {
    /// Factorises the system that `rows` select; `None` if it is singular.
    pub fn new(coefficients: &Coefficients<'_, '_>, rows: &[Row]) -> Option<Self> {
        let mut place = vec![None; rows.len()];
        let (mut free, mut coupling) = (Vec::new(), Vec::new());
        for (i, row) in rows.iter().enumerate() {
            if let Row::Free { coupling: c, .. } = *row {
                place[i] = Some(free.len());
                free.push(i);
                coupling.push(c);
            }
        }
        let symmetric = coefficients.symmetric && coupling.iter().all(|&c| c == 0.0);
        let direct = Direct::new(free.len(), symmetric, |j, column| {
            let begin = if symmetric { j } else { 0 };
            for (k, column) in column.iter_mut().enumerate().skip(begin) {
                *column = coefficients.entry(free[k], coupling[k], free[j]);
            }
        })?;
        Some(Bordered {
            solved: Vec::new(),
            column_of_row: vec![None; free.len()],
            column_of_unknown: vec![None; rows.len()],
            free,
            coupling,
            place,
            direct,
        })
    }

    fn borders<'a>(&'a self, rows: &'a [Row]) -> impl Iterator<Item = Border> + 'a {
        rows.iter().enumerate().filter_map(|(unknown, row)| {
            let base = self.place[unknown];
            let coupling = match *row {
                Row::Held(_) => None,
                Row::Free { coupling, .. } => Some(coupling),
            };
            (base.map(|k| self.coupling[k]) != coupling).then_some(Border {
                unknown,
                base,
                coupling,
            })
        })
    }

    /// Whether few rows have changed.
    pub fn is_near(&self, rows: &[Row]) -> bool {
        let count = self.borders(rows).count();
        let size = self.free.len();
        count == 0 || (size >= SMALL && count as f64 <= MOST_BORDERS * size as f64)
    }

    /// The step that makes the equations hold, and the sign of the determinant.
    pub fn solve(
        &mut self,
        coefficients: &Coefficients<'_, '_>,
        rows: &[Row],
        force: &[f64],
    ) -> Option<(Vec<f64>, i8)> {
        // What is asked of a row in force, scaled; zero of one that is not.
        let wanted = |i: usize| match rows[i] {
            Row::Held(_) => 0.0,
            Row::Free { coupling, offset } => {
                -coefficients.scale[i]
                    * (force[i] + coupling * force[coefficients.normal(i)] + offset)
            }
        };
        let borders: Vec<Border> = self.borders(rows).collect();
        let mut x: Vec<f64> = self.free.iter().map(|&i| wanted(i)).collect();
        for k in borders.iter().filter_map(|border| border.base) {
            x[k] = 0.0;
        }
        self.direct.solve(&mut x);
        let mut step = vec![0.0; rows.len()];
        let mut orientation = self.direct.sign();
        if !borders.is_empty() {
            let columns = self.solved_columns(coefficients, &borders);
            let equations = self.border_equations(coefficients, &borders);
            let (n, count) = (self.free.len(), borders.len());
            let mut corner = vec![0.0; count * count];
            for (c, column) in borders.iter().enumerate().filter(|(_, b)| b.base.is_none()) {
                for (r, row) in borders.iter().enumerate() {
                    if let Some(coupling) = row.coupling {
                        corner[r + count * c] =
                            coefficients.entry(row.unknown, coupling, column.unknown);
                    }
                }
            }
            subtract_product(&mut corner, &equations, &columns, n);
            let schur = Direct::new(count, false, |j, column| {
                column.copy_from_slice(&corner[count * j..count * (j + 1)]);
            })?;
            let mut y: Vec<f64> = borders.iter().map(|border| wanted(border.unknown)).collect();
            subtract_product(&mut y, &equations, &x, n);
            schur.solve(&mut y);
            for (y, column) in y.iter().zip(columns.chunks_exact(n.max(1))) {
                for (x, column) in x.iter_mut().zip(column) {
                    *x -= y * column;
                }
            }
            let replaced = borders.iter().filter(|border| border.base.is_some()).count();
            orientation *= schur.sign() * if replaced % 2 == 0 { 1 } else { -1 };
            for (border, y) in borders.iter().zip(&y).filter(|(border, _)| border.base.is_none()) {
                step[border.unknown] = coefficients.scale[border.unknown] * y;
            }
        }
        for (&i, x) in self.free.iter().zip(&x) {
            if matches!(rows[i], Row::Free { .. }) {
                step[i] = coefficients.scale[i] * x;
            }
        }
        step.iter().all(|step| step.is_finite()).then_some((step, orientation))
    }

    /// `A⁻¹ B` for the borders, from what is kept as far as possible.
    fn solved_columns(
        &mut self,
        coefficients: &Coefficients<'_, '_>,
        borders: &[Border],
    ) -> Vec<f64> {
        let n = self.free.len();
        let begin = self.solved.len();
        let mut count = begin.checked_div(n).unwrap_or(0);
        for border in borders {
            let known = match border.base {
                Some(k) => &mut self.column_of_row[k],
                None => &mut self.column_of_unknown[border.unknown],
            };
            if known.is_some() {
                continue;
            }
            *known = Some(count);
            count += 1;
            self.solved.resize(n * count, 0.0);
            let column = &mut self.solved[n * (count - 1)..];
            match border.base {
                Some(k) => column[k] = 1.0,
                None => {
                    for ((column, &i), &coupling) in
                        column.iter_mut().zip(&self.free).zip(&self.coupling)
                    {
                        *column = coefficients.entry(i, coupling, border.unknown);
                    }
                }
            }
        }
        self.direct.solve(&mut self.solved[begin..]);
        let mut columns = Vec::with_capacity(n * borders.len());
        for border in borders {
            let place = match border.base {
                Some(k) => self.column_of_row[k],
                None => self.column_of_unknown[border.unknown],
            };
            let begin = n * place.expect("it was solved above");
            columns.extend_from_slice(&self.solved[begin..begin + n]);
        }
        columns
    }

    /// `C`, its rows contiguous.
    fn border_equations(
        &self,
        coefficients: &Coefficients<'_, '_>,
        borders: &[Border],
    ) -> Vec<f64> {
        let n = self.free.len();
        let mut equations = vec![0.0; n * borders.len()];
        for (border, row) in borders.iter().zip(equations.chunks_exact_mut(n.max(1))) {
            match (border.coupling, border.base) {
                (Some(coupling), _) => coefficients.row(border.unknown, coupling, &self.free, row),
                (None, Some(k)) => row[k] = 1.0,
                (None, None) => unreachable!("a held component that was held is no border"),
            }
        }
        equations
    }
}
