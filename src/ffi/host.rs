//! The structures by which a host hands over its sparse matrix and its contact pairs.

use libc::c_void;

use super::args::{Arrays, checked_size, size};
use super::guard::Failure;
use crate::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};

/// Entries with row >= column are stored, by columns (or row <= column, by rows).
pub const SIGNORINI_LOWER: i32 = 0;
/// Entries with row <= column are stored, by columns (or row >= column, by rows).
pub const SIGNORINI_UPPER: i32 = 1;
/// All entries are stored, by columns or by rows.
pub const SIGNORINI_FULL: i32 = 2;

/// A sparse symmetric stiffness matrix, by columns or by rows, which is the same.
#[repr(C)]
pub struct SignoriniSparse {
    /// sizeof(signorini_sparse).
    pub struct_size: u32,
    /// 4 if starts and rows are arrays of int32_t, 8 if of int64_t. Other numbers are int64_t always.
    pub index_bytes: i32,
    /// 0 or 1: what the first row, and the first entry of starts, are called. Degrees of freedom in
    /// other arguments of the same call are counted from it too.
    pub base: i32,
    /// SIGNORINI_LOWER, SIGNORINI_UPPER or SIGNORINI_FULL.
    pub triangle: i32,
    /// Number of rows and columns.
    pub size: i64,
    /// Number of entries.
    pub entries: i64,
    /// Begin of each column in rows and values, and where the last one ends: size + 1.
    pub starts: *const c_void,
    /// Row of each entry, ascending in each column.
    pub rows: *const c_void,
    /// Entries; force / length.
    pub values: *const f64,
}

/// Contact pairs: a slave node, the point that faces it, and a normal. The slave's displacement is
/// u_slave = sum of weight * u_master + d_n n + d_t t (+ ...), so that the gap closes at d_n = gap.
/// A node is a slave in one pair at the most, and no master is a slave. A slave may be fixed along an
/// axis only where its masters are fixed too and the axis is its normal or a tangent: along it the
/// pair is held, d and F are zero.
#[repr(C)]
pub struct SignoriniPairs {
    /// sizeof(signorini_pairs).
    pub struct_size: u32,
    /// Space dimension, 2 or 3.
    pub dim: i32,
    /// Number of pairs.
    pub pairs: i64,
    /// Degrees of freedom of each slave node, dim for each pair, in the order of the axes.
    pub slaves: *const i64,
    /// Begin of each pair's masters in masters and weights, and where the last ones end:
    /// pairs + 1, counted from base. No masters: a rigid obstacle. NULL: no masters at all.
    pub master_starts: *const i64,
    /// Degrees of freedom of each master node, dim for each; NULL if there are none.
    pub masters: *const i64,
    /// Weight of each master node; those of a pair sum to 1; NULL if there are none.
    pub weights: *const f64,
    /// Normal of each pair, dim entries, outward from the slave's body, of any length.
    pub normals: *const f64,
    /// First tangent of each pair, dim entries; NULL: chosen, in 2D the normal turned by +90 degrees.
    pub tangents: *const f64,
}

impl SignoriniSparse {
    /// Views the caller's matrix.
    ///
    /// # Safety
    /// The structure and its arrays are as the header demands and live during the call.
    pub(super) unsafe fn receive<'a>(
        position: i32,
        pointer: *const Self,
    ) -> Result<SparseMatrix<'a>, Failure> {
        let wrong = |message: String| Failure::argument(position, message);
        // SAFETY: by the caller's contract.
        let given = unsafe { whole(position, "K", pointer)? };
        let triangle = match given.triangle {
            SIGNORINI_LOWER => Triangle::Lower,
            SIGNORINI_UPPER => Triangle::Upper,
            SIGNORINI_FULL => Triangle::Full,
            other => return Err(wrong(format!("K: there is no triangle {other}"))),
        };
        if given.base != 0 && given.base != 1 {
            return Err(wrong(format!("K: base is {}, it must be 0 or 1", given.base)));
        }
        let n = size(position, "K: size", given.size)?;
        let entries = size(position, "K: entries", given.entries)?;
        let Some(columns) = n.checked_add(1) else {
            return Err(wrong(format!("K: size is {n}, too large")));
        };
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths and the width that the structure tells.
        let (starts, rows, values) = unsafe {
            let values = arrays.input(position, "K: values", given.values, entries, true)?;
            let mut indices = |name, pointer: *const c_void, length| {
                Ok(match given.index_bytes {
                    4 => arrays
                        .input(position, name, pointer.cast(), length, true)?
                        .map(Indices::Narrow),
                    8 => arrays
                        .input(position, name, pointer.cast(), length, true)?
                        .map(Indices::Wide),
                    other => {
                        return Err(wrong(format!("K: index_bytes is {other}, it must be 4 or 8")));
                    }
                }
                .unwrap_or(Indices::Wide(&[])))
            };
            let starts = indices("K: starts", given.starts, columns)?;
            (starts, indices("K: rows", given.rows, entries)?, values)
        };
        let values = values.unwrap_or_default();
        let matrix = SparseMatrix {
            size: n,
            col_start: starts,
            row: rows,
            values,
            index_base: i64::from(given.base),
            triangle,
        };
        // Before other indices: a wrong index base is most likely that of all of them.
        matrix.check_col_start().map_err(|error| Failure::from_error(error, |_| position))?;
        Ok(matrix)
    }
}

