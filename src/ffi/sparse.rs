//! The structures by which a host hands over its sparse matrix and its contact pairs.

use std::mem::offset_of;

use libc::c_void;

use super::args::{Arrays, size};
use super::guard::Failure;
use super::structures::{checked_size, read};
use crate::error::{Error, entry};
use crate::problem;
use crate::reduce::{ContactPairs, Indices, SparseMatrix, Triangle};

/// Stored are the entries with row >= column.
pub const SIGNORINI_TRIANGLE_LOWER: i32 = 0;
/// Stored are the entries with row <= column.
pub const SIGNORINI_TRIANGLE_UPPER: i32 = 1;
/// All entries are stored.
pub const SIGNORINI_TRIANGLE_FULL: i32 = 2;

/// A sparse symmetric stiffness matrix by columns (CSC). Hand over a matrix by rows (CSR) as its
/// transpose: its rows are the columns here, and its LOWER is UPPER. The library only reads it
/// during the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniSparse {
    /// sizeof(signorini_sparse).
    pub struct_size: u32,
    /// Width of col_start and row: 4 for int32_t, 8 for int64_t.
    pub index_bytes: i32,
    /// 0 or 1: the number of the first row. col_start, row and the degrees of freedom in all other
    /// arguments of the call count from it.
    pub index_base: i32,
    /// Which entries are stored, SIGNORINI_TRIANGLE_...
    pub triangle: i32,
    /// Number of rows and columns.
    pub size: i64,
    /// Number of stored entries.
    pub nnz: i64,
    /// Start of each column in row and values, size + 1 entries; the last is index_base + nnz.
    pub col_start: *const c_void,
    /// Row of each entry, ascending in each column; nnz entries.
    pub row: *const c_void,
    /// The entries, nnz; force / length.
    pub values: *const f64,
    /// Order of elimination: each degree of freedom once, the first to go first, size entries of
    /// index_bytes. NULL: chosen. Fixed degrees of freedom and slaves are passed over; those with
    /// the same neighbours, as of one node, go together.
    pub order: *const c_void,
}

/// Contact pairs: each has a slave node, a point that faces it on other bodies, and a normal. The
/// point is interpolated between master nodes. The slave's displacement is
/// u_slave = sum of weight * u_master + n d_n + t d_t (3D: + t1 d_t1 + t2 d_t2),
/// so that the gap is closed at d_n = gap.
///
/// General rows, as mortar methods make them: leave slaves, master_start, masters and weights NULL
/// and set row_start, row_nodes and row_weights. Each pair is then a list of nodes with signed
/// weights, and n d_n + t d_t = sum of row_weight * u.
///
/// A node may stand in any number of pairs, as slave and as master, and may be fixed. Where slave
/// and masters are all fixed along an axis, which is the normal or a tangent, d and F are zero along
/// it. Pairs may depend on each other, such as those of a node on two planes, or of two surfaces
/// that are each other's slaves: then contact forces are not unique, and the model has no
/// signorini_model_stiffness. The library only reads the structure during the call.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniPairs {
    /// sizeof(signorini_pairs).
    pub struct_size: u32,
    /// Space dimension, 2 or 3.
    pub dim: i32,
    /// Number of pairs.
    pub count: i64,
    /// Degrees of freedom of each slave node, dim for each pair, in the order of the axes.
    pub slaves: *const i64,
    /// Start of each pair's masters in masters and weights, count + 1 entries, counted from
    /// index_base. A pair without masters faces a rigid obstacle. NULL: no pair has masters;
    /// masters and weights must be NULL too.
    pub master_start: *const i64,
    /// Degrees of freedom of each master node, dim for each; may be NULL if there are none.
    pub masters: *const i64,
    /// Weight of each master node; may be NULL if there are none. The weights of a pair sum to 1;
    /// negative weights are allowed.
    pub weights: *const f64,
    /// Normal of each pair, dim entries, outward from the slave's body, of any length.
    pub normals: *const f64,
    /// First tangent of each pair, dim entries, orthogonal to the normal to 1e-5. NULL: chosen.
    /// 2D: the normal turned by +90 degrees. 3D: t1 = e x n with the axis e that is most across the
    /// normal. In 3D always t2 = n x t1; signorini_model_frames returns all.
    pub tangents: *const f64,
    /// General rows: start of each pair's nodes in row_nodes and row_weights, count + 1 entries,
    /// counted from index_base. NULL: pairs of slaves and masters. A struct_size without this field
    /// and the next two is right too: they are NULL then.
    pub row_start: *const i64,
    /// Degrees of freedom of each node, dim for each, in the order of the axes.
    pub row_nodes: *const i64,
    /// Weight of each node: positive on the side whose outward normal is given, negative on the
    /// other. Those of a pair sum to 0, and against a rigid obstacle to 1.
    pub row_weights: *const f64,
}

