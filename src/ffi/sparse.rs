//! The structure by which a host hands over its sparse matrix.

use std::mem::offset_of;

use libc::c_void;

use super::args::{Arrays, size};
use super::guard::Failure;
use super::numbers::{Numbered, numbers};
use super::structures::{Structure, chosen, index_base};
use crate::error::entry;
use crate::reduce::{Indices, SparseMatrix, Triangle};

/// Entries with row >= column.
pub const SIGNORINI_TRIANGLE_LOWER: i32 = 0;
/// Entries with row <= column.
pub const SIGNORINI_TRIANGLE_UPPER: i32 = 1;
/// All entries.
pub const SIGNORINI_TRIANGLE_FULL: i32 = 2;

/// A sparse symmetric matrix by columns (CSC), stiffness or flexibility. For a matrix by rows
/// (CSR) pass the rows as columns, and LOWER for UPPER.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSparse {
    /// sizeof(signorini_sparse).
    pub struct_size: u32,
    /// Width of col_start, row and order: 4 for int32_t, 8 for int64_t.
    pub index_bytes: i32,
    /// Number of the first row, 0 or 1: all degrees of freedom of the call count from it.
    pub index_base: i32,
    /// SIGNORINI_TRIANGLE_...
    pub triangle: i32,
    /// Number of rows and columns.
    pub size: i64,
    /// Number of stored entries.
    pub nnz: i64,
    /// Start of each column in row and values, size + 1 entries from index_base.
    pub col_start: *const c_void,
    /// Row of each entry, ascending in each column.
    pub row: *const c_void,
    /// The entries; a stiffness: force / length.
    pub values: *const f64,
    /// Order of elimination, size entries: each degree of freedom once, the first to be eliminated
    /// first. NULL: chosen. The places of fixed ones and slaves do not matter; those with the same
    /// neighbours, as of one node, go together. Not read for a flexibility, nor in full space.
    pub order: *const c_void,
}

numbers! {
    Triangle {
        Lower = SIGNORINI_TRIANGLE_LOWER,
        Upper = SIGNORINI_TRIANGLE_UPPER,
        Full = SIGNORINI_TRIANGLE_FULL,
    }
}

/// Names of a sparse matrix and of its arrays `col_start`, `row` and `values` in sentences.
type Names = [&'static str; 4];

/// The names of a stiffness.
pub(super) const STIFFNESS: Names = ["K", "K: col_start", "K: row", "K: values"];

/// The names of a flexibility.
pub(super) const FLEXIBILITY: Names = ["W", "W: col_start", "W: row", "W: values"];

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniSparse {
    const OLDER: &'static [usize] = &[offset_of!(Self, order)];
}

impl SignoriniSparse {
    /// The order of elimination of a stiffness that was read, counted from 0, if there is one.
    pub(super) fn order(
        &self,
        arrays: &mut Arrays<'_>,
        position: i32,
    ) -> Result<Option<Vec<usize>>, Failure> {
        if self.order.is_null() {
            return Ok(None);
        }
        let n = size(position, "K: size", self.size)?;
        let order = self.indices(arrays, position, "K", ("K: order", self.order, n))?;
        let wide = match order {
            Indices::Narrow(order) => order.iter().map(|&i| i64::from(i)).collect(),
            Indices::Wide(order) => order.to_vec(),
        };
        shifted(position, "order", &wide, i64::from(self.index_base)).map(Some)
    }

    /// An array of indices, in the width that the structure tells.
    fn indices<'h>(
        &self,
        arrays: &mut Arrays<'h>,
        position: i32,
        matrix: &str,
        (name, pointer, length): (&'static str, *const c_void, usize),
    ) -> Result<Indices<'h>, Failure> {
        match self.index_bytes {
            4 => arrays.required(position, name, pointer.cast(), length).map(Indices::Narrow),
            8 => arrays.required(position, name, pointer.cast(), length).map(Indices::Wide),
            other => {
                let message = format!("{matrix}: index_bytes is {other}, it must be 4 or 8");
                Err(Failure::argument(position, message))
            }
        }
    }

    /// The caller's structure, and its matrix, viewed in the caller's arrays.
    pub(super) fn read<'h>(
        arrays: &mut Arrays<'h>,
        position: i32,
        [name, col_start, row, values]: Names,
        pointer: *const Self,
    ) -> Result<(Self, SparseMatrix<'h>), Failure> {
        let given = arrays.required_copy(position, name, pointer)?;
        let count = |what: &str, value| size(position, &format!("{name}: {what}"), value);
        let triangle = chosen(position, (name, "triangle"), given.triangle)?;
        let index_base = index_base(position, name, given.index_base)?;
        let size = count("size", given.size)?;
        let nnz = count("nnz", given.nnz)?;
        let Some(columns) = size.checked_add(1) else {
            return Err(Failure::argument(position, format!("{name}: size is {size}, too large")));
        };
        let values = arrays.required(position, values, given.values, nnz)?;
        let mut indices = |array| given.indices(arrays, position, name, array);
        let col_start = indices((col_start, given.col_start, columns))?;
        let row = indices((row, given.row, nnz))?;
        let matrix = SparseMatrix { size, col_start, row, values, index_base, triangle };
        // Before other indices: a wrong index base is most likely that of all of them.
        matrix.check_col_start().map_err(|error| Failure::from_error(error, |_| position))?;
        Ok((given, matrix))
    }
}

/// Numbers counted from `base`, counted from 0.
pub(super) fn shifted(
    position: i32,
    name: &str,
    values: &[i64],
    base: i64,
) -> Result<Vec<usize>, Failure> {
    let shift = |(i, &value): (usize, &i64)| {
        value.checked_sub(base).and_then(|value| usize::try_from(value).ok()).ok_or_else(|| {
            let place = entry(name, [i]);
            Failure::argument(position, format!("{place} is {value}, less than {base}"))
        })
    };
    values.iter().enumerate().map(shift).collect()
}
