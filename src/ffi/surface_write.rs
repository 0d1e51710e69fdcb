//! The fields of one contact zone with its mesh to a file for ParaView.

use libc::c_char;

use super::args::{self, Arrays};
use super::guard::{self, Failure};
use super::mesh::{Mesh, SignoriniMesh};
use super::surface_fields::{pair_results, read, wrong};
use super::surface_new::SignoriniSurfacePairs;
use crate::file::{Field, Values};
use crate::surface::NodalFields;

/// Writes a mesh with the displacements and the fields of one contact zone to a file, as
/// signorini_mesh_write does. Nodes that stand in no pair have pressure, traction, slip and
/// clearance 0 and state -1.
///
/// @param contact  the pairs
/// @param path     name of the file, which is replaced if it exists
/// @param mesh     the mesh whose nodes were paired
/// @param gap      gaps, one for each pair; NULL: those of the pairs
/// @param slip0    reference slip, dim - 1 for each pair; NULL: zero
/// @param u        displacements of all degrees of freedom, as signorini_model_recover tells them;
///                 NULL: none
/// @param d        relative displacements, N = dim * pairs
/// @param F        contact forces, N
/// @param state    SIGNORINI_STATE_... of each pair; NULL: no states
/// @return as signorini_mesh_write
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_surface_write(
    contact: *const SignoriniSurfacePairs,
    path: *const c_char,
    mesh: *const SignoriniMesh,
    gap: *const f64,
    slip0: *const f64,
    u: *const f64,
    d: *const f64,
    F: *const f64,
    state: *const i32,
) -> i32 {
    guard::call(|| {
        // SAFETY: pairs, structures and arrays as the header demands.
        unsafe {
            let contact = read(contact)?;
            let path = args::path(2, path)?;
            let mesh = Mesh::read(3, mesh)?;
            check_nodes(&mesh, contact)?;
            let mut arrays = Arrays::default();
            let results = pair_results(&mut arrays, contact, (4, gap), (5, slip0), (7, d), (8, F))?;
            let state = arrays.optional(9, "state", state, contact.arrays.count)?;
            let dofs = contact.dofs();
            let entries = dofs.iter().max().map_or(0, |last| last + 1);
            let u = arrays.optional(6, "u", u, entries)?;
            let u: Option<Vec<f64>> = u.map(|u| dofs.iter().map(|dof| u[*dof]).collect());
            let zone = Zone::new(contact, &contact.found.fields(&results).map_err(wrong)?, state);
            let displacement =
                u.iter().map(|u| Field { name: "displacement", values: Values::Vectors(u) });
            let fields: Vec<Field<'_>> = displacement.chain(zone.fields()).collect();
            mesh.write(path, &fields, (3, 3))
        }
    })
}

/// Fields of one contact zone at all nodes.
struct Zone {
    scalars: [Vec<f64>; 2],
    vectors: [Vec<f64>; 2],
    states: Option<Vec<i32>>,
}

impl Zone {
    fn new(contact: &SignoriniSurfacePairs, found: &NodalFields, state: Option<&[i32]>) -> Self {
        let (nodes, dim) = (contact.nodes, contact.found.dim);
        let spread = |values: &[f64], each: usize| {
            let mut all = vec![0.0; each * nodes];
            for (node, of_node) in found.nodes.iter().zip(values.chunks(each)) {
                all[each * node..each * (node + 1)].copy_from_slice(of_node);
            }
            all
        };
        let states = state.map(|state| {
            let mut all = vec![NO_STATE; nodes];
            found.nodes.iter().zip(&found.pairs).for_each(|(node, pair)| all[*node] = state[*pair]);
            all
        });
        Zone {
            scalars: [spread(&found.pressure, 1), spread(&found.clearance, 1)],
            vectors: [spread(&found.traction, dim), spread(&found.slip, dim)],
            states,
        }
    }

    fn fields(&self) -> impl Iterator<Item = Field<'_>> {
        let ([pressure, clearance], [traction, slip]) = (&self.scalars, &self.vectors);
        let reals = [
            ("pressure", Values::Scalars(pressure)),
            ("clearance", Values::Scalars(clearance)),
            ("traction", Values::Vectors(traction)),
            ("slip", Values::Vectors(slip)),
        ];
        let states = self.states.iter().map(|states| ("state", Values::Integers(states)));
        reals.into_iter().chain(states).map(|(name, values)| Field { name, values })
    }
}

/// The state of a node that stands in no pair.
const NO_STATE: i32 = -1;

/// Refuses another mesh than that of the pairs.
fn check_nodes(mesh: &Mesh<'_>, contact: &SignoriniSurfacePairs) -> Result<(), Failure> {
    let (nodes, dim) = (contact.nodes, contact.found.dim);
    if mesh.dim == dim && mesh.nodes() == nodes {
        return Ok(());
    }
    let (given, of) = (mesh.nodes(), mesh.dim);
    let message =
        format!("mesh has {given} nodes of dim {of}, the pairs are of {nodes} nodes of dim {dim}");
    Err(Failure::argument(3, message))
}
