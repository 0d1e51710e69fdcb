//! The compact tableau of Lemke's method: basic variables as affine functions of the others.
//!
//! Variables are numbered `0..n` for `w`, `n..2n` for `z`, `2n` for the artificial `z0`; in
//! `w = q + M z + d z0` the `w` are basic first. Column `c` of the tableau is the dependence of the
//! basic variables on nonbasic variable `c`; their values stand beside it. A pivot exchanges
//! one basic and one nonbasic variable: with its column `x`, its row `y` and their common entry `p` the
//! tableau changes by `-(x + e_r) (y - e_c)ᵀ / p`.
//!
//! A tableau beyond the cache is not changed at each pivot: up to [`DELAY`] changes are kept and made
//! together, as one matrix product, which reads the tableau once. In between a pivot needs one column
//! and one row, which the kept changes correct, and the values, which are always up to date.

use super::rank_one_updates::RankOneUpdates;
use crate::error::Error;
use crate::linalg::factor::{Factor, subtract_outer};
use crate::linalg::simd::{self, Simd};
use crate::linalg::tolerances::{NEGLIGIBLE, ROUNDING, SINGULAR_BASIS};
use crate::linalg::vector::norm_inf;

/// The entries of an LCP matrix that nobody needs to store a second time: the tableau begins as a copy
/// of it, and reads columns again when it is refined or refactorised.
pub trait Entries {
    /// Writes column `j`.
    fn write_column(&self, j: usize, column: &mut [f64]);
}

/// The problem that a tableau belongs to, scaled so that its entries are of similar size.
pub struct Scaled<'p> {
    /// `M`.
    pub matrix: &'p dyn Entries,
    /// Row and column scales of `M`.
    pub scale: &'p [f64],
    /// `q`, scaled.
    pub q: Vec<f64>,
    /// `d > 0`, scaled.
    pub covering: Vec<f64>,
}

impl Scaled<'_> {
    /// Number of equations.
    pub fn size(&self) -> usize {
        self.q.len()
    }

    /// Writes column `j` of `M`, scaled.
    fn write_column(&self, j: usize, column: &mut [f64]) {
        self.matrix.write_column(j, column);
        for (entry, row_scale) in column.iter_mut().zip(self.scale) {
            *entry = row_scale * *entry * self.scale[j];
        }
    }

    /// Column of `variable` in `w - M z - d z0 = q`, added to `column` times `factor`; `memory` has room
    /// for a column.
    fn add_column(&self, variable: usize, factor: f64, column: &mut [f64], memory: &mut [f64]) {
        let n = self.size();
        match variable {
            i if i < n => column[i] += factor,
            j if j < 2 * n => {
                self.write_column(j - n, memory);
                simd::axpy(column, -factor, memory);
            }
            _ => simd::axpy(column, -factor, &self.covering),
        }
    }
}

/// The tableau in a basis.
pub struct Tableau {
    size: usize,
    stride: usize,
    /// `n + 1` columns, without the changes that are kept.
    entries: Vec<f64>,
    basic: Vec<usize>,
    nonbasic: Vec<usize>,
    /// Of each variable: its row if basic, `n +` its column otherwise.
    place: Vec<usize>,
    /// The column of the entering variable, up to date.
    entering: Vec<f64>,
    values: Vec<f64>,
    kept: RankOneUpdates,
    /// Most changes that are kept.
    delay: usize,
    simd: Simd,
}

/// Changes made together where the tableau is beyond the cache.
const DELAY: usize = 32;

/// Rows from which on that pays.
const LARGE: usize = 160;

/// Columns begin so many entries further than a multiple of a cache line, on different cache sets even
/// where `n` is a power of two: one line.
const LINE: usize = 8;

impl Tableau {
    /// The tableau in which the `w` are basic.
    pub fn new(problem: &Scaled<'_>) -> Result<Self, Error> {
        let n = problem.size();
        let stride = n.next_multiple_of(LINE) + LINE;
        let mut entries = Vec::new();
        entries
            .try_reserve_exact(stride * (n + 1))
            .map_err(|_| Error::OutOfMemory("the tableau of Lemke's method"))?;
        entries.resize(stride * (n + 1), 0.0);
        let simd = Simd::new();
        let mut tableau = Tableau {
            size: n,
            stride,
            entries,
            basic: (0..n).collect(),
            nonbasic: (n..=2 * n).collect(),
            place: (0..n).chain(n..=2 * n).collect(),
            entering: vec![0.0; n],
            values: problem.q.clone(),
            kept: RankOneUpdates::new(n, n + 1, simd),
            delay: if n < LARGE { 1 } else { DELAY },
            simd,
        };
        for j in 0..n {
            problem.write_column(j, tableau.column_mut(j));
        }
        tableau.column_mut(n).copy_from_slice(&problem.covering);
        Ok(tableau)
    }

