//! The lexicographic ratio where double precision cannot tell ties: on the data, in twice the precision.
//!
//! A row of the inverse of the basis has all that the rule reads of a basic variable: its product with `q` is
//! the value, that with the entering column the rate, and its entries are the coefficients of the perturbation
//! `(e, e², …)` of `q`. The tableau gives the row to about 1e-10; residuals in twice the precision refine it
//! to some 1e-26. What then still ties is equal.

use super::scaled::Scaled;
use super::tableau::Tableau;
use crate::linalg::double_double::{DoubleDouble, dot};
use crate::linalg::vector::{self, norm_inf};

/// Relative differences below are zero: a hundred times the residual of a refined row, well above what refined rows leave, `1e-32` times the condition
/// number of the basis and the number of terms, and below those of numbers that are not built to be close.
const EQUAL: f64 = 1e-24;

/// Steps of refinement: each gains the digits that the tableau has right, at least four of 26.
const STEPS: usize = 8;

/// A row of the inverse of the basis, `high + low`, and what it tells of its basic variable.
struct Row {
    row: usize,
    high: Vec<f64>,
    low: Vec<f64>,
    /// How fast the variable falls: positive if it blocks.
    fall: DoubleDouble,
    value: DoubleDouble,
    /// Largest entry.
    size: f64,
}

impl Row {
    fn dot(&self, column: &[f64]) -> DoubleDouble {
        dot(&self.high, column).plus(dot(&self.low, column))
    }

    fn entry(&self, i: usize) -> DoubleDouble {
        DoubleDouble::sum(self.high[i], self.low[i])
    }
}

impl Tableau {
    /// The row among `ties`, rows whose ratios are close, whose basic variable reaches zero first when
    /// `entering` grows; of equal ones that of `preferred`, then the lexicographic one. `None` if the
    /// tableau is too far from its data to decide.
    pub fn first_of_ties(
        &mut self,
        problem: &Scaled<'_>,
        entering: usize,
        preferred: usize,
        ties: &[usize],
    ) -> Option<usize> {
        let mut rows = self.inverse_rows(problem, ties)?;
        let n = problem.size();
        let mut column = vec![0.0; n];
        problem.add_column(entering, 1.0, &mut column, &mut vec![0.0; n]);
        for row in &mut rows {
            (row.fall, row.value) = (row.dot(&column), row.dot(&problem.q));
        }
        let width = n as f64 * norm_inf(&column);
        rows.retain(|row| row.fall.parts().0 > EQUAL * width * row.size);
        keep_least(&mut rows, n as f64 * norm_inf(&problem.q), |row| row.value);
        if let Some(row) = rows.iter().find(|row| self.basic[row.row] == preferred) {
            return Some(row.row);
        }
        let mut component = 0;
        while rows.len() > 1 && component < n {
            keep_least(&mut rows, 1.0, |row| row.entry(component));
            component += 1;
        }
        rows.first().map(|row| row.row)
    }

    /// Rows of the inverse of the basis, refined; `None` if that does not converge.
    fn inverse_rows(&mut self, problem: &Scaled<'_>, rows: &[usize]) -> Option<Vec<Row>> {
        let n = self.size;
        self.kept.settle(&mut self.entries, self.stride);
        let zero = DoubleDouble::default();
        let begin = |&row: &usize| {
            let mut unit = vec![0.0; n];
            unit[row] = 1.0;
            let (high, low) = (self.times_inverse(&unit), vec![0.0; n]);
            Row { row, high, low, fall: zero, value: zero, size: 1.0 }
        };
        let mut refined: Vec<Row> = rows.iter().map(begin).collect();
        for _ in 0..STEPS {
            let residuals = self.residuals(problem, &refined);
            let (mut done, refined_to) = (true, EQUAL / 100.0);
            for (row, residual) in refined.iter_mut().zip(&residuals) {
                row.size = norm_inf(&row.high);
                done &= norm_inf(residual) <= refined_to * row.size;
                let correction = self.times_inverse(residual);
                for (i, correction) in correction.into_iter().enumerate() {
                    let sum = row.entry(i).plus(DoubleDouble::sum(correction, 0.0));
                    (row.high[i], row.low[i]) = sum.parts();
                }
            }
            if done {
                return Some(refined);
            }
        }
        None
    }

    /// The residuals of rows of the inverse: unit vectors less their products with the basis.
    fn residuals(&self, problem: &Scaled<'_>, rows: &[Row]) -> Vec<Vec<f64>> {
        let n = self.size;
        let mut memory = vec![0.0; n];
        let mut residuals = vec![vec![0.0; n]; rows.len()];
        for k in 0..n {
            let mut column = vec![0.0; n];
            problem.add_column(self.basic[k], 1.0, &mut column, &mut memory);
            for (row, residual) in rows.iter().zip(&mut residuals) {
                let unit = if row.row == k { 1.0 } else { 0.0 };
                let product = match self.basic[k] {
                    i if i < n => row.entry(i),
                    _ => row.dot(&column),
                };
                residual[k] = DoubleDouble::sum(unit, 0.0).plus(product.negated()).parts().0;
            }
        }
        residuals
    }

    /// A row times the inverse of the basis, as the tableau has it.
    fn times_inverse(&self, row: &[f64]) -> Vec<f64> {
        let n = self.size;
        let entry = |i: usize| match self.place[i] {
            place if place < n => row[place],
            place => -vector::dot(self.column(place - n), row),
        };
        (0..n).map(entry).collect()
    }
}

/// Keeps the rows in which `key / fall` is least; keys are of the size `unit` times that of the row.
fn keep_least(rows: &mut Vec<Row>, unit: f64, key: impl Fn(&Row) -> DoubleDouble) {
    // The sign of a's ratio less b's, and 0 where they are equal.
    let order = |a: &Row, b: &Row| {
        let (one, other) = (key(a).times(b.fall), key(b).times(a.fall));
        let difference = one.plus(other.negated()).parts().0;
        let weight = |a: &Row, b: &Row| a.size * b.fall.parts().0;
        let negligible = EQUAL * unit * (weight(a, b) + weight(b, a));
        if difference.abs() <= negligible { 0.0 } else { difference }
    };
    let least = (1..rows.len())
        .fold(0, |least, i| if order(&rows[i], &rows[least]) < 0.0 { i } else { least });
    let keeps: Vec<bool> = rows.iter().map(|row| order(row, &rows[least]) <= 0.0).collect();
    let mut keeps = keeps.into_iter();
    rows.retain(|_| keeps.next().unwrap_or(false));
}
