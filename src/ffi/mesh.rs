//! Meshes with fields, those of contact zones with their solutions among them, to files for ParaView.

use libc::c_char;

use super::args::{Arrays, At, c_entry};
use super::guard::Outcome;
use super::surface_fields::{pair_results, scatter};
use super::surface_new::SignoriniSurfacePairs;
use crate::error::Argument;
use crate::file::{self, Field, Mesh, Values};
use crate::problem;
use crate::surface::NodalFields;

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
    /// Its name in the file, UTF-8; another one than those that the call writes by itself:
    /// displacement, pressure, traction, clearance, slip, state.
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
            let values = displacement.as_deref().map(Values::Vectors).into_iter();
            let displacement = values.map(|values| Field { name: "displacement", values });
            let of_zones = zones.iter().flat_map(Zones::fields);
            let mut written: Vec<Field<'_>> = displacement.chain(of_zones).collect();
            let n_fields = arrays.at(6, "n_fields").size(n_fields)?;
            let at = arrays.at(7, "fields").is(Argument::Fields);
            for field in at.all(fields, n_fields)? {
                written.push(own_field(at, field, size_of_mesh)?);
            }
            file::write_vtu(path, mesh, &written).map_err(arrays.refused(2))?;
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

/// A contact zone with its solution, for signorini_mesh_write.
#[repr(C)]
pub struct SignoriniZone {
    /// sizeof(signorini_zone).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// The pairs.
    pub contact: *const SignoriniSurfacePairs,
    /// Gaps, one for each pair; NULL: those of the pairs.
    pub gap: *const f64,
    /// Reference slip, dim - 1 for each pair; NULL: zero.
    pub slip0: *const f64,
    /// Relative displacements, N = dim * pairs.
    pub d: *const f64,
    /// Contact forces, N.
    pub F: *const f64,
    /// SIGNORINI_STATE_... of each pair; NULL: no states.
    pub state: *const i32,
}

/// Number of the zones among the arguments.
const ZONES: i32 = 5;

/// The state of a node that stands in no pair.
const NO_STATE: i32 = -1;

/// Fields of the zones at all nodes.
pub(super) struct Zones {
    /// Degrees of freedom of all nodes.
    dofs: Vec<usize>,
    /// Pressure, clearance, traction and slip.
    reals: [Vec<f64>; 4],
    /// `None` if a zone has none.
    states: Option<Vec<i32>>,
}

impl Zones {
    /// The fields of the caller's zones on a mesh of so many dimensions and nodes; `None` of no
    /// zones.
    pub(super) fn read(
        arrays: &Arrays,
        (count, zones): (i64, *const SignoriniZone),
        (dim, nodes): (usize, usize),
    ) -> Outcome<Option<Self>> {
        let count = arrays.at(ZONES - 1, "n_zones").size(count)?;
        let at = arrays.at(ZONES, "zones");
        let mut all: Option<Zones> = None;
        for (number, zone) in at.all(zones, count)?.into_iter().enumerate() {
            let at = at.number(number);
            at.check_reserved(zone.reserved)?;
            let contact = at.field("contact").handle(zone.contact)?;
            let of = (contact.found.dim, contact.nodes);
            if of != (dim, nodes) {
                let (of_dim, of_nodes) = of;
                return at.refuse_part(format!(
                    "its pairs are of {of_nodes} nodes of dim {of_dim}, the mesh has {nodes} nodes of dim {dim}"
                ));
            }
            let all = all.get_or_insert_with(|| Zones::empty(contact));
            if contact.dofs() != all.dofs {
                let wrong = "it numbers degrees of freedom otherwise than the first zone";
                return at.refuse_part(wrong);
            }
            all.add(arrays, contact, zone)?;
        }
        Ok(all)
    }

    fn empty(contact: &SignoriniSurfacePairs) -> Self {
        let (nodes, dim) = (contact.nodes, contact.found.dim);
        Zones {
            dofs: contact.dofs(),
            reals: [1, 1, dim, dim].map(|each| vec![0.0; each * nodes]),
            states: Some(vec![NO_STATE; nodes]),
        }
    }

    /// Adds the fields of a zone.
    fn add(
        &mut self,
        arrays: &Arrays,
        contact: &SignoriniSurfacePairs,
        zone: &SignoriniZone,
    ) -> Outcome<()> {
        let given = [zone.gap, zone.slip0, zone.d, zone.F];
        let results = pair_results(arrays, contact, [ZONES; 4], given)?;
        let at_state = arrays.at(ZONES, "state");
        let state = at_state.optional(zone.state, contact.arrays.count)?;
        state.map(|codes| at_state.states(codes)).transpose()?;
        let found = contact.found.fields(&results).map_err(arrays.refused(ZONES))?;
        let NodalFields { nodes, pairs, pressure, traction, clearance, slip } = &found;
        for (all, values) in self.reals.iter_mut().zip([pressure, clearance, traction, slip]) {
            scatter(nodes, values, |at, of_node| {
                all[at..at + of_node.len()].copy_from_slice(of_node);
            });
        }
        if let (Some(states), Some(state)) = (&mut self.states, state) {
            nodes.iter().zip(pairs).for_each(|(node, pair)| states[*node] = state[*pair]);
        }
        // A zone without pairs has no states to give.
        if zone.state.is_null() && contact.arrays.count > 0 {
            self.states = None;
        }
        Ok(())
    }

    /// Displacements of all nodes, from those of the host's degrees of freedom.
    pub(super) fn displacement(&self, at: At<'_>, u: *const f64) -> Outcome<Option<Vec<f64>>> {
        let entries = self.dofs.iter().max().map_or(0, |last| last + 1);
        let u = at.optional(u, entries)?;
        Ok(u.map(|u| self.dofs.iter().map(|dof| u[*dof]).collect()))
    }

    /// The fields under their names.
    pub(super) fn fields(&self) -> impl Iterator<Item = Field<'_>> {
        let [pressure, clearance, traction, slip] = &self.reals;
        let reals = [
            ("pressure", Values::Scalars(pressure)),
            ("clearance", Values::Scalars(clearance)),
            ("traction", Values::Vectors(traction)),
            ("slip", Values::Vectors(slip)),
        ];
        let states = self.states.as_ref().map(|states| ("state", Values::Integers(states)));
        reals.into_iter().chain(states).map(|(name, values)| Field { name, values })
    }
}