    /// Whether all entries and values are.
    pub fn is_finite(&self) -> bool {
        norm_inf(&self.entries).is_finite() && norm_inf(&self.values).is_finite()
    }

    fn column(&self, c: usize) -> &[f64] {
        &self.entries[c * self.stride..c * self.stride + self.size]
    }

    fn column_mut(&mut self, c: usize) -> &mut [f64] {
        &mut self.entries[c * self.stride..c * self.stride + self.size]
    }

    /// Value of a variable in the basis.
    pub fn value(&self, variable: usize) -> f64 {
        match self.place[variable] {
            row if row < self.size => self.values[row],
            _ => 0.0,
        }
    }

    /// The basic variable of a row.
    pub fn basic(&self, row: usize) -> usize {
        self.basic[row]
    }

    /// Brings the column of the nonbasic variable `entering` up to date.
    pub fn choose(&mut self, entering: usize) {
        let (n, stride, c) = (self.size, self.stride, self.place[entering] - self.size);
        self.entering.copy_from_slice(&self.entries[c * stride..c * stride + n]);
        self.kept.correct_column(c, &mut self.entering);
    }

    /// Rate of `variable` when the chosen variable `entering` grows.
    pub fn rate(&self, variable: usize, entering: usize) -> f64 {
        match self.place[variable] {
            _ if variable == entering => 1.0,
            row if row < self.size => self.entering[row],
            _ => 0.0,
        }
    }

    /// The row whose basic variable reaches zero first when the chosen variable `entering` grows;
    /// among ties that of `preferred`, then the lexicographic one. `None`: it can grow for ever.
    pub fn blocking_row(&self, entering: usize, preferred: usize) -> Option<usize> {
        let column = &self.entering;
        let largest = norm_inf(column);
        // In the column of a z the data are of size one: smaller coefficients are rounding of those.
        let size = if entering < self.size { largest } else { largest.max(1.0) };
        let least = -NEGLIGIBLE * size;
        let blocking = || (0..self.size).filter(|&row| column[row] < least);
        let ratio = |row: usize| self.values[row].max(0.0) / -column[row];
        let first = blocking().map(ratio).fold(f64::INFINITY, f64::min);
        // The second term ties values that are zero up to rounding; divided by the largest
        // coefficient, it pushes no basic variable below zero by more than that rounding.
        let scale = norm_inf(&self.values);
        let last = first * (1.0 + NEGLIGIBLE) + ROUNDING * scale / largest;
        let mut ties: Vec<usize> = blocking().filter(|&row| ratio(row) <= last).collect();
        if let Some(&row) = ties.iter().find(|&&row| self.basic[row] == preferred) {
            return Some(row);
        }
        // Perturb q by (e, e², …): its coefficients decide, one component after the other.
        let mut component = 0;
        while ties.len() > 1 && component < self.size {
            let key = |row: usize| self.perturbation(row, component) / -column[row];
            let first = ties.iter().map(|&row| key(row)).fold(f64::INFINITY, f64::min);
            // Coefficients of size one, divided as the ratios are: differences below are rounding.
            let margin = NEGLIGIBLE * first.abs().max(1.0 / largest);
            ties.retain(|&row| key(row) <= first + margin);
            component += 1;
        }
        ties.first().copied()
    }

    /// Effect of a unit change of `q[component]` on the basic variable of `row`.
    fn perturbation(&self, row: usize, component: usize) -> f64 {
        match self.place[component] {
            place if place < self.size => f64::from(u8::from(place == row)),
            place => {
                let c = place - self.size;
                self.kept.at(row, c) - self.column(c)[row]
            }
        }
    }

