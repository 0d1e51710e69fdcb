//! The structure by which a host hands over its sparse matrix.

use std::mem::offset_of;

use libc::c_void;

use super::args::At;
use super::guard::Outcome;
use super::numbers::{Numbered, numbers};
use super::structures::Structure;
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
    /// Each degree of freedom once, in the order of elimination, size entries. NULL: chosen. The
    /// places of fixed ones and slaves do not matter; those with the same neighbours, as of one
    /// node, go together. Not read for a flexibility, nor in full space.
    pub order: *const c_void,
}

numbers! {
    Triangle {
        Lower = SIGNORINI_TRIANGLE_LOWER,
        Upper = SIGNORINI_TRIANGLE_UPPER,
        Full = SIGNORINI_TRIANGLE_FULL,
    }
}

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniSparse {
    const OLDER: &'static [usize] = &[offset_of!(Self, order)];
}

impl SignoriniSparse {
    /// The order of elimination of a stiffness that was read, counted from 0, if there is one.
    pub(super) fn order(&self, at: At<'_>) -> Outcome<Option<Vec<usize>>> {
        if self.order.is_null() {
            return Ok(None);
        }
        let n = at.field("size").size(self.size)?;
        let order = self.indices(at, "order", self.order, n)?;
        let wide: Vec<i64> = (0..n).map(|i| order.get(i)).collect();
        at.named("order").shifted(&wide, i64::from(self.index_base)).map(Some)
    }

    /// An array of indices, in the width that the structure tells.
    fn indices<'a>(
        &self,
        at: At<'a>,
        field: &'static str,
        pointer: *const c_void,
        length: usize,
    ) -> Outcome<Indices<'a>> {
        let of_field = at.field(field);
        match self.index_bytes {
            4 => of_field.required(pointer.cast(), length).map(Indices::Narrow),
            8 => of_field.required(pointer.cast(), length).map(Indices::Wide),
            other => at.refuse_part(format!("index_bytes is {other}, it must be 4 or 8")),
        }
    }

    /// The caller's structure, and its matrix, viewed in the caller's arrays.
    pub(super) fn read(at: At<'_>, pointer: *const Self) -> Outcome<(Self, SparseMatrix<'_>)> {
        let given = at.required_copy(pointer)?;
        let triangle = at.chosen("triangle", given.triangle)?;
        let index_base = at.index_base(given.index_base)?;
        let size = at.field("size").size(given.size)?;
        let nnz = at.field("nnz").size(given.nnz)?;
        let Some(columns) = size.checked_add(1) else {
            return at.refuse_part(format!("size is {size}, too large"));
        };
        let values = at.field("values").required(given.values, nnz)?;
        let col_start = given.indices(at, "col_start", given.col_start, columns)?;
        let row = given.indices(at, "row", given.row, nnz)?;
        let matrix = SparseMatrix { size, col_start, row, values, index_base, triangle };
        // Before other indices: a wrong index base is most likely that of all of them.
        matrix.check_col_start().map_err(at.refused())?;
        Ok((given, matrix))
    }
}
