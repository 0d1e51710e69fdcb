//! A factorised system, and the solution of others that differ from it in few rows.
//!
//! Unknowns are the free components; the others are fixed. With `A` the factorised matrix, a system in
//! which rows have changed is solved by bordering:
//!
//! ```text
//! [ A  B ] [x]   [r]      B: unit columns, which deactivate a row of A,
//! [ C  D ] [y] = [s]         and the columns of components that have become free
//! ```
//!
//! and `C` the equations in their place. `A⁻¹ B` is kept, so that a row that has changed costs one
//! solve in all later systems. The sign of the determinant follows: each unit column changes it.

use crate::law::Row;
use crate::linalg::factor::{Factor, cholesky_work, lu_work, subtract_product};
use crate::linalg::matrix::Matrix;

/// A factorised system.
pub struct Bordered {
    free: Vec<usize>,
    coupling: Vec<f64>,
    /// Position of each unknown in `free`.
    place: Vec<Option<usize>>,
    factor: Factor,
    /// Columns of `A⁻¹ B`, contiguous; the next two have the column of each border that has one.
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
    /// The coupling of its new equation; `None`: it is fixed now.
    coupling: Option<f64>,
}

/// Below so many unknowns a new factorisation is cheaper than borders: measured on the bar on the
/// plane.
const SMALL: usize = 64;

/// Borders are used up to this part of the unknowns: with more of them `A⁻¹ B` costs as much as a new
/// factorisation.
const MOST_BORDERS: f64 = 0.2;

/// The coefficients that all systems share.
pub struct Coefficients<'p> {
    /// `M`.
    pub matrix: Matrix<'p>,
    /// True if `M` is symmetric, as far as rounding goes.
    symmetric: bool,
    /// Components of a group.
    group: usize,
    /// `unit^-1/2` of each component: rows and columns are scaled by it.
    scale: Vec<f64>,
}

impl<'p> Coefficients<'p> {
    /// The coefficients of a matrix whose diagonal is not negative.
    pub fn new(matrix: Matrix<'p>, symmetric: bool, group: usize) -> Self {
        let scale = matrix.units(group).iter().map(|unit| unit.sqrt().recip()).collect();
        Coefficients { matrix, symmetric, group, scale }
    }

    /// The first component of the group of `i`, its normal one.
    fn normal(&self, i: usize) -> usize {
        i - i % self.group
    }

    /// Scaled entry of the equation of `i` with `coupling`.
    fn entry(&self, i: usize, coupling: f64, j: usize) -> f64 {
        let column = self.matrix.column(j);
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
        // M is symmetric: its columns are contiguous, its rows are not.
        let (own, normal) = (self.matrix.column(i), self.matrix.column(self.normal(i)));
        for (row, &j) in row.iter_mut().zip(free) {
            *row = self.scale[i] * (own[j] + coupling * normal[j]) * self.scale[j];
        }
    }

    /// Scaled right-hand side of an active row; zero of an inactive one.
    fn wanted(&self, i: usize, row: Row, residual: &[f64]) -> f64 {
        match row {
            Row::Fixed(_) => 0.0,
            Row::Free { coupling, offset } => {
                -self.scale[i] * (residual[i] + coupling * residual[self.normal(i)] + offset)
            }
        }
    }
}

impl Bordered {
    /// Operations of [`Self::new`].
    pub fn work(coefficients: &Coefficients<'_>, rows: &[Row]) -> f64 {
        let couplings = rows.iter().filter_map(|row| match *row {
            Row::Free { coupling, .. } => Some(coupling),
            Row::Fixed(_) => None,
        });
        let (count, coupled) =
            couplings.fold((0, false), |(n, coupled), c| (n + 1, coupled || c != 0.0));
        match coefficients.symmetric && !coupled {
            true => cholesky_work(count),
            false => lu_work(count),
        }
    }

    /// Factorises the system that `rows` select; `None` if it is singular.
    pub fn new(coefficients: &Coefficients<'_>, rows: &[Row]) -> Option<Self> {
        let mut place = vec![None; rows.len()];
        let (mut free, mut coupling) = (Vec::new(), Vec::new());
        for (i, row) in rows.iter().enumerate() {
            if let Row::Free { coupling: c, .. } = *row {
                place[i] = Some(free.len());
                free.push(i);
                coupling.push(c);
            }
        }
        let coupled: Vec<usize> = (0..free.len()).filter(|&k| coupling[k] != 0.0).collect();
        let symmetric = coefficients.symmetric && coupled.is_empty();
        let scale: Vec<f64> = free.iter().map(|&i| coefficients.scale[i]).collect();
        let factor = Factor::new(free.len(), symmetric, |j, column| {
            let source = coefficients.matrix.column(free[j]);
            let begin = if symmetric { j } else { 0 };
            let rows = free[begin..].iter().zip(&scale[begin..]);
            for (column, (&i, row_scale)) in column[begin..].iter_mut().zip(rows) {
                *column = row_scale * source[i] * scale[j];
            }
            for &k in &coupled {
                column[k] = coefficients.entry(free[k], coupling[k], free[j]);
            }
        })?;
        Some(Bordered {
            solved: Vec::new(),
            column_of_row: vec![None; free.len()],
            column_of_unknown: vec![None; rows.len()],
            free,
            coupling,
            place,
            factor,
        })
    }