    /// The row that leaves when `z0` enters the first basis: that which makes all values
    /// non-negative, the last of ties as the lexicographic rule has it.
    pub fn first_row(&self) -> Option<usize> {
        let (values, covering) = (&self.values, self.column(self.size));
        let ratio = |row: usize| values[row] / covering[row];
        let first = (0..self.size).map(ratio).fold(0.0, f64::min);
        (0..self.size)
            .rev()
            .find(|&row| ratio(row) <= first * (1.0 - NEGLIGIBLE))
            .filter(|_| first < 0.0)
    }

    /// Exchanges the basic variable of `row` with the chosen variable `entering`.
    pub fn pivot(&mut self, row: usize, entering: usize) {
        let c = self.place[entering] - self.size;
        let inverse = 1.0 / self.entering[row];
        let step = self.values[row] * inverse;
        simd::axpy(&mut self.values, -step, &self.entering);
        self.values[row] = -step;
        if self.delay == 1 {
            self.change(row, c, inverse);
        } else {
            self.keep_change(row, c, inverse);
        }
        let leaving = self.basic[row];
        self.basic[row] = entering;
        self.nonbasic[c] = leaving;
        self.place[entering] = row;
        self.place[leaving] = self.size + c;
    }

    /// Changes the tableau at once.
    fn change(&mut self, row: usize, c: usize, inverse: f64) {
        let (n, stride) = (self.size, self.stride);
        self.entering[row] = 0.0;
        let (entries, column) = (&mut self.entries, &self.entering);
        simd::vectorised(
            self.simd,
            #[inline(always)]
            || {
                for (j, target) in entries.chunks_exact_mut(stride).enumerate() {
                    let share = target[row] * inverse;
                    if share != 0.0 && j != c {
                        simd::axpy(&mut target[..n], -share, column);
                        target[row] = -share;
                    }
                }
            },
        );
        let (entries, column) = (&mut self.entries, &self.entering);
        for (entry, x) in entries[c * stride..c * stride + n].iter_mut().zip(column) {
            *entry = x * inverse;
        }
        entries[c * stride + row] = inverse;
    }

    /// Keeps the change; the tableau follows when there are enough.
    fn keep_change(&mut self, row: usize, c: usize, inverse: f64) {
        let mut y: Vec<f64> = (0..=self.size).map(|j| self.column(j)[row]).collect();
        self.kept.correct_row(row, &mut y);
        y[c] -= 1.0;
        let at_row = |i: usize| if i == row { 1.0 } else { 0.0 };
        let x = self.entering.iter().enumerate().map(|(i, x)| x * inverse + at_row(i) * inverse);
        self.kept.push(x, &y);
        if self.kept.count() == self.delay {
            self.kept.settle(&mut self.entries, self.stride);
        }
    }

    /// Corrects the values by one step of iterative refinement on the data of `problem`, with the
    /// tableau itself as the inverse of the basis. Returns the residual of `w - M z - d z0 = q`
    /// before, relative to `q`.
    pub fn refine(&mut self, problem: &Scaled<'_>) -> f64 {
        self.kept.settle(&mut self.entries, self.stride);
        let n = self.size;
        let mut memory = vec![0.0; n];
        let mut residual = problem.q.clone();
        for row in 0..n {
            problem.add_column(self.basic[row], -self.values[row], &mut residual, &mut memory);
        }
        let mut correction = vec![0.0; n];
        for (k, &residual) in residual.iter().enumerate() {
            match self.place[k] {
                row if row < n => correction[row] += residual,
                place => simd::axpy(&mut correction, -residual, self.column(place - n)),
            }
        }
        for (value, correction) in self.values.iter_mut().zip(&correction) {
            *value += correction;
        }
        norm_inf(&residual) / norm_inf(&problem.q)
    }

    /// Recomputes the tableau from the data of `problem`, in the basis it is in. False if that basis is
    /// singular to working precision; the tableau is then unchanged.
    ///
    /// The equations whose `w` is not basic give the basic `z` and `z0`, as many; the others follow.
    /// Only the square system of these is factorised, beside the tableau itself.
    pub fn refactorise(&mut self, problem: &Scaled<'_>) -> bool {
        let n = self.size;
        // Rows of the tableau with a basic z or z0, and equations whose w is not basic.
        let rows: Vec<usize> = (0..n).filter(|&row| self.basic[row] >= n).collect();
        let equations: Vec<usize> = (0..n).filter(|&i| self.place[i] >= n).collect();
        let factor = Factor::with_least_pivot(rows.len(), false, SINGULAR_BASIS, |c, column| {
            let (mut whole, mut memory) = (vec![0.0; n], vec![0.0; n]);
            problem.add_column(self.basic[rows[c]], 1.0, &mut whole, &mut memory);
            for (entry, &equation) in column.iter_mut().zip(&equations) {
                *entry = whole[equation];
            }
        });
        let Some(mut factor) = factor else { return false };
        self.kept.clear();
        for first in (0..n + 2).step_by(PANEL) {
            let columns: Vec<usize> = (first..(first + PANEL).min(n + 2)).collect();
            let solutions = self.solve_panel(problem, &mut factor, &columns, &equations);
            self.write_panel(problem, &columns, &solutions, &rows);
        }
        true
    }

