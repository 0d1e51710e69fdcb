//! The structure by which a host hands over its contact pairs.

use std::mem::offset_of;

use super::args::{Arrays, size};
use super::equations::SignoriniEquations;
use super::guard::Failure;
use super::sparse::shifted;
use super::structures::Structure;
use crate::error::Error;
use crate::problem;
use crate::reduce::ContactPairs;

/// Contact pairs: each has a slave node, a point that faces it, and a normal. The point is
/// interpolated between master nodes on other bodies; without masters it is on a rigid obstacle.
/// The gap is closed at d_n = gap:
///     u_slave = sum of weight * u_master + n d_n + t d_t      (3D: + t1 d_t1 + t2 d_t2)
///
/// General rows, as of mortar methods: slaves, master_start, masters and weights are NULL, and
/// n d_n + t d_t = sum of row_weight * u over nodes or, as of rigid bodies, of row_vector * u over
/// degrees of freedom.
///
/// A node may stand in any number of pairs, as slave and master, and be fixed. Where a pair is held
/// along its normal or a tangent, d and F are zero there. Pairs may depend on each other, as
/// those of a node on two planes: then contact forces are not unique.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniPairs {
    /// sizeof(signorini_pairs).
    pub struct_size: u32,
    /// Space dimension, 2 or 3.
    pub dim: i32,
    /// Number of pairs.
    pub count: i64,
    /// Degrees of freedom of each slave node, in the order of the axes.
    pub slaves: *const i64,
    /// Start of each pair's masters, count + 1 entries from index_base. NULL: no pair has any.
    pub master_start: *const i64,
    /// Those of each master node.
    pub masters: *const i64,
    /// Weight of each master node, negative ones too; those of a pair sum to 1.
    pub weights: *const f64,
    /// Normal of each pair, dim entries, outward from the slave's body, of any length.
    pub normals: *const f64,
    /// First tangent of each pair, dim entries, orthogonal to the normal to 1e-5; t2 = n x t1. NULL:
    /// chosen. 2D: n turned by +90 degrees. 3D: as supports hold, else e x n, e the first axis most
    /// across n.
    pub tangents: *const f64,
    /// General rows: start of each pair's nodes, as master_start; else NULL.
    pub row_start: *const i64,
    /// Those of each node.
    pub row_nodes: *const i64,
    /// Weight of each node: positive on the side whose outward normal is given, else negative.
    /// Those of a pair sum to 0, and against a rigid obstacle to 1.
    pub row_weights: *const f64,
    /// dim numbers for each of row_nodes, which are degrees of freedom then; row_weights is NULL.
    pub row_vectors: *const f64,
    /// NULL: none.
    pub equations: *const SignoriniEquations,
}

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniPairs {
    // Without general rows; without those by degree of freedom.
    const OLDER: &'static [usize] = &[offset_of!(Self, row_start), offset_of!(Self, row_vectors)];
}

impl SignoriniPairs {
    /// Hands over the caller's pairs with degrees of freedom counted from 0.
    pub(super) fn with<T>(
        arrays: &mut Arrays<'_>,
        position: i32,
        pointer: *const Self,
        base: i64,
        to: impl FnOnce(&mut Arrays<'_>, &ContactPairs<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let refuse = |message: String| Err(Failure::argument(position, message));
        let given = arrays.required_copy(position, "pairs", pointer)?;
        let wrong = |error: Error| {
            Failure::argument(position, format!("pairs: {}", error.message().marked()))
        };
        let dim = problem::checked_dim(given.dim).map_err(wrong)?;
        let count = size(position, "pairs: count", given.count)?;
        let components = problem::unknowns(dim, count).map_err(wrong)?;
        let nodes = given.nodes(position)?;
        let (slaves, length) =
            nodes.slaves.map_or((std::ptr::null(), 0), |slaves| (slaves, components));
        let slaves = arrays.required(position, "slaves", slaves, length)?;
        let slaves = shifted(position, "slaves", slaves, base)?;
        let starts = arrays.optional(position, nodes.names[0], nodes.start, count + 1)?;
        let master_starts = match starts {
            Some(starts) => shifted(position, nodes.names[0], starts, base)?,
            None if nodes.dofs.is_null() && nodes.numbers.is_null() => vec![0; count + 1],
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
        let (dofs, numbers) = if nodes.by_dof { (masters, entries) } else { (entries, masters) };
        let dofs = arrays.required(position, nodes.names[1], nodes.dofs, dofs)?;
        let numbers = arrays.required(position, nodes.names[2], nodes.numbers, numbers)?;
        let equations = SignoriniEquations::read(arrays, position, given.equations, base)?;
        let pairs = ContactPairs {
            dim,
            count,
            slaves: &slaves,
            master_start: &master_starts,
            masters: &shifted(position, nodes.names[1], dofs, base)?,
            weights: if nodes.by_dof { &[] } else { numbers },
            vectors: nodes.by_dof.then_some(numbers),
            normals: arrays.required(position, "normals", given.normals, components)?,
            tangents: arrays.optional(position, "tangents", given.tangents, components)?,
            equations: equations.view(),
        };
        to(arrays, &pairs)
    }

    /// The nodes of the pairs in one of the forms.
    fn nodes(&self, position: i32) -> Result<Nodes, Failure> {
        let is_given = |arrays: &[*const i64], numbers: &[*const f64]| {
            numbers.iter().any(|array| !array.is_null())
                || arrays.iter().any(|array| !array.is_null())
        };
        let of_slaves = is_given(&[self.slaves, self.master_start, self.masters], &[self.weights]);
        let of_rows = is_given(&[self.row_nodes], &[self.row_weights, self.row_vectors]);
        let by_dof = !self.row_vectors.is_null();
        let refuse = |message: &str| Err(Failure::argument(position, message));
        match (self.row_start.is_null(), of_slaves, of_rows) {
            (false, true, _) => refuse(
                "pairs: row_start is set, and slaves, master_start, masters or weights too: leave \
                 these four NULL, or row_start, row_nodes and row_weights",
            ),
            (true, _, true) => refuse(
                "pairs: row_nodes, row_weights or row_vectors is set, but row_start is NULL: set row_start, \
                 row_nodes and one of the two others, or none",
            ),
            (false, false, _) if by_dof && !self.row_weights.is_null() => refuse(
                "pairs: row_weights and row_vectors are set: leave row_vectors NULL for rows of nodes, \
                 row_weights for rows by degree of freedom",
            ),
            (false, false, _) => Ok(Nodes {
                slaves: None,
                start: self.row_start,
                dofs: self.row_nodes,
                numbers: if by_dof { self.row_vectors } else { self.row_weights },
                by_dof,
                names: [
                    "row_start",
                    "row_nodes",
                    if by_dof { "row_vectors" } else { "row_weights" },
                ],
            }),
            (true, _, false) => Ok(Nodes {
                slaves: Some(self.slaves),
                start: self.master_start,
                dofs: self.masters,
                numbers: self.weights,
                by_dof: false,
                names: ["master_start", "masters", "weights"],
            }),
        }
    }
}

/// The arrays that say what is in which pair, and their names for messages.
struct Nodes {
    /// `None`: general rows.
    slaves: Option<*const i64>,
    start: *const i64,
    dofs: *const i64,
    /// Weights of nodes or, in rows by degree of freedom, their vectors.
    numbers: *const f64,
    by_dof: bool,
    names: [&'static str; 3],
}
