//! How the tableau of Lemke's method is kept on its data: its values refined, or the whole of it
//! recomputed in its basis.

use std::ops::Range;

use super::scaled::Scaled;
use super::tableau::{MEMORY, Tableau};
use crate::linalg::dense::subtract_outer;
use crate::linalg::factor::{Factor, lu_work};
use crate::linalg::simd;
use crate::linalg::tolerances::SINGULAR_BASIS;
use crate::linalg::vector::norm_inf;
use crate::linalg::watched::{BLOCK, GoesOn};

impl Tableau {
    /// Operations in whose time [`Self::refine`] reads the data and the tableau, and makes the changes that are kept.
    pub fn refinement_work(&self) -> f64 {
        (MEMORY / 2.0 + 2.0 * self.kept.count() as f64) * (self.size as f64).powi(2)
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

    /// Operations of [`Self::refactorise`]: a factorisation of as many rows as there are basic `z`, and for each
    /// column a solution and a product.
    pub fn refactorisation_work(&self) -> f64 {
        let n = self.size;
        let count = self.basic.iter().filter(|&&basic| basic >= n).count();
        lu_work(count) + 2.0 * (n as f64) * (count as f64) * (n as f64)
    }

    /// Recomputes the tableau from the data of `problem`, in the basis it is in. `None` if that basis is
    /// singular to working precision, or where `goes_on` says no: only the values are then of use.
    ///
    /// The equations whose `w` is not basic give the basic `z` and `z0`, as many; the others follow.
    /// Only the square system of these is factorised, beside the tableau itself.
    pub fn refactorise(&mut self, problem: &Scaled<'_>, goes_on: GoesOn<'_>) -> Option<()> {
        let n = self.size;
        // Rows of the tableau with a basic z or z0, and equations whose w is not basic.
        let rows: Vec<usize> = (0..n).filter(|&row| self.basic[row] >= n).collect();
        let equations: Vec<usize> = (0..n).filter(|&i| self.place[i] >= n).collect();
        let fill = |c: usize, column: &mut [f64]| {
            let (mut whole, mut memory) = (vec![0.0; n], vec![0.0; n]);
            problem.add_column(self.basic[rows[c]], 1.0, &mut whole, &mut memory);
            for (entry, &equation) in column.iter_mut().zip(&equations) {
                *entry = whole[equation];
            }
        };
        let mut factor = Factor::new(rows.len(), false, SINGULAR_BASIS, fill, goes_on)?;
        self.kept.clear();
        for first in (0..=n).step_by(BLOCK) {
            if !goes_on() {
                return None;
            }
            let columns = first..(first + BLOCK).min(n + 1);
            let solutions = self.solve_panel(problem, &mut factor, columns.clone(), &equations);
            self.write_panel(problem, columns, &solutions, &rows);
        }
        // The values by two steps of refinement, which leave the rounding of one.
        self.values.fill(0.0);
        for _ in 0..2 {
            if !goes_on() {
                return None;
            }
            self.refine(problem);
        }
        Some(())
    }

    /// Writes the right-hand sides into the columns, equation by equation into the row of its `w`, and
    /// returns the solutions of the square system, column by column.
    fn solve_panel(
        &mut self,
        problem: &Scaled<'_>,
        factor: &mut Factor,
        columns: Range<usize>,
        equations: &[usize],
    ) -> Vec<f64> {
        let n = self.size;
        let (mut side, mut memory) = (vec![0.0; n], vec![0.0; n]);
        let mut solutions = Vec::with_capacity(equations.len() * columns.len());
        for c in columns {
            side.fill(0.0);
            problem.add_column(self.nonbasic[c], -1.0, &mut side, &mut memory);
            solutions.extend(equations.iter().map(|&i| side[i]));
            for (i, &value) in side.iter().enumerate() {
                let row = self.place[i];
                if row < n {
                    self.column_mut(c)[row] = value;
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
        columns: Range<usize>,
        solutions: &[f64],
        rows: &[usize],
    ) {
        let (n, count) = (self.size, rows.len());
        let mut memory = vec![0.0; n];
        for first in (0..count).step_by(BLOCK) {
            let part = first..(first + BLOCK).min(count);
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
            let target = &mut self.entries[columns.start * self.stride..];
            subtract_outer(target, (n, columns.len()), self.stride, &x, &y);
        }
        for (c, solution) in columns.zip(solutions.chunks_exact(count.max(1))) {
            for (&row, value) in rows.iter().zip(solution) {
                self.column_mut(c)[row] = *value;
            }
        }
    }
}