impl SignoriniSparse {
    /// # Safety
    /// As [`Self::read`].
    unsafe fn copied(position: i32, pointer: *const Self) -> Result<Self, Failure> {
        if pointer.is_null() {
            return Err(Failure::argument(position, "K is NULL"));
        }
        // SAFETY: by the caller's contract; before version 0.2 was finished the structure ended
        // with `values`.
        let given = unsafe { checked_size(position, "K", pointer)? };
        if given < offset_of!(Self, order) {
            let message =
                format!("K: struct_size is {given}, set it to sizeof ({})", size_of::<Self>());
            return Err(Failure::argument(position, message));
        }
        let empty = SignoriniSparse {
            struct_size: 0,
            index_bytes: 0,
            index_base: 0,
            triangle: SIGNORINI_TRIANGLE_LOWER,
            size: 0,
            nnz: 0,
            col_start: std::ptr::null(),
            row: std::ptr::null(),
            values: std::ptr::null(),
            order: std::ptr::null(),
        };
        // SAFETY: as above.
        unsafe { read(position, "K", pointer, empty) }
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
        let given = unsafe { Self::copied(position, pointer)? };
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

    /// Views the caller's matrix.
    ///
    /// # Safety
    /// The structure and its arrays are as the header demands and live during the call.
    pub(super) unsafe fn read<'a>(
        position: i32,
        pointer: *const Self,
    ) -> Result<SparseMatrix<'a>, Failure> {
        let wrong = |message: String| Failure::argument(position, message);
        // SAFETY: by the caller's contract.
        let given = unsafe { Self::copied(position, pointer)? };
        let triangle = match given.triangle {
            SIGNORINI_TRIANGLE_LOWER => Triangle::Lower,
            SIGNORINI_TRIANGLE_UPPER => Triangle::Upper,
            SIGNORINI_TRIANGLE_FULL => Triangle::Full,
            other => return Err(wrong(format!("K: there is no triangle {other}"))),
        };
        let base = i64::from(given.index_base);
        if base != 0 && base != 1 {
            return Err(wrong(format!("K: index_base is {base}, it must be 0 or 1")));
        }
        let n = size(position, "K: size", given.size)?;
        let nnz = size(position, "K: nnz", given.nnz)?;
        let Some(columns) = n.checked_add(1) else {
            return Err(wrong(format!("K: size is {n}, too large")));
        };
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths and the width that the structure tells.
        unsafe {
            let values = arrays.required(position, "K: values", given.values, nnz)?;
            let mut indices = |name, pointer: *const c_void, length| match given.index_bytes {
                4 => arrays.required(position, name, pointer.cast(), length).map(Indices::Narrow),
                8 => arrays.required(position, name, pointer.cast(), length).map(Indices::Wide),
                other => Err(wrong(format!("K: index_bytes is {other}, it must be 4 or 8"))),
            };
            let col_start = indices("K: col_start", given.col_start, columns)?;
            let row = indices("K: row", given.row, nnz)?;
            let matrix =
                SparseMatrix { size: n, col_start, row, values, index_base: base, triangle };
            // Before other indices: a wrong index base is most likely that of all of them.
            matrix.check_col_start().map_err(|error| Failure::from_error(error, |_| position))?;
            Ok(matrix)
        }
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
    pub(super) unsafe fn read<'a>(
        position: i32,
        pointer: *const Self,
        base: i64,
    ) -> Result<Pairs<'a>, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        if pointer.is_null() {
            return refuse("pairs is NULL".into());
        }
        // SAFETY: by the caller's contract; not NULL.
        let given = unsafe { read(position, "pairs", pointer, Self::EMPTY)? };
        given.check_size(position)?;
        let wrong = |error: Error| {
            Failure::argument(position, format!("pairs: {}", error.message().marked()))
        };
        let dim = problem::checked_dim(given.dim).map_err(wrong)?;
        let count = size(position, "pairs: count", given.count)?;
        let components = problem::unknowns(dim, count).map_err(wrong)?;
        let mut arrays = Arrays::default();
        let nodes = given.nodes(position)?;
        // SAFETY: arrays of the lengths that the header tells.
        unsafe {
            let slaves = match nodes.slaves {
                Some(slaves) => {
                    let slaves = arrays.required(position, "slaves", slaves, components)?;
                    shifted(position, "slaves", slaves, base)?
                }
                None => Vec::new(),
            };
            let starts = arrays.optional(position, nodes.names[0], nodes.start, count + 1)?;
            let master_starts = match starts {
                Some(starts) => shifted(position, nodes.names[0], starts, base)?,
                None if nodes.dofs.is_null() && nodes.weights.is_null() => vec![0; count + 1],
                None => {
                    return refuse(
                        "pairs: master_start is NULL, but masters or weights is not: set \
                         master_start, or all three to NULL for rigid obstacles"
                            .into(),
                    );
                }
            };
            // The last start gives the lengths of masters and weights; Model::sparse checks the
            // other starts.
            let masters = master_starts[count];
            let Some(entries) = masters.checked_mul(dim) else {
                return refuse(format!("pairs: {masters} masters are too many"));
            };
            let dofs = arrays.required(position, nodes.names[1], nodes.dofs, entries)?;
            Ok(Pairs {
                dim,
                pairs: count,
                slaves,
                master_starts,
                masters: shifted(position, nodes.names[1], dofs, base)?,
                weights: arrays.required(position, nodes.names[2], nodes.weights, masters)?,
                normals: arrays.required(position, "normals", given.normals, components)?,
                tangents: arrays.optional(position, "tangents", given.tangents, components)?,
            })
        }
    }

    /// What an older program, which has no general rows, leaves them.
    pub(super) const EMPTY: SignoriniPairs = SignoriniPairs {
        struct_size: 0,
        dim: 0,
        count: 0,
        slaves: std::ptr::null(),
        master_start: std::ptr::null(),
        masters: std::ptr::null(),
        weights: std::ptr::null(),
        normals: std::ptr::null(),
        tangents: std::ptr::null(),
        row_start: std::ptr::null(),
        row_nodes: std::ptr::null(),
        row_weights: std::ptr::null(),
    };

    /// Refuses a size that no version of the structure has.
    fn check_size(&self, position: i32) -> Result<(), Failure> {
        let (told, ours) = (self.struct_size as usize, size_of::<Self>());
        if told == ours || told == offset_of!(Self, row_start) {
            return Ok(());
        }
        let message = format!("pairs: struct_size is {told}, set it to sizeof ({ours})");
        Err(Failure::argument(position, message))
    }

    /// The nodes of the pairs in the one form or the other.
    fn nodes(&self, position: i32) -> Result<Nodes, Failure> {
        let is_general = !self.row_start.is_null();
        let none = |is_null: &[bool]| is_null.iter().all(|is_null| *is_null);
        let slaves = [self.slaves, self.master_start, self.masters].map(<*const i64>::is_null);
        let of_slaves = [slaves[0], slaves[1], slaves[2], self.weights.is_null()];
        let of_rows = [self.row_nodes.is_null(), self.row_weights.is_null()];
        let message = match is_general {
            true if !none(&of_slaves) => {
                "pairs: row_start is set, and slaves, master_start, masters or weights too: leave \
                 these four NULL, or row_start, row_nodes and row_weights"
            }
            false if !none(&of_rows) => {
                "pairs: row_nodes or row_weights is set, but row_start is NULL: set all three, or none"
            }
            true => {
                let names = ["row_start", "row_nodes", "row_weights"];
                let (start, dofs, weights) = (self.row_start, self.row_nodes, self.row_weights);
                return Ok(Nodes { slaves: None, start, dofs, weights, names });
            }
            false => {
                let names = ["master_start", "masters", "weights"];
                let (start, dofs, weights) = (self.master_start, self.masters, self.weights);
                return Ok(Nodes { slaves: Some(self.slaves), start, dofs, weights, names });
            }
        };
        Err(Failure::argument(position, message))
    }
}

/// The arrays that say which nodes are in which pair, and their names for messages.
struct Nodes {
    /// `None`: general rows.
    slaves: Option<*const i64>,
    start: *const i64,
    dofs: *const i64,
    weights: *const f64,
    names: [&'static str; 3],
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
