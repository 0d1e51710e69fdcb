//! The change of variables `u = T x + u_0`, row by row, and what it makes of a matrix.

use super::sparse_matrix::LowerTriangle;
use crate::linalg::sparse::Lower;

/// One row of `T`: coefficients of unknowns, and of fixed degrees of freedom.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    pub(super) unknowns: Vec<(usize, f64)>,
    pub(super) fixed: Vec<(usize, f64)>,
}

impl Row {
    pub(super) fn value(&self, x: &[f64], prescribed: Option<&[f64]>) -> f64 {
        let unknowns: f64 = self.unknowns.iter().map(|&(k, c)| c * x[k]).sum();
        let fixed =
            prescribed.map_or(0.0, |values| self.fixed.iter().map(|&(k, c)| c * values[k]).sum());
        unknowns + fixed
    }
}

/// The lower triangle of `Tᵀ K T`; held components become decoupled rows with the diagonal of the
/// largest entry.
pub(super) fn transform(
    host: &LowerTriangle,
    rows: &[Row],
    free: usize,
    contact: usize,
    held: &[(usize, Row)],
) -> Lower {
    let size = free + contact;
    let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); size];
    for (i, j, value) in host.entries() {
        for &(a, ca) in &rows[i].unknowns {
            for &(b, cb) in &rows[j].unknowns {
                let value = value * ca * cb;
                if i == j && a < b {
                    continue;
                }
                let value = if i != j && a == b { 2.0 * value } else { value };
                columns[a.min(b)].push((a.max(b), value));
            }
        }
    }
    let largest = host.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    for (component, _) in held {
        columns[free + component].push((free + component, largest));
    }
    let mut lower = Lower { size, starts: vec![0], rows: Vec::new(), values: Vec::new() };
    for (j, column) in columns.iter_mut().enumerate() {
        column.push((j, 0.0));
        column.sort_unstable_by_key(|(i, _)| *i);
        for &(i, value) in column.iter() {
            match lower.rows.last() {
                Some(&last) if last == i && lower.rows.len() > lower.starts[j] => {
                    *lower.values.last_mut().expect("as many values as rows") += value;
                }
                _ => {
                    lower.rows.push(i);
                    lower.values.push(value);
                }
            }
        }
        lower.starts.push(lower.rows.len());
    }
    lower
}
