//! Contact zones with their solutions, as fields at all nodes of a mesh.

use super::args::{Arrays, At};
use super::guard::{Failure, Outcome, refused};
use super::surface_fields::{pair_results, scatter};
use super::surface_new::SignoriniSurfacePairs;
use crate::error::index;
use crate::file::{Field, Values};
use crate::surface::NodalFields;

/// A contact zone with its solution, for signorini_mesh_write.
#[repr(C)]
#[derive(Clone, Copy)]
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
    states: Vec<i32>,
    has_states: bool,
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
            let refuse = |message: String| at.refuse(format!("{}: {message}", index(number)));
            let within = |failure: Failure| failure.within(&format!("zones {}", index(number)));
            if zone.reserved != 0 {
                return refuse(format!("reserved is {}, it must be 0", zone.reserved));
            }
            let contact = at.named("contact").handle(zone.contact).map_err(within)?;
            let of = (contact.found.dim, contact.nodes);
            if of != (dim, nodes) {
                let (of_dim, of_nodes) = of;
                return refuse(format!(
                    "its pairs are of {of_nodes} nodes of dim {of_dim}, the mesh has {nodes} nodes of dim {dim}"
                ));
            }
            let all = all.get_or_insert_with(|| Zones::empty(contact));
            if contact.dofs() != all.dofs {
                let wrong = "it numbers degrees of freedom otherwise than the first zone";
                return refuse(wrong.into());
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
            states: vec![NO_STATE; nodes],
            has_states: true,
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
        let state = arrays.at(ZONES, "state").optional(zone.state, contact.arrays.count)?;
        let found = contact.found.fields(&results).map_err(refused(|_| ZONES))?;
        let NodalFields { nodes, pairs, pressure, traction, clearance, slip } = &found;
        for (all, values) in self.reals.iter_mut().zip([pressure, clearance, traction, slip]) {
            scatter(nodes, values, |at, of_node| {
                all[at..at + of_node.len()].copy_from_slice(of_node);
            });
        }
        // A zone without pairs has no states to give.
        self.has_states &= !zone.state.is_null() || contact.arrays.count == 0;
        if let Some(state) = state {
            nodes.iter().zip(pairs).for_each(|(node, pair)| self.states[*node] = state[*pair]);
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
        let states = self.has_states.then_some(("state", Values::Integers(&self.states)));
        reals.into_iter().chain(states).map(|(name, values)| Field { name, values })
    }
}
