//! Meshes with fields to files for ParaView.

use libc::c_char;

use super::args::{Arrays, c_entry, size};
use super::guard::Failure;
use super::sparse::shifted;
use super::structures;
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
        let path = arrays.path(1, path)?;
        SignoriniMesh::with(arrays, 2, mesh, |arrays, mesh| {
            let size_of_mesh = (mesh.dim, mesh.node_count());
            let zones = Zones::read(arrays, (n_zones, zones), size_of_mesh)?;
            let displacement = match &zones {
                Some(zones) => zones.displacement(arrays, u)?,
                None => arrays.optional(3, "u", u, mesh.coordinates.len())?.map(<[f64]>::to_vec),
            };
            let displacement = displacement.iter();
            let displacement =
                displacement.map(|u| Field { name: "displacement", values: Values::Vectors(u) });
            let of_zones = zones.iter().flat_map(Zones::fields);
            let mut written: Vec<Field<'_>> = displacement.chain(of_zones).collect();
            for field in arrays.all(7, "fields", fields, size(6, "n_fields", n_fields)?)? {
                written.push(own_field(arrays, field, size_of_mesh)?);
            }
            file::write_vtu(path, mesh, &written).map_err(|error| {
                let at = |wrong| if wrong == Argument::Fields { 7 } else { 2 };
                Failure::from_error(error, at)
            })?;
            Ok(0)
        })
    })
}

impl SignoriniMesh {
    /// Hands over the caller's mesh with nodes counted from 0.
    fn with<T>(
        arrays: &mut Arrays<'_>,
        position: i32,
        pointer: *const Self,
        to: impl FnOnce(&mut Arrays<'_>, &Mesh<'_>) -> Result<T, Failure>,
    ) -> Result<T, Failure> {
        let wrong = |message: String| Failure::argument(position, message);
        let given = arrays.whole(position, "mesh", pointer)?;
        let dim = problem::checked_dim(given.dim)
            .map_err(|error| wrong(format!("mesh: {}", error.message())))?;
        let nodes = size(position, "mesh: nodes", given.nodes)?;
        let cells = size(position, "mesh: cells", given.cells)?;
        let base = structures::index_base(position, "mesh", given.index_base)?;
        let (Some(length), Some(ends)) = (nodes.checked_mul(dim), cells.checked_add(1)) else {
            return Err(wrong(format!("mesh: {nodes} nodes or {cells} cells are too many")));
        };
        let coordinates = arrays.required(position, "coordinates", given.coordinates, length)?;
        let told = arrays.optional(position, "cell_types", given.cell_types, cells)?;
        let types = told.map_or_else(|| vec![given.cell_type; cells], <[i32]>::to_vec);
        let start = arrays.optional(position, "cell_start", given.cell_start, ends)?;
        let start = match start {
            Some(start) => shifted(position, "mesh: cell_start", start, base)?,
            None => starts_of(&types).map_err(wrong)?,
        };
        let nodes = arrays.required(position, "cell_nodes", given.cell_nodes, start[cells])?;
        let nodes = shifted(position, "mesh: cell_nodes", nodes, base)?;
        let types: Result<Vec<u8>, _> = types.iter().map(|kind| u8::try_from(*kind)).collect();
        let types = types.map_err(|_| wrong("mesh: a type is none of VTK's".into()))?;
        to(arrays, &Mesh { dim, coordinates, types: &types, start: &start, nodes: &nodes })
    }
}

/// Starts of cells from their types.
fn starts_of(types: &[i32]) -> Result<Vec<usize>, String> {
    let mut start = vec![0];
    for kind in types {
        let Some(nodes) = file::nodes_of_type(*kind) else {
            return Err(format!(
                "mesh: the number of nodes of type {kind} is not known, set cell_start"
            ));
        };
        start.push(start[start.len() - 1] + nodes);
    }
    Ok(start)
}

/// A field of the caller.
fn own_field<'h>(
    arrays: &mut Arrays<'h>,
    field: &'h SignoriniField,
    (dim, nodes): (usize, usize),
) -> Result<Field<'h>, Failure> {
    let Some(name) = arrays.text(7, "fields: a name", field.name)? else {
        return Err(Failure::argument(7, "fields: a name is NULL"));
    };
    let components = usize::try_from(field.components).unwrap_or_default();
    if components != 1 && components != dim {
        let message =
            format!("fields: {name} has {} components, it needs 1 or {dim}", field.components);
        return Err(Failure::argument(7, message));
    }
    let values = arrays.required(7, "values", field.values, components * nodes)?;
    let values = match components {
        1 => Values::Scalars(values),
        _ => Values::Vectors(values),
    };
    Ok(Field { name, values })
}
