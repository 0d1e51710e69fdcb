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
use super::scaled::Scaled;
use crate::error::Error;
use crate::linalg::columns::LINE;
use crate::linalg::simd;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;
use crate::linalg::watched::BLOCK;
use crate::monitor::Watch;
use crate::solve::result::Ending;

/// The tableau in a basis.
pub struct Tableau {
    pub(super) size: usize,
    pub(super) stride: usize,
    /// `n + 1` columns, without the changes that are kept.
    pub(super) entries: Vec<f64>,
    pub(super) basic: Vec<usize>,
    pub(super) nonbasic: Vec<usize>,
    /// The place of each variable: its row if basic, `n +` its column otherwise.
    pub(super) place: Vec<usize>,
    /// The column of the entering variable, up to date.
    entering: Vec<f64>,
    pub(super) values: Vec<f64>,
    pub(super) kept: RankOneUpdates,
    /// Most changes that are kept.
    delay: usize,
}

/// Changes made together where the tableau is beyond the cache: as many as let the product do some
/// thirty operations for each number that it reads, and no more than the correction of one row and one
/// column at each pivot can bear.
const DELAY: usize = 32;

/// Rows from which on that pays: 160 make a tableau of 200 kB, which fills the second-level cache of
/// common processors.
const LARGE: usize = 160;

/// Operations that take as long as writing an entry of new memory, which the system clears page by page; reading one
/// takes half of that.
pub(super) const MEMORY: f64 = 100.0;

impl Tableau {
    /// The tableau in which the `w` are basic. `Err`: there is no time or no memory for it, or its numbers are none.
    pub fn new(problem: &Scaled<'_>, monitor: &dyn Watch) -> Result<Self, Ending> {
        let n = problem.size();
        monitor.affords(MEMORY * (n as f64).powi(2))?;
        // Columns begin one line of the cache further, on different cache sets even where `n` is a power of two.
        let stride = n.next_multiple_of(LINE) + LINE;
        let mut entries = Vec::new();
        entries
            .try_reserve_exact(stride * (n + 1))
            .map_err(|_| Error::OutOfMemory("the tableau of Lemke's method"))?;
        for j in 0..n {
            if j % BLOCK == 0 {
                monitor.goes_on()?;
            }
            // New memory is cleared where it is written next.
            entries.resize(stride * (j + 1), 0.0);
            problem.write_column(j, &mut entries[stride * j..stride * j + n]);
        }
        entries.extend_from_slice(&problem.covering);
        entries.resize(stride * (n + 1), 0.0);
        let are_finite = norm_inf(&entries).is_finite() && norm_inf(&problem.q).is_finite();
        if !are_finite || problem.covering.contains(&0.0) {
            return Err(Ending::Stalled("numbers overflow or underflow in the LCP"));
        }
        let delay = if n < LARGE { 1 } else { DELAY };
        Ok(Tableau {
            size: n,
            stride,
            entries,
            basic: (0..n).collect(),
            nonbasic: (n..=2 * n).collect(),
            place: (0..n).chain(n..=2 * n).collect(),
            entering: vec![0.0; n],
            values: problem.q.clone(),
            kept: RankOneUpdates::new(n, n + 1, if delay == 1 { 0 } else { delay }),
            delay,
        })
    }

    pub(super) fn column(&self, c: usize) -> &[f64] {
        &self.entries[c * self.stride..c * self.stride + self.size]
    }

    pub(super) fn column_mut(&mut self, c: usize) -> &mut [f64] {
        &mut self.entries[c * self.stride..c * self.stride + self.size]
    }

    /// Value of a variable in the basis.
    pub fn value(&self, variable: usize) -> f64 {
        match self.place[variable] {
            row if row < self.size => self.values[row],
            _ => 0.0,
        }
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

    /// The rows whose basic variables reach zero first when the chosen variable `entering` grows, as far as
    /// ratios and values can be told apart. None: it can grow for ever.
    fn ties(&self, entering: usize) -> Vec<usize> {
        let column = &self.entering;
        let largest = norm_inf(column);
        // In the column of a z the data are of size one: smaller coefficients are rounding of those.
        let size = if entering < self.size { largest } else { largest.max(1.0) };
        let least = -NEGLIGIBLE * size;
        let blocking = || (0..self.size).filter(|&row| column[row] < least);
        let ratio = |row: usize| self.values[row].max(0.0) / -column[row];
        let first = blocking().map(ratio).fold(f64::INFINITY, f64::min);
        // The second term ties values that are zero up to the rounding of the pivots before; divided by the largest
        // coefficient, it pushes no basic variable below zero by more than that rounding.
        let scale = norm_inf(&self.values);
        let last = first * (1.0 + NEGLIGIBLE) + NEGLIGIBLE * scale / largest;
        blocking().filter(|&row| ratio(row) <= last).collect()
    }

    /// The row whose basic variable reaches zero first when the chosen variable `entering` grows;
    /// among ties that of `preferred`, then the lexicographic one. `None`: it can grow for ever.
    pub fn blocking_row(&self, entering: usize, preferred: [usize; 2]) -> Option<usize> {
        let (column, largest) = (&self.entering, norm_inf(&self.entering));
        let mut ties = self.ties(entering);
        if let Some(&row) = ties.iter().find(|&&row| preferred.contains(&self.basic[row])) {
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

    /// The row whose value comes to zero last when the chosen variable grows, so that all that grow with it are
    /// non-negative: of ties the last one, as the lexicographic rule has it. `None`: none of these is negative.
    pub fn last_to_rise(&self) -> Option<usize> {
        let ratio = |row: usize| self.values[row] / self.entering[row];
        let rising = || (0..self.size).filter(|&row| self.entering[row] > 0.0);
        let first = rising().map(ratio).fold(0.0, f64::min);
        rising().rev().find(|&row| ratio(row) <= first * (1.0 - NEGLIGIBLE)).filter(|_| first < 0.0)
    }

    /// Operations of the next [`Self::pivot`]: those of the changes that it makes in the tableau.
    pub fn pivot_work(&self) -> f64 {
        let made = self.delay == 1 || self.kept.count() + 1 == self.delay;
        if made { 2.0 * self.delay as f64 * (self.size as f64).powi(2) } else { 0.0 }
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
}
