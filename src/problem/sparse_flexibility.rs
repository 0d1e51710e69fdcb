//! The flexibility form with a sparse `W`. Pairs that no entry of it ties to each other are islands: each is a
//! problem of its own.

use super::arguments::vector;
use super::contact::ContactProblem;
use super::flexibility::{Flexibility, FlexibilityMatrix, units_of_pair, units_of_pairs};
use super::friction_law::FrictionLaw;
use super::islands::Islands;
use crate::error::{Argument, Error};
use crate::linalg::matrix::Matrix;
use crate::linalg::sparse_matrix::{Csc, column, diagonal, symmetric_residual, symmetric_times};
use crate::linalg::vector::largest_of;

/// A sparse symmetric `W` of pairs, and its islands.
#[derive(Clone, Debug)]
pub struct SparseW {
    lower: Csc,
    dim: usize,
    islands: Islands,
}

/// A contact problem in flexibility form with a sparse `W`, of which it has a copy; a view of the host's other
/// arrays.
pub type SparseFlexibilityProblem<'a> = ContactProblem<'a, Flexibility<'a, SparseW>>;

impl<'a> SparseFlexibilityProblem<'a> {
    /// A problem with a checked `W`; other arguments as in [`super::FlexibilityData`].
    ///
    /// # Errors
    /// [`Error::Invalid`]: the first entry of an array that is out of range.
    pub(crate) fn with_matrix(
        matrix: SparseW,
        free: &'a [f64],
        gap: &'a [f64],
        law: FrictionLaw<'a>,
        reference_slip: Option<&'a [f64]>,
    ) -> Result<Self, Error> {
        let (dim, size) = (matrix.dim, matrix.lower.ncols());
        let free = vector(Argument::Load, "q", free, size)?;
        let largest = matrix.largest_diagonal();
        let each = (0..size).step_by(dim).map(|first| {
            let block = block(&matrix.lower, first, dim);
            units_of_pair(&Matrix::new(dim, &block, dim), largest)
        });
        let units = units_of_pairs(dim, each);
        let relation = Flexibility::new(matrix, free, units);
        ContactProblem::with_relation(relation, dim, gap, law, reference_slip)
    }
}

/// The diagonal block from component `first` on, column-major.
fn block(lower: &Csc, first: usize, dim: usize) -> Vec<f64> {
    let mut block = vec![0.0; dim * dim];
    for j in 0..dim {
        let (rows, values) = column(lower, first + j);
        for (&i, &value) in rows.iter().zip(values).take_while(|(i, _)| **i < first + dim) {
            (block[i - first + dim * j], block[j + dim * (i - first)]) = (value, value);
        }
    }
    block
}

/// Pairs with an entry that is not zero are of one island.
fn islands(lower: &Csc, dim: usize) -> Islands {
    let ties = (0..lower.ncols()).flat_map(|j| {
        let (rows, values) = column(lower, j);
        let entries = rows.iter().zip(values).filter(|(_, value)| **value != 0.0);
        entries.map(move |(i, _)| (i / dim, j / dim))
    });
    Islands::new(lower.ncols() / dim, ties)
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
            return Err(Error::invalid(Argument::Matrix, super::flexibility::ZERO));
        }
        Ok(matrix)
    }

    fn largest_diagonal(&self) -> f64 {
        let each = (0..self.lower.ncols()).map(|j| diagonal(&self.lower, j).unwrap_or(0.0));
        largest_of(each)
    }

    /// The matrix with other values in the same places; `None` where there is none for one of them.
    pub(super) fn with_values(&self, value: impl Fn(f64) -> Option<f64>) -> Option<Self> {
        let mut copy = self.clone();
        for entry in copy.lower.val_mut() {
            *entry = value(*entry)?;
        }
        Some(copy)
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.lower.ncols()
    }

    /// Rows of a pair.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The islands of its pairs.
    pub fn islands(&self) -> &Islands {
        &self.islands
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
                let (rows, values) = column(&self.lower, dim * pair + component);
                // Rows ascend, and so do the pairs: places are found from the last one on.
                let mut at = place;
                for (&row, &value) in rows.iter().zip(values).filter(|(_, value)| **value != 0.0) {
                    at += pairs[at..].partition_point(|&pair| pair < row / dim);
                    let i = dim * at + row % dim;
                    (part[i + n * j], part[j + n * i]) = (value, value);
                }
            }
        }
        part
    }
}

impl FlexibilityMatrix for SparseW {
    fn times(&self, force: &[f64]) -> Vec<f64> {
        symmetric_times(&self.lower, force)
    }

    fn times_less(&self, force: &[f64], d: &[f64]) -> Vec<f64> {
        symmetric_residual(&self.lower, (force, &[]), d)
    }
}
