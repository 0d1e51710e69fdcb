//! The structures by which a host hands over its contact pairs, with equations between degrees of freedom.

use std::mem::offset_of;

use super::args::At;
use super::guard::Outcome;
use super::structures::Structure;
use crate::problem;
use crate::reduce::{ContactPairs, Equations};

/// Contact pairs: each has a slave node, a point that faces it, and a normal. The point is
/// interpolated between master nodes on other bodies; without masters it is on a rigid obstacle:
///     u_slave = sum of weight * u_master + n d_n + t d_t      (3D: + t1 d_t1 + t2 d_t2)
///
/// General rows, as of mortar methods: slaves, master_start, masters and weights are NULL, and
/// n d_n + t d_t = sum of row_weight * u over nodes or, as of rigid bodies, of row_vector * u over
/// degrees of freedom.
///
/// A node may stand in any number of pairs, as slave and master, and be fixed. Where a pair is held
/// along its normal or a tangent, d and F are zero there, and prescribed values that move it are
/// refused. Pairs may depend on each other, as those of a node on two planes: then contact forces
/// are not unique.
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
        at: At<'_>,
        pointer: *const Self,
        base: i64,
        to: impl FnOnce(&ContactPairs<'_>) -> Outcome<T>,
    ) -> Outcome<T> {
        let given = at.required_copy(pointer)?;
        let dim = problem::checked_dim(given.dim).or_else(|error| at.refuse_error(&error))?;
        let count = at.field("count").size(given.count)?;
        let components = problem::unknowns(dim, count).or_else(|error| at.refuse_error(&error))?;
        let nodes = given.nodes(at)?;
        let [at_start, at_dofs, at_numbers] = nodes.names.map(|name| at.named(name));
        let slaves = match nodes.slaves {
            Some(slaves) => at.named("slaves").indices(slaves, components, base)?,
            None => Vec::new(),
        };
        let master_starts = match at_start.optional(nodes.start, count + 1)? {
            Some(starts) => at_start.shifted(starts, base)?,
            None if nodes.dofs.is_null() && nodes.numbers.is_null() => vec![0; count + 1],
            None => {
                return at.refuse_part(
                    "master_start is NULL, but masters or weights is not: set \
                     master_start, or all three to NULL for rigid obstacles",
                );
            }
        };
        // The last start gives the lengths of masters and weights; Model::sparse checks the
        // other starts.
        let masters = master_starts[count];
        let Some(entries) = masters.checked_mul(dim) else {
            return at.refuse_part(format!("{masters} masters are too many"));
        };
        let (dofs, numbers) = if nodes.by_dof { (masters, entries) } else { (entries, masters) };
        let dofs = at_dofs.required(nodes.dofs, dofs)?;
        let numbers = at_numbers.required(nodes.numbers, numbers)?;
        let ([dependent, start, terms], coefficients) =
            SignoriniEquations::read(at.named("equations"), given.equations, base)?;
        let pairs = ContactPairs {
            dim,
            count,
            slaves: &slaves,
            master_start: &master_starts,
            masters: &at_dofs.shifted(dofs, base)?,
            weights: if nodes.by_dof { &[] } else { numbers },
            vectors: nodes.by_dof.then_some(numbers),
            normals: at.named("normals").required(given.normals, components)?,
            tangents: at.named("tangents").optional(given.tangents, components)?,
            equations: Equations {
                dependent: &dependent,
                start: &start,
                dofs: &terms,
                coefficients,
            },
        };
        to(&pairs)
    }

    /// The nodes of the pairs in one of the forms.
    fn nodes(&self, at: At<'_>) -> Outcome<Nodes> {
        let is_given = |arrays: &[*const i64], numbers: &[*const f64]| {
            numbers.iter().any(|array| !array.is_null())
                || arrays.iter().any(|array| !array.is_null())
        };
        let of_slaves = is_given(&[self.slaves, self.master_start, self.masters], &[self.weights]);
        let of_rows = is_given(&[self.row_nodes], &[self.row_weights, self.row_vectors]);
        let by_dof = !self.row_vectors.is_null();
        let (row_numbers, name) = match by_dof {
            true => (self.row_vectors, "row_vectors"),
            false => (self.row_weights, "row_weights"),
        };
        match (self.row_start.is_null(), of_slaves, of_rows) {
            (false, true, _) => at.refuse_part(
                "row_start is set, and slaves, master_start, masters or weights too: leave \
                 these four NULL, or row_start, row_nodes and row_weights",
            ),
            (true, _, true) => at.refuse_part(
                "row_nodes, row_weights or row_vectors is set, but row_start is NULL: set row_start, \
                 row_nodes and one of the two others, or none",
            ),
            (false, false, _) if by_dof && !self.row_weights.is_null() => at.refuse_part(
                "row_weights and row_vectors are set: leave row_vectors NULL for rows of nodes, \
                 row_weights for rows by degree of freedom",
            ),
            (false, false, _) => Ok(Nodes {
                slaves: None,
                start: self.row_start,
                dofs: self.row_nodes,
                numbers: row_numbers,
                by_dof,
                names: ["row_start", "row_nodes", name],
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

/// Equations u[dependent] = sum of coefficient * u[dof], without terms 0: constraints, rigid
/// bodies, turned axes, cyclic sectors. Pairs may name dependents. Those of K are eliminated, with
/// their loads; others have any number. Contact forces come out on the rest.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniEquations {
    /// sizeof(signorini_equations).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// Number of equations.
    pub count: i64,
    /// One of each equation, not in fixed.
    pub dependent: *const i64,
    /// Start of each equation's terms, as master_start.
    pub start: *const i64,
    /// Degree of freedom of each term.
    pub dofs: *const i64,
    /// Of each term.
    pub coefficients: *const f64,
}

// SAFETY: led by its size; numbers and pointers.
unsafe impl Structure for SignoriniEquations {}

impl SignoriniEquations {
    /// Dependents, starts and degrees of freedom of the caller's equations, counted from 0, and coefficients; none if
    /// the pointer is NULL.
    fn read(at: At<'_>, pointer: *const Self, base: i64) -> Outcome<([Vec<usize>; 3], &[f64])> {
        if pointer.is_null() {
            return Ok(Default::default());
        }
        let given = at.required_copy(pointer)?;
        at.check_reserved(given.reserved)?;
        let count = at.field("count").size(given.count)?;
        if count == 0 {
            return Ok(Default::default());
        }
        let dependent = at.field("dependent").indices(given.dependent, count, base)?;
        let start = at.field("start").indices(given.start, count.saturating_add(1), base)?;
        let terms = start[count];
        let dofs = at.field("dofs").indices(given.dofs, terms, base)?;
        let coefficients = at.field("coefficients").required(given.coefficients, terms)?;
        Ok(([dependent, start, dofs], coefficients))
    }
}
