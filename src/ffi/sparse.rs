//! The structure by which a host hands over its sparse matrix.

use std::mem::offset_of;

use libc::c_void;

use super::args::{Arrays, size};
use super::guard::Failure;
use super::structures::{Structure, checked_size, index_base, read};
use crate::error::entry;
use crate::reduce::{Indices, SparseMatrix, Triangle};

/// Entries with row >= column.
pub const SIGNORINI_TRIANGLE_LOWER: i32 = 0;
/// Entries with row <= column.
pub const SIGNORINI_TRIANGLE_UPPER: i32 = 1;
/// All entries.
pub const SIGNORINI_TRIANGLE_FULL: i32 = 2;

/// A sparse symmetric matrix by columns (CSC), stiffness or flexibility. Of a matrix by rows (CSR)
/// hand over the rows as columns, and LOWER for UPPER.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSparse {
    /// sizeof(signorini_sparse).
    pub struct_size: u32,
    /// Width of col_start, row and order: 4 for int32_t, 8 for int64_t.
    pub index_bytes: i32,
    /// Number of the first row, 0 or 1: all degrees of freedom of the call count from it.
    pub index_base: i32,
    /// Which entries are stored, SIGNORINI_TRIANGLE_...
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
    /// Order of elimination: each degree of freedom once, the first to go first, size entries;
    /// NULL: chosen. Fixed ones and slaves in it have no effect; those with the same neighbours, as
    /// of one node, go together. Of a flexibility, and in full space, it is not read.
    pub order: *const c_void,
}

/// Names of a sparse matrix and of its arrays in sentences.
pub(super) struct Names {
    matrix: &'static str,
    col_start: &'static str,
    row: &'static str,
    values: &'static str,
}

/// The names of a stiffness.
pub(super) const STIFFNESS: Names =
    Names { matrix: "K", col_start: "K: col_start", row: "K: row", values: "K: values" };

/// The names of a flexibility.
pub(super) const FLEXIBILITY: Names =
    Names { matrix: "W", col_start: "W: col_start", row: "W: row", values: "W: values" };

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniSparse {}

impl SignoriniSparse {
    /// # Safety
    /// As [`Self::read`].
    unsafe fn copied(position: i32, name: &str, pointer: *const Self) -> Result<Self, Failure> {
        if pointer.is_null() {
            return Err(Failure::argument(position, format!("{name} is NULL")));
        }
        // SAFETY: by the caller's contract; before version 0.2 was finished the structure ended
        // with `values`.
        let given = unsafe { checked_size(position, name, pointer)? };
        if given < offset_of!(Self, order) {
            let message =
                format!("{name}: struct_size is {given}, set it to sizeof ({})", size_of::<Self>());
            return Err(Failure::argument(position, message));
        }
        // SAFETY: as above.
        unsafe { read(position, name, pointer) }
    }

    /// The order of elimination, counted from 0, if there is one.
    ///
    /// # Safety
    /// The structure was read, and its arrays are as the header demands.
    pub(super) unsafe fn order(
        position: i32,
        pointer: *const Self,
    ) -> Result<Option<Vec<usize>>, Failure> {
        // SAFETY: by the caller's contract.
        let given = unsafe { Self::copied(position, STIFFNESS.matrix, pointer)? };
        if given.order.is_null() {
            return Ok(None);
        }
        let n = size(position, "K: size", given.size)?;
        let base = i64::from(given.index_base);
        let mut arrays = Arrays::default();
        // SAFETY: an array of the length and width that the structure tells.
        let wide: Vec<i64> = unsafe {
            if given.index_bytes == size_of::<i32>() as i32 {
                let order = arrays.required(position, "K: order", given.order.cast::<i32>(), n)?;
                order.iter().map(|&i| i64::from(i)).collect()
            } else {
                arrays.required(position, "K: order", given.order.cast::<i64>(), n)?.to_vec()
            }
        };
        shifted(position, "order", &wide, base).map(Some)
    }

    /// Views the caller's matrix, and notes its structure and arrays.
    ///
    /// # Safety
    /// The structure and its arrays are as the header demands and live during the call.
    pub(super) unsafe fn read<'a>(
        arrays: &mut Arrays,
        position: i32,
        names: &Names,
        pointer: *const Self,
    ) -> Result<SparseMatrix<'a>, Failure> {
        let name = names.matrix;
        let wrong = |message: String| Failure::argument(position, message);
        let count = |what: &str, value| size(position, &format!("{name}: {what}"), value);
        // SAFETY: by the caller's contract.
        let given = unsafe { Self::copied(position, name, pointer)? };
        // SAFETY: as above.
        unsafe { arrays.structure(position, name, pointer, false)? };
        let triangle = match given.triangle {
            SIGNORINI_TRIANGLE_LOWER => Triangle::Lower,
            SIGNORINI_TRIANGLE_UPPER => Triangle::Upper,
            SIGNORINI_TRIANGLE_FULL => Triangle::Full,
            other => return Err(wrong(format!("{name}: there is no triangle {other}"))),
        };
        let base = index_base(position, name, given.index_base)?;
        let n = count("size", given.size)?;
        let nnz = count("nnz", given.nnz)?;
        let Some(columns) = n.checked_add(1) else {
            return Err(wrong(format!("{name}: size is {n}, too large")));
        };
        // SAFETY: arrays of the lengths and the width that the structure tells.
        unsafe {
            let values = arrays.required(position, names.values, given.values, nnz)?;
            let mut indices = |name, pointer: *const c_void, length| match given.index_bytes {
                4 => arrays.required(position, name, pointer.cast(), length).map(Indices::Narrow),
                8 => arrays.required(position, name, pointer.cast(), length).map(Indices::Wide),
                other => {
                    let name = names.matrix;
                    Err(wrong(format!("{name}: index_bytes is {other}, it must be 4 or 8")))
                }
            };
            let col_start = indices(names.col_start, given.col_start, columns)?;
            let row = indices(names.row, given.row, nnz)?;
            let matrix =
                SparseMatrix { size: n, col_start, row, values, index_base: base, triangle };
            // Before other indices: a wrong index base is most likely that of all of them.
            matrix.check_col_start().map_err(|error| Failure::from_error(error, |_| position))?;
            Ok(matrix)
        }
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
