//! Meshes with fields to files for ParaView.

use libc::c_char;

use super::args::{At, c_entry};
use super::guard::{Outcome, refused};
use super::zones::{SignoriniZone, Zones};
use crate::error::Argument;
use crate::file::{self, Field, Mesh, Values};
use crate::problem;

/// A mesh of yours, to be written to a file. Cells have the types and the order of nodes of VTK: 3
/// line, 5 triangle, 9 quadrilateral, 10 tetrahedron, 12 hexahedron, 13 wedge, 14 pyramid; 21 to 29
/// the quadratic ones.
#[repr(C)]
pub struct SignoriniMesh {
    /// sizeof(signorini_mesh).
    pub struct_size: u32,
    /// Space dimension, 2 or 3.
    pub dim: i32,
    /// Number of nodes.
    pub nodes: i64,
    /// Coordinates, dim for each node.
    pub coordinates: *const f64,
    /// Number of cells, 0 allowed.
    pub cells: i64,
    /// 0 or 1: the number of the first node and of the first entry of cell_start.
    pub index_base: i32,
    /// VTK's type of all cells, if cell_types is NULL; else 0.
    pub cell_type: i32,
    /// VTK's type of each cell; NULL: all have cell_type.
    pub cell_types: *const i32,
    /// Start of each cell in cell_nodes, cells + 1 entries; NULL: the types tell their numbers of
    /// nodes.
    pub cell_start: *const i64,
    /// Nodes of the cells.
    pub cell_nodes: *const i64,
}

/// A field of your own at the nodes of a mesh.
#[repr(C)]
pub struct SignoriniField {
    /// sizeof(signorini_field).
    pub struct_size: u32,
    /// 1: a number for each node; dim: a vector.
    pub components: i32,
    /// Its name in the file, UTF-8.
    pub name: *const c_char,
    /// The values, components for each node.
    pub values: *const f64,
}

/// Writes a mesh with fields at its nodes to a file in VTK's format .vtu, which ParaView opens. The
/// file keeps every bit, infinities too. With contact zones it has pressure, traction, clearance
/// and slip, as signorini_surface_fields gives them, and state where each zone has it. Nodes in no
/// pair have 0 there, and state -1; of a node in several zones the last one counts.
///
/// @param path      name of the file, which is replaced if it exists
/// @param mesh      the mesh; with zones the one whose nodes were paired
/// @param u         displacements of all degrees of freedom, as signorini_model_recover gives them,
///                  up to the largest of node_dofs; without zones dim for each node; NULL: none
/// @param n_zones   number of contact zones, 0 allowed
/// @param zones     the zones, whose pairs number degrees of freedom alike
/// @param n_fields  number of fields of your own, 0 allowed
/// @param fields    these fields
/// @return the status; after SIGNORINI_STATUS_FILE an old file is unchanged
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_mesh_write(
    path: *const c_char,
    mesh: *const SignoriniMesh,
    u: *const f64,
    n_zones: i64,
    zones: *const SignoriniZone,
    n_fields: i64,
    fields: *const SignoriniField,
) -> i32 {
    c_entry!(|arrays| {
        let path = arrays.at(1, "path").path(path)?;
        SignoriniMesh::with(arrays.at(2, "mesh"), mesh, |mesh| {
            let size_of_mesh = (mesh.dim, mesh.node_count());
            let zones = Zones::read(arrays, (n_zones, zones), size_of_mesh)?;
            let at_u = arrays.at(3, "u");
            let displacement = match &zones {
                Some(zones) => zones.displacement(at_u, u)?,
                None => at_u.optional(u, mesh.coordinates.len())?.map(<[f64]>::to_vec),
            };
            let displacement = displacement.iter();
            let displacement =
                displacement.map(|u| Field { name: "displacement", values: Values::Vectors(u) });
            let of_zones = zones.iter().flat_map(Zones::fields);
            let mut written: Vec<Field<'_>> = displacement.chain(of_zones).collect();
            let (n_fields, at) = (arrays.at(6, "n_fields").size(n_fields)?, arrays.at(7, "fields"));
            for field in at.all(fields, n_fields)? {
                written.push(own_field(at, field, size_of_mesh)?);
            }
            let position = |wrong| if wrong == Argument::Fields { 7 } else { 2 };
            file::write_vtu(path, mesh, &written).map_err(refused(position))?;
            Ok(0)
        })
    })
}

impl SignoriniMesh {
    /// Hands over the caller's mesh with nodes counted from 0.
    fn with<T>(
        at: At<'_>,
        pointer: *const Self,
        to: impl FnOnce(&Mesh<'_>) -> Outcome<T>,
    ) -> Outcome<T> {
        let given = at.whole(pointer)?;
        let dim = problem::checked_dim(given.dim).or_else(|error| at.refuse_error(&error))?;
        let nodes = at.field("nodes").size(given.nodes)?;
        let cells = at.field("cells").size(given.cells)?;
        let base = at.index_base(given.index_base)?;
        let (Some(length), Some(ends)) = (nodes.checked_mul(dim), cells.checked_add(1)) else {
            return at.refuse_part(format!("{nodes} nodes or {cells} cells are too many"));
        };
        let coordinates = at.named("coordinates").required(given.coordinates, length)?;
        let told = at.named("cell_types").optional(given.cell_types, cells)?;
        let types = told.map_or_else(|| vec![given.cell_type; cells], <[i32]>::to_vec);
        let start = match at.named("cell_start").optional(given.cell_start, ends)? {
            Some(start) => at.field("cell_start").shifted(start, base)?,
            None => starts_of(at, &types)?,
        };
        let nodes = at.named("cell_nodes").required(given.cell_nodes, start[cells])?;
        let nodes = at.field("cell_nodes").shifted(nodes, base)?;
        let types: Result<Vec<u8>, _> = types.iter().map(|kind| u8::try_from(*kind)).collect();
        let types = types.or_else(|_| at.refuse_part("a type is none of VTK's"))?;
        to(&Mesh { dim, coordinates, types: &types, start: &start, nodes: &nodes })
    }
}

/// Starts of cells from their types.
fn starts_of(at: At<'_>, types: &[i32]) -> Outcome<Vec<usize>> {
    let mut start = vec![0];
    for kind in types {
        let Some(nodes) = file::nodes_of_type(*kind) else {
            return at.refuse_part(format!(
                "the number of nodes of type {kind} is not known, set cell_start"
            ));
        };
        start.push(start[start.len() - 1] + nodes);
    }
    Ok(start)
}

/// A field of the caller.
fn own_field<'a>(
    at: At<'a>,
    field: &'a SignoriniField,
    (dim, nodes): (usize, usize),
) -> Outcome<Field<'a>> {
    let Some(name) = at.field("a name").text(field.name)? else {
        return at.refuse_part("a name is NULL");
    };
    let components = usize::try_from(field.components).unwrap_or_default();
    if components != 1 && components != dim {
        let given = field.components;
        return at.refuse_part(format!("{name} has {given} components, it needs 1 or {dim}"));
    }
    let values = at.named("values").required(field.values, components * nodes)?;
    let values = match components {
        1 => Values::Scalars(values),
        _ => Values::Vectors(values),
    };
    Ok(Field { name, values })
}