    fn borders<'a>(&'a self, rows: &'a [Row]) -> impl Iterator<Item = Border> + 'a {
        rows.iter().enumerate().filter_map(|(unknown, row)| {
            let base = self.place[unknown];
            let coupling = match *row {
                Row::Fixed(_) => None,
                Row::Free { coupling, .. } => Some(coupling),
            };
            (base.map(|k| self.coupling[k]) != coupling).then_some(Border {
                unknown,
                base,
                coupling,
            })
        })
    }

    /// True if few rows have changed.
    pub fn is_near(&self, rows: &[Row]) -> bool {
        let count = self.borders(rows).count();
        let size = self.free.len();
        count == 0 || (size >= SMALL && count as f64 <= MOST_BORDERS * size as f64)
    }

    /// Operations of [`Self::solve`] where few rows have changed: a solution for each border that is new, and what
    /// all borders take from the step.
    pub fn border_work(&self, rows: &[Row]) -> f64 {
        let n = self.free.len() as f64;
        let (mut count, mut fresh) = (0.0, 0.0);
        for border in self.borders(rows) {
            let known = match border.base {
                Some(k) => self.column_of_row[k],
                None => self.column_of_unknown[border.unknown],
            };
            count += 1.0;
            fresh += f64::from(u8::from(known.is_none()));
        }
        2.0 * n * (n * fresh + count * count)
    }

    /// The step that makes the equations hold, and the sign of the determinant.
    pub fn solve(
        &mut self,
        coefficients: &Coefficients<'_>,
        rows: &[Row],
        residual: &[f64],
        step: &mut [f64],
    ) -> Option<i8> {
        let borders: Vec<Border> = self.borders(rows).collect();
        let mut x: Vec<f64> =
            self.free.iter().map(|&i| coefficients.wanted(i, rows[i], residual)).collect();
        for k in borders.iter().filter_map(|border| border.base) {
            x[k] = 0.0;
        }
        self.factor.solve(&mut x);
        step.fill(0.0);
        let mut orientation = self.factor.sign();
        if !borders.is_empty() {
            let wanted: Vec<f64> = borders
                .iter()
                .map(|border| coefficients.wanted(border.unknown, rows[border.unknown], residual))
                .collect();
            let (y, sign) = self.solve_borders(coefficients, &borders, wanted, &mut x)?;
            orientation *= sign;
            for (border, y) in borders.iter().zip(&y).filter(|(border, _)| border.base.is_none()) {
                step[border.unknown] = coefficients.scale[border.unknown] * y;
            }
        }
        for (&i, x) in self.free.iter().zip(&x) {
            if matches!(rows[i], Row::Free { .. }) {
                step[i] = coefficients.scale[i] * x;
            }
        }
        step.iter().all(|step| step.is_finite()).then_some(orientation)
    }

    /// Corrects `x = A⁻¹ r` for the borders, whose right-hand sides are `s`; returns `y`, and the sign by
    /// which the borders change the determinant.
    fn solve_borders(
        &mut self,
        coefficients: &Coefficients<'_>,
        borders: &[Border],
        s: Vec<f64>,
        x: &mut [f64],
    ) -> Option<(Vec<f64>, i8)> {
        let columns = self.solved_columns(coefficients, borders);
        let equations = self.border_equations(coefficients, borders);
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
        let mut schur = Factor::new(count, false, |j, column| {
            column.copy_from_slice(&corner[count * j..count * (j + 1)]);
        })?;
        let mut y = s;
        subtract_product(&mut y, &equations, x, n);
        schur.solve(&mut y);
        for (y, column) in y.iter().zip(columns.chunks_exact(n.max(1))) {
            for (x, column) in x.iter_mut().zip(column) {
                *x -= y * column;
            }
        }
        let replaced = borders.iter().filter(|border| border.base.is_some()).count();
        let sign = if replaced.is_multiple_of(2) { 1 } else { -1 };
        Some((y, schur.sign() * sign))
    }

    /// `A⁻¹ B` for the borders, from what is kept as far as possible.
    fn solved_columns(&mut self, coefficients: &Coefficients<'_>, borders: &[Border]) -> Vec<f64> {
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
        self.factor.solve(&mut self.solved[begin..]);
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
    fn border_equations(&self, coefficients: &Coefficients<'_>, borders: &[Border]) -> Vec<f64> {
        let n = self.free.len();
        let mut equations = vec![0.0; n * borders.len()];
        for (border, row) in borders.iter().zip(equations.chunks_exact_mut(n.max(1))) {
            match (border.coupling, border.base) {
                (Some(coupling), _) => coefficients.row(border.unknown, coupling, &self.free, row),
                (None, Some(k)) => row[k] = 1.0,
                (None, None) => unreachable!("a component that stays fixed is no border"),
            }
        }
        equations
    }
}
