//! The entries of a matrix in the order of elimination.

use super::factor_progress::Failure;
use super::graph::filled;
use super::structure::Structure;
use crate::linalg::sparse_matrix::{Csc, column};

/// An entry of the matrix in a column: its row, and its value.
type Entry = (usize, f64);

/// The columns that are eliminated.
pub struct Entries {
    start: Vec<usize>,
    entry: Vec<Entry>,
}

impl Entries {
    /// Sorts those of the matrix whose lower triangle is `lower`. Puts the entries of kept unknowns into the lower triangle of
    /// `schur`.
    pub fn new(structure: &Structure, lower: &Csc, schur: &mut [f64]) -> Result<Self, Failure> {
        let (eliminated, kept) = (structure.eliminated, structure.kept());
        let mut inverse = filled(structure.size, 0)?;
        structure.order.iter().enumerate().for_each(|(place, &i)| inverse[i] = place);
        let mut start = filled(eliminated + 1, 0)?;
        for (i, j, value) in placed(lower, &inverse) {
            if j < eliminated {
                start[j + 1] += 1;
            } else {
                schur[i - eliminated + kept * (j - eliminated)] += value;
            }
        }
        (0..eliminated).for_each(|j| start[j + 1] += start[j]);
        let mut entry = filled(start[eliminated], (0, 0.0))?;
        let mut next = start.clone();
        for (i, j, value) in placed(lower, &inverse).filter(|&(_, j, _)| j < eliminated) {
            entry[next[j]] = (i, value);
            next[j] += 1;
        }
        Ok(Entries { start, entry })
    }

    /// Bytes of those of a matrix.
    pub fn bytes(structure: &Structure, lower: &Csc) -> usize {
        lower.compute_nnz() * size_of::<Entry>() + 3 * structure.size * size_of::<usize>()
    }

    /// Those of a column.
    pub fn of(&self, column: usize) -> &[Entry] {
        &self.entry[self.start[column]..self.start[column + 1]]
    }

    /// The one of a column that stands on the diagonal.
    pub fn diagonal(&self, column: usize) -> f64 {
        self.of(column).iter().find(|(row, _)| *row == column).map_or(0.0, |(_, value)| *value)
    }
}

/// The entries of the lower triangle in the places of the order: row, column, value.
fn placed<'a>(
    lower: &'a Csc,
    inverse: &'a [usize],
) -> impl Iterator<Item = (usize, usize, f64)> + 'a {
    (0..lower.ncols()).flat_map(move |j| {
        let (rows, values) = column(lower, j);
        let to = inverse[j];
        rows.iter().zip(values).map(move |(&i, &value)| {
            let other = inverse[i];
            (to.max(other), to.min(other), value)
        })
    })
}