    /// Right-hand side of the system of the basis for column `c` of the tableau, `q` for the values
    /// behind the last one.
    fn write_right_side(&self, problem: &Scaled<'_>, c: usize, side: &mut [f64]) {
        if c > self.size {
            side.copy_from_slice(&problem.q);
            return;
        }
        side.fill(0.0);
        problem.add_column(self.nonbasic[c], -1.0, side, &mut vec![0.0; side.len()]);
    }

    /// Writes the right-hand sides into the columns, equation by equation into the row of its `w`, and
    /// returns the solutions of the square system, column by column.
    fn solve_panel(
        &mut self,
        problem: &Scaled<'_>,
        factor: &mut Factor,
        columns: &[usize],
        equations: &[usize],
    ) -> Vec<f64> {
        let n = self.size;
        let mut side = vec![0.0; n];
        let mut solutions = Vec::with_capacity(equations.len() * columns.len());
        for &c in columns {
            self.write_right_side(problem, c, &mut side);
            solutions.extend(equations.iter().map(|&i| side[i]));
            for (i, &value) in side.iter().enumerate() {
                let row = self.place[i];
                if row < n {
                    self.target(c)[row] = value;
                }
            }
        }
        factor.solve(&mut solutions);
        solutions
    }

    /// Subtracts from the rows of basic `w` what the basic `z` and `z0` in `rows` contribute, and puts
    /// these in their rows.
    fn write_panel(
        &mut self,
        problem: &Scaled<'_>,
        columns: &[usize],
        solutions: &[f64],
        rows: &[usize],
    ) {
        let (n, count) = (self.size, rows.len());
        let mut memory = vec![0.0; n];
        for first in (0..count).step_by(PANEL) {
            let part = first..(first + PANEL).min(count);
            let mut x = vec![0.0; n * part.len()];
            for (&row, x) in rows[part.clone()].iter().zip(x.chunks_exact_mut(n)) {
                let mut column = vec![0.0; n];
                problem.add_column(self.basic[row], 1.0, &mut column, &mut memory);
                for (i, value) in column.into_iter().enumerate() {
                    if self.place[i] < n {
                        x[self.place[i]] = value;
                    }
                }
            }
            let y: Vec<f64> = part
                .flat_map(|k| solutions.chunks_exact(count).map(move |solution| solution[k]))
                .collect();
            self.subtract(columns, &x, &y);
        }
        for (&c, solution) in columns.iter().zip(solutions.chunks_exact(count.max(1))) {
            for (&row, value) in rows.iter().zip(solution) {
                self.target(c)[row] = *value;
            }
        }
    }

    /// Subtracts `sum x_k y_kᵀ` from consecutive columns, the values among them.
    fn subtract(&mut self, columns: &[usize], x: &[f64], y: &[f64]) {
        let (n, stride, count) = (self.size, self.stride, columns.len());
        let stored = columns.iter().filter(|&&c| c <= n).count();
        if stored == count {
            let target = &mut self.entries[columns[0] * stride..];
            subtract_outer(target, (n, count), stride, x, y);
            return;
        }
        for (x, y) in x.chunks_exact(n).zip(y.chunks_exact(count)) {
            for (&c, &y) in columns.iter().zip(y) {
                simd::axpy(self.target(c), -y, x);
            }
        }
    }

    /// Column `c`, the values behind the last one.
    fn target(&mut self, c: usize) -> &mut [f64] {
        if c > self.size { &mut self.values } else { self.column_mut(c) }
    }
}

/// Columns that are recomputed together: a block of them stays in the cache.
const PANEL: usize = 64;
