//! The entries of a matrix in the order of elimination.

use faer::Side;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::utils::{permute_self_adjoint_scratch, permute_self_adjoint_to_unsorted};

use super::factor_progress::Failure;
use super::lists::filled;
use super::structure::Structure;
use crate::linalg::sparse_matrix::{Csc, OutOfMemory};

/// The lower triangle of the matrix in that order, by columns.
pub struct Entries {
    start: Vec<usize>,
    row: Vec<usize>,
    value: Vec<f64>,
}

impl Entries {
    /// Those of the matrix whose lower triangle is `lower`. Puts the entries of kept unknowns into the lower triangle of
    /// `schur`.
    pub fn new(structure: &Structure, lower: &Csc, schur: &mut [f64]) -> Result<Self, Failure> {
        let (size, count) = (structure.size, lower.compute_nnz());
        let mut inverse = filled(size, 0)?;
        structure.order.iter().enumerate().for_each(|(place, &i)| inverse[i] = place);
        let order = PermRef::new_checked(&structure.order, &inverse, size);
        let (mut start, mut row) = (filled(size + 1, 0)?, filled(count, 0)?);
        let mut value = filled(count, 0.0)?;
        let scratch = permute_self_adjoint_scratch::<usize>(size);
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| OutOfMemory)?;
        permute_self_adjoint_to_unsorted(
            &mut value,
            &mut start,
            &mut row,
            lower.as_ref(),
            order,
            Side::Lower,
            Side::Lower,
            MemStack::new(&mut memory),
        );
        let entries = Entries { start, row, value };
        let columns = schur.chunks_mut(structure.kept().max(1));
        for (j, column) in (structure.eliminated..).zip(columns) {
            entries.of(j).for_each(|(i, value)| column[i - structure.eliminated] += value);
        }
        Ok(entries)
    }

    /// Bytes of those of a matrix.
    pub fn bytes(structure: &Structure, lower: &Csc) -> usize {
        let entry = size_of::<usize>() + size_of::<f64>();
        lower.compute_nnz() * entry + 3 * structure.size * size_of::<usize>()
    }

    /// Rows and values of a column.
    pub fn of(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let own = self.start[column]..self.start[column + 1];
        self.row[own.clone()].iter().copied().zip(self.value[own].iter().copied())
    }

    /// The entry of a column that stands on the diagonal.
    pub fn diagonal(&self, column: usize) -> f64 {
        self.of(column).find(|(row, _)| *row == column).map_or(0.0, |(_, value)| value)
    }
}
