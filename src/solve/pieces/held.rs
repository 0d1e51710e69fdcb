//! The components that are no unknowns of a system: their pushes follow from the motion of the unknowns.

use super::equations::Equations;
use crate::law::Unknown;
use crate::linalg::dense::subtract_product;
use crate::linalg::watched::written;

/// Solutions of a system from which on the rows of its held components are gathered: that takes the time of about so many
/// products with `K`.
const GATHERED: usize = 5;

/// Components that are held.
pub struct Held {
    /// Their places.
    pub components: Vec<usize>,
    /// The row of `K` of each with the columns of the unknowns, once [`GATHERED`] solutions have been asked for.
    rows: Vec<f64>,
    solutions: usize,
}

impl Held {
    pub fn new(components: Vec<usize>) -> Self {
        Held { components, rows: Vec::new(), solutions: 0 }
    }

    /// `b - K_s dd` of the held components, for each column of `b` and of `moved`, `s` times the displacements of the
    /// unknowns.
    pub fn pushes(
        &mut self,
        equations: &Equations<'_>,
        unknowns: &[Unknown],
        (b, moved): (&[f64], &[f64]),
    ) -> Vec<f64> {
        let (size, count) = (equations.root.len().max(1), unknowns.len());
        let at = |own: &Unknown| equations.dim * own.pair + own.component;
        let mut pushes = Vec::with_capacity(b.len() / size * self.components.len());
        b.chunks_exact(size).for_each(|b| pushes.extend(self.components.iter().map(|&i| b[i])));
        self.solutions += b.len() / size;
        if self.rows.is_empty() && self.solutions >= GATHERED {
            let at: Vec<(usize, f64)> = unknowns.iter().map(|own| (at(own), 1.0)).collect();
            self.rows = rows(equations, &self.components, &at, Vec::new());
        }
        if !self.rows.is_empty() {
            subtract_product(&mut pushes, &self.rows, moved, count);
            return pushes;
        }
        let mut dd = vec![0.0; size];
        let columns = pushes.chunks_exact_mut(self.components.len().max(1));
        for (pushes, moved) in columns.zip(moved.chunks_exact(count.max(1))) {
            unknowns.iter().zip(moved).for_each(|(own, moved)| dd[at(own)] = *moved);
            let product = equations.matrix.product(&dd);
            pushes.iter_mut().zip(&self.components).for_each(|(push, &i)| *push -= product[i]);
        }
        pushes
    }
}

/// The rows of `K` of the components that are held, each with the columns at places, in their units; in `memory`.
pub fn rows(
    equations: &Equations<'_>,
    held: &[usize],
    at: &[(usize, f64)],
    memory: Vec<f64>,
) -> Vec<f64> {
    let matrix = equations.matrix;
    written(memory, (at.len(), held.len()), |k, row| {
        let (i, column) = (held[k], matrix.column(held[k]));
        for (entry, &(j, unit)) in row.iter_mut().zip(at) {
            // The columns of a symmetric matrix are contiguous, its rows are not.
            *entry = unit * if equations.symmetric { column[j] } else { matrix.at(i, j) };
        }
    })
}