/// Pairs of the caller with degrees of freedom counted from 0.
pub(super) struct Pairs<'a> {
    dim: usize,
    pairs: usize,
    slaves: Vec<usize>,
    master_starts: Vec<usize>,
    masters: Vec<usize>,
    weights: &'a [f64],
    normals: &'a [f64],
    tangents: Option<&'a [f64]>,
}

impl Pairs<'_> {
    pub(super) fn view(&self) -> ContactPairs<'_> {
        ContactPairs {
            dim: self.dim,
            count: self.pairs,
            slaves: &self.slaves,
            master_start: &self.master_starts,
            masters: &self.masters,
            weights: self.weights,
            normals: self.normals,
            tangents: self.tangents,
        }
    }
}

impl SignoriniPairs {
    /// Views the caller's pairs.
    ///
    /// # Safety
    /// The structure and its arrays are as the header demands and live during the call.
    pub(super) unsafe fn receive<'a>(
        position: i32,
        pointer: *const Self,
        base: i64,
    ) -> Result<Pairs<'a>, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        // SAFETY: by the caller's contract.
        let given = unsafe { whole(position, "pairs", pointer)? };
        if given.dim != 2 && given.dim != 3 {
            return refuse(format!("pairs: dim is {}, it must be 2 or 3", given.dim));
        }
        let dim = given.dim as usize;
        let count = size(position, "pairs: pairs", given.pairs)?;
        let (Some(components), Some(starts)) = (count.checked_mul(dim), count.checked_add(1))
        else {
            return refuse(format!("pairs: {count} pairs are too many"));
        };
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths that the header tells.
        unsafe {
            let slaves = arrays.input(position, "slaves", given.slaves, components, true)?;
            let slaves = shifted(position, "slaves", slaves.unwrap_or_default(), base)?;
            let begins =
                arrays.input(position, "master_starts", given.master_starts, starts, false)?;
            let master_starts = match begins {
                Some(begins) => shifted(position, "master_starts", begins, base)?,
                None => vec![0; starts],
            };
            // What the last begin says is believed; the rest is compared with it later.
            let masters = master_starts[count];
            let Some(entries) = masters.checked_mul(dim) else {
                return refuse(format!("pairs: {masters} masters are too many"));
            };
            let dofs = arrays.input(position, "masters", given.masters, entries, true)?;
            let weights = arrays.input(position, "weights", given.weights, masters, true)?;
            let normals = arrays.input(position, "normals", given.normals, components, true)?;
            let tangents = arrays.input(position, "tangents", given.tangents, components, false)?;
            Ok(Pairs {
                dim,
                pairs: count,
                slaves,
                master_starts,
                masters: shifted(position, "masters", dofs.unwrap_or_default(), base)?,
                weights: weights.unwrap_or_default(),
                normals: normals.unwrap_or_default(),
                tangents,
            })
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
            Failure::argument(position, format!("{name}[{i}] is {value}, less than {base}"))
        })
    };
    values.iter().enumerate().map(shift).collect()
}

/// A structure that has no older form.
///
/// # Safety
/// NULL, or a structure of the caller that begins with its size.
unsafe fn whole<'a, T>(position: i32, name: &str, pointer: *const T) -> Result<&'a T, Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(position, format!("{name} is NULL")));
    }
    // SAFETY: by the caller's contract.
    let given = unsafe { checked_size(position, name, pointer)? };
    if given != size_of::<T>() {
        let message = format!("{name}: struct_size is {given}, set it to sizeof");
        return Err(Failure::argument(position, message));
    }
    // SAFETY: not NULL, aligned and of the right size (just checked).
    Ok(unsafe { &*pointer })
}
