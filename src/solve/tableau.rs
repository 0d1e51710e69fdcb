//! The compact tableau of Lemke's method: basic variables as affine functions of the others.
//!
//! Variables are numbered `0..n` for `w`, `n..2n` for `z`, `2n` for the artificial `z0`; in
//! `w = q + M z + d z0` the `w` are basic first. Column `c` of the tableau is the dependence of the
//! basic variables on nonbasic variable `c`; one more column holds their values. A pivot exchanges
//! one basic and one nonbasic variable: with its column `x`, its row `y` and their common entry `p` the
//! tableau changes by `-(x + e_r) (y - e_c)ᵀ / p`.
//!
//! A tableau beyond the cache is not changed at each pivot: up to [`DELAY`] changes are kept and made
//! together, as one matrix product, which reads the tableau once. In between a pivot needs one column
//! and one row, which the kept changes correct, and the values, which are always up to date.

use super::delayed::Delayed;
use crate::error::Error;
use crate::linalg::dense;
use crate::linalg::kernels::{self, Simd};

/// The problem that a tableau belongs to, scaled so that its entries are of similar size.
pub struct Scaled {
    /// Number of equations.
    pub size: usize,
    /// `M`, column-major, contiguous.
    pub matrix: Vec<f64>,
    /// `q`.
    pub q: Vec<f64>,
    /// `d > 0`.
    pub covering: Vec<f64>,
}

impl Scaled {
    /// Column of `variable` in `w - M z - d z0 = q`, added to `column` times `factor`.
    fn add_column(&self, variable: usize, factor: f64, column: &mut [f64]) {
        let n = self.size;
        if variable < n {
            column[variable] += factor;
        } else {
            let source = match variable - n {
                j if j < n => &self.matrix[j * n..(j + 1) * n],
                _ => &self.covering,
            };
            for (column, entry) in column.iter_mut().zip(source) {
                *column -= factor * entry;
            }
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
    kept: Delayed,
    /// Most changes that are kept.
    delay: usize,
    simd: Simd,
}

/// Changes made together where the tableau is beyond the cache.
const DELAY: usize = 32;

/// Rows from which on that pays.
const LARGE: usize = 160;

/// Coefficients below this part of a column's largest are rounding and block nothing; so are those
/// below this number itself in the column of a `z`, where the data, scaled, are of size one.
const NEGLIGIBLE: f64 = 1e-11;

/// Ratios that agree to this part are a tie, for the lexicographic rule to break.
const TIE: f64 = 1e-11;

/// Values below this part of the largest are zero up to rounding.
const ZERO: f64 = 1e-14;

impl Tableau {
    /// The tableau in which the `w` are basic.
    pub fn new(problem: &Scaled) -> Result<Self, Error> {
        let n = problem.size;
        // Columns begin on different cache sets even when n is a power of two.
        let stride = n.next_multiple_of(8) + 8;
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
            kept: Delayed::new(n, n + 1, simd),
            delay: if n < LARGE { 1 } else { DELAY },
            simd,
        };
        for j in 0..n {
            tableau.column_mut(j).copy_from_slice(&problem.matrix[j * n..(j + 1) * n]);
        }
        tableau.column_mut(n).copy_from_slice(&problem.covering);
        Ok(tableau)
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
        let largest = column.iter().fold(0.0, |most: f64, t| most.max(t.abs()));
        let size = if entering < self.size { largest } else { largest.max(1.0) };
        let least = -NEGLIGIBLE * size;
        let blocking = || (0..self.size).filter(|&row| column[row] < least);
        let ratio = |row: usize| self.values[row].max(0.0) / -column[row];
        let first = blocking().map(ratio).fold(f64::INFINITY, f64::min);
        // The second term ties values that are zero up to rounding; divided by the largest
        // coefficient, it pushes no basic variable below zero by more than that rounding.
        let scale = self.values.iter().fold(0.0, |most: f64, b| most.max(b.abs()));
        let last = first * (1.0 + TIE) + ZERO * scale / largest;
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
            let margin = TIE * first.abs().max(1.0 / largest);
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
        (0..self.size).rev().find(|&row| ratio(row) <= first * (1.0 - TIE)).filter(|_| first < 0.0)
    }

    /// Exchanges the basic variable of `row` with the chosen variable `entering`.
    pub fn pivot(&mut self, row: usize, entering: usize) {
        let c = self.place[entering] - self.size;
        let inverse = 1.0 / self.entering[row];
        let step = self.values[row] * inverse;
        kernels::subtract(&mut self.values, step, &self.entering);
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
        kernels::vectorised(
            self.simd,
            #[inline(always)]
            || {
                for (j, target) in entries.chunks_exact_mut(stride).enumerate() {
                    let share = target[row] * inverse;
                    if share != 0.0 && j != c {
                        kernels::subtract(&mut target[..n], share, column);
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
    pub fn refine(&mut self, problem: &Scaled) -> f64 {
        self.kept.settle(&mut self.entries, self.stride);
        let n = self.size;
        let mut residual = problem.q.clone();
        for row in 0..n {
            problem.add_column(self.basic[row], -self.values[row], &mut residual);
        }
        let mut correction = vec![0.0; n];
        for (k, &residual) in residual.iter().enumerate() {
            match self.place[k] {
                row if row < n => correction[row] += residual,
                place => kernels::subtract(&mut correction, residual, self.column(place - n)),
            }
        }
        for (value, correction) in self.values.iter_mut().zip(&correction) {
            *value += correction;
        }
        let largest = |v: &[f64]| v.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        largest(&residual) / largest(&problem.q)
    }

    /// Computes the tableau anew from the data of `problem`, in the basis it is in. False if that
    /// basis is singular to working precision; the tableau is then unchanged.
    pub fn refactorise(&mut self, problem: &Scaled) -> bool {
        let n = self.size;
        let mut basis = vec![0.0; n * n];
        for (variable, column) in self.basic.iter().zip(basis.chunks_exact_mut(n)) {
            problem.add_column(*variable, 1.0, column);
        }
        let mut fresh = vec![0.0; n * (n + 2)];
        let (dependence, values) = fresh.split_at_mut(n * (n + 1));
        for (variable, column) in self.nonbasic.iter().zip(dependence.chunks_exact_mut(n)) {
            problem.add_column(*variable, -1.0, column);
        }
        values.copy_from_slice(&problem.q);
        if !dense::solve_general(&basis, &mut fresh, n, n + 2) {
            return false;
        }
        let (dependence, values) = fresh.split_at(n * (n + 1));
        for (c, column) in dependence.chunks_exact(n).enumerate() {
            self.column_mut(c).copy_from_slice(column);
        }
        self.values.copy_from_slice(values);
        self.kept.clear();
        true
    }
}
