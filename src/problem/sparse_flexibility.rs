//! The flexibility form with a sparse `W`. Pairs that no entry of it ties to each other are islands: each is a
//! problem of its own.

use super::islands::Islands;
use crate::error::{Argument, Error};
use crate::linalg::sparse_matrix::{
    Csc, diagonals, entries, entries_of, symmetric_residual, symmetric_times,
};
use crate::linalg::vector::largest_of;

/// Why a matrix of zeros is refused.
pub(super) const ZERO: &str =
    "W is zero: no contact force moves anything; hand over the flexibility of the bodies";

/// A sparse symmetric `W` of pairs, and its islands.
#[derive(Clone, Debug)]
pub struct SparseW {
    lower: Csc,
    dim: usize,
    pub(crate) islands: Islands,
}

/// Pairs with an entry that is not zero are of one island.
fn islands(lower: &Csc, dim: usize) -> Islands {
    let ties = entries(lower).filter(|(_, _, value)| *value != 0.0);
    Islands::new(lower.ncols() / dim, ties.map(|(i, j, _)| (i / dim, j / dim)))
}

impl SparseW {
    /// The lower triangle of a checked `W`, `dim` rows for each pair.
    ///
    /// # Errors
    /// [`Error::Invalid`]: a `W` of zeros.
    pub(crate) fn new(dim: usize, lower: Csc) -> Result<Self, Error> {
        let matrix = SparseW { islands: islands(&lower, dim), lower, dim };
        let (size, largest) = (matrix.size(), matrix.largest_diagonal());
        if size > 0 && largest == 0.0 {
            return Argument::Matrix.refuse(ZERO);
        }
        Ok(matrix)
    }

    pub(super) fn largest_diagonal(&self) -> f64 {
        largest_of(diagonals(&self.lower))
    }

    /// The matrix with other values in the same places; `None` where there is none for one of them.
    pub(super) fn with_values(&self, value: impl Fn(f64) -> Option<f64>) -> Option<Self> {
        let mut copy = self.clone();
        for entry in copy.lower.val_mut() {
            *entry = value(*entry)?;
        }
        Some(copy)
    }

    /// Number of rows of the largest island.
    pub fn largest_part(&self) -> usize {
        self.dim * self.islands.largest().len()
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.lower.ncols()
    }

    /// Number of stored entries of a triangle.
    pub fn entries(&self) -> usize {
        self.lower.compute_nnz()
    }

    /// The part of `W` of the pairs of an island, dense and column-major.
    pub fn part(&self, pairs: &[usize]) -> Vec<f64> {
        let (dim, n) = (self.dim, self.dim * pairs.len());
        let mut part = vec![0.0; n * n];
        for (place, &pair) in pairs.iter().enumerate() {
            for component in 0..dim {
                let j = dim * place + component;
                let entries = entries_of(&self.lower, dim * pair + component);
                // Rows ascend, and so do the pairs: places are found from the last one on.
                let mut at = place;
                for (row, value) in entries.filter(|(_, value)| *value != 0.0) {
                    at += pairs[at..].partition_point(|&pair| pair < row / dim);
                    let i = dim * at + row % dim;
                    (part[i + n * j], part[j + n * i]) = (value, value);
                }
            }
        }
        part
    }

    /// The diagonal block from component `first` on, column-major, in as many numbers as it has.
    pub fn block(&self, first: usize) -> [f64; 9] {
        let (dim, mut block) = (self.dim, [0.0; 9]);
        for j in 0..dim {
            let column = entries_of(&self.lower, first + j);
            for (i, value) in column.take_while(|(i, _)| *i < first + dim) {
                (block[i - first + dim * j], block[j + dim * (i - first)]) = (value, value);
            }
        }
        block
    }

    /// `W F`.
    pub(super) fn times(&self, force: &[f64]) -> Vec<f64> {
        symmetric_times(&self.lower, force)
    }

    /// `W F - d`, in twice the precision and rounded once.
    pub(super) fn times_less(&self, force: &[f64], d: &[f64]) -> Vec<f64> {
        symmetric_residual(&self.lower, (force, &[]), d)
    }
}
