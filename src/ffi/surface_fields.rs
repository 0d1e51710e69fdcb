//! After a solution on pairs from surfaces: pressure, traction, clearance and slip, their resultant, and what has passed
//! through the other side without a pair.

use std::ptr::null;

use super::args::{Arrays, c_entry};
use super::guard::Outcome;
use super::structures::Structure;
use super::surface_new::SignoriniSurfacePairs;
use crate::error::Argument;
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::surface::{NodalFields, PairResults, Penetration};

/// Fields at the nodes of your mesh. Set struct_size, and the pointers of the arrays that you want.
/// A call writes the nodes in pairs of its contact, on both sides, and leaves the others as they
/// are: set them before, and give the same arrays to the calls of all contact zones. Vectors are in
/// the axes of the mesh. A slave node has the values of its pair; other nodes have means over their
/// pairs, weighted by area and the size of their weights.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniContactFields {
    /// sizeof(signorini_contact_fields).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// Out: contact pressure, one for each node; positive presses; force / area.
    pub pressure: *mut f64,
    /// Out: force of the contact on the node's own body over area, dim for each node.
    pub traction: *mut f64,
    /// Out: gap - d_n, one for each node; positive if open; length.
    pub clearance: *mut f64,
    /// Out: motion along the surface against the other body since slip0, dim for each node; length.
    pub slip: *mut f64,
    /// Out: SIGNORINI_STATE_..., one for each node: of its pair, or of the pair of its largest
    /// share.
    pub state: *mut i32,
}

// SAFETY: led by its size; a number and pointers.
unsafe impl Structure for SignoriniContactFields {}

/// Sums over a contact zone. Set struct_size before the call; the call writes all other fields. Of
/// bodies of revolution they are those of whole rings: of the force its part along the axis is
/// left, and no moment.
#[repr(C)]
pub struct SignoriniResultant {
    /// sizeof(signorini_resultant).
    pub struct_size: u32,
    /// 0.
    pub reserved: i32,
    /// Force of the contact on the slave's body; in 2D the third entry is 0.
    pub force: [f64; 3],
    /// Its moment about the given point; in 2D the third entry alone.
    pub moment: [f64; 3],
    /// Work that friction takes in the step, sum of -F_t . (d_t - slip0), with the forces of its
    /// end.
    pub friction_work: f64,
    /// Area of the pairs that press.
    pub pressed_area: f64,
}

/// Pressure, traction, clearance and slip at the nodes of both sides.
///
/// @param contact  the pairs
/// @param gap      gaps, one for each pair; NULL: those of the pairs
/// @param slip0    reference slip, dim - 1 for each pair; NULL: zero
/// @param d        relative displacements, N = dim * pairs
/// @param F        contact forces, N
/// @param state    SIGNORINI_STATE_... of each pair; may be NULL if fields->state is
/// @param fields   out: the arrays of the fields
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_fields(
    contact: *const SignoriniSurfacePairs,
    gap: *const f64,
    slip0: *const f64,
    d: *const f64,
    F: *const f64,
    state: *const i32,
    fields: *const SignoriniContactFields,
) -> i32 {
    c_entry!(|arrays| {
        let contact = arrays.at(1, "contact").handle(contact)?;
        let results = pair_results(arrays, contact, [2, 3, 4, 5], [gap, slip0, d, F])?;
        let (count, at_state) = (contact.arrays.count, arrays.at(6, "state"));
        let state = at_state.optional(state, count)?;
        state.map(|codes| at_state.states(codes)).transpose()?;
        let at = arrays.at(7, "fields");
        let given = at.whole(fields)?;
        at.check_reserved(given.reserved)?;
        if state.is_none() && !given.state.is_null() && count > 0 {
            return at_state.refuse("is NULL, but fields->state is not");
        }
        let (nodes, dim) = (contact.nodes, contact.found.dim);
        let places = [
            at.named("pressure").optional_output(given.pressure, nodes)?,
            at.named("traction").optional_output(given.traction, dim * nodes)?,
            at.named("clearance").optional_output(given.clearance, nodes)?,
            at.named("slip").optional_output(given.slip, dim * nodes)?,
        ];
        let states = at.named("state").optional_output(given.state, nodes)?;
        arrays.check_overlap()?;
        let found = contact.found.fields(&results).map_err(arrays.refused(5))?;
        let NodalFields { nodes, pairs, pressure, traction, clearance, slip } = &found;
        for (place, values) in places.iter().zip([pressure, traction, clearance, slip]) {
            scatter(nodes, values, |at, of_node| place.part(at, of_node.len()).write(of_node));
        }
        if let Some(state) = state {
            let of_nodes = nodes.iter().zip(pairs);
            of_nodes.for_each(|(node, pair)| states.part(*node, 1).write(&[state[*pair]]));
        }
        Ok(0)
    })
}

/// Resultant of the contact forces on the slave's body, and the work of friction.
///
/// @param contact,slip0,d,F  as for signorini_surface_fields
/// @param point      the point of the moment, dim coordinates; NULL: the origin
/// @param resultant  out: the sums; set resultant->struct_size before
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_resultant(
    contact: *const SignoriniSurfacePairs,
    slip0: *const f64,
    d: *const f64,
    F: *const f64,
    point: *const f64,
    resultant: *mut SignoriniResultant,
) -> i32 {
    c_entry!(|arrays| {
        let contact = arrays.at(1, "contact").handle(contact)?;
        let results = pair_results(arrays, contact, [1, 2, 3, 4], [null(), slip0, d, F])?;
        let dim = contact.found.dim;
        let origin = [0.0; 3];
        let at_point = arrays.at(5, "point").is(Argument::Coordinates);
        let point = at_point.optional(point, dim)?.unwrap_or(&origin[..dim]);
        let resultant = arrays.at(6, "resultant").out_structure(resultant)?;
        let sums = contact.found.resultant(&results, point).map_err(arrays.refused(4))?;
        let told = SignoriniResultant {
            struct_size: size_of::<SignoriniResultant>() as u32,
            reserved: 0,
            force: sums.force,
            moment: sums.moment,
            friction_work: sums.friction_work,
            pressed_area: sums.pressed_area,
        };
        resultant.write(0, &told);
        Ok(0)
    })
}

/// The results of a host: gap, slip0, d and F, with their positions. All lengths are those of the pairs, so that nothing of
/// them is left to be wrong.
pub(super) fn pair_results<'a>(
    arrays: &'a Arrays,
    contact: &SignoriniSurfacePairs,
    positions: [i32; 4],
    [gap, slip0, d, force]: [*const f64; 4],
) -> Outcome<PairResults<'a>> {
    let (pairs, dim) = (contact.arrays.count, contact.found.dim);
    let at = |k: usize, name, argument| arrays.at(positions[k], name).is(argument);
    Ok(PairResults {
        gap: at(0, "gap", Argument::Gap).optional(gap, pairs)?,
        reference_slip: at(1, "slip0", Argument::ReferenceSlip)
            .optional(slip0, (dim - 1) * pairs)?,
        d: at(2, "d", Argument::Start).required(d, dim * pairs)?,
        force: at(3, "F", Argument::Force).required(force, dim * pairs)?,
    })
}

/// Hands over the values of each of some nodes, with their place among those of all nodes.
pub(super) fn scatter<T>(nodes: &[usize], values: &[T], mut put: impl FnMut(usize, &[T])) {
    let each = values.len().checked_div(nodes.len()).unwrap_or(0);
    for (node, of_node) in nodes.iter().zip(values.chunks(each.max(1))) {
        put(node * each, of_node);
    }
}

/// What has passed through. Set struct_size before the call; the call writes all other fields.
/// Faces and nodes are counted as yours; -1: none.
#[repr(C)]
pub struct SignoriniPenetration {
    /// sizeof(signorini_penetration).
    pub struct_size: u32,
    /// Number of slave nodes and of middles of slave faces that have passed through, and of nodes
    /// of the master through other slave faces; 0: none.
    pub points: i32,
    /// How deep the deepest is, along its normal before the motion; of an obstacle that is a shape
    /// its distance from the shape; length.
    pub depth: f64,
    /// Where it is, moved; in 2D the third entry is 0.
    pub point: [f64; 3],
    /// Its slave face, or that which a node of the master has passed through.
    pub face: i64,
    /// Its node, of either side; -1: the middle of the face, or a node of a rigid mesh.
    pub node: i64,
    /// The master face that it has passed through; -1 of an obstacle that is a shape.
    pub master_face: i64,
    /// Of joined pairs the zone whose faces these are, in their order, from 0.
    pub zone: i64,
}

/// Checks after a solution if parts of the slave's surface have passed through the master or the
/// obstacle where no pair holds them, such as faces beyond the search distance. Faces that lie
/// wholly over master faces of at least half their size, and all of whose nodes have pairs that
/// slide by less than a tenth of the face, are left to these and not looked at; where some nodes of
/// a face have pairs, or are folded, these may pass by a tenth of its size. Nodes of a master that
/// come to lie over the faces that are looked at are looked at too; where some nodes of the slave
/// face have pairs, they may pass by a tenth of the size of the smaller face. What overlaps before
/// the motion has not passed through by it, and is not counted: data.beyond has the faces that do,
/// by more than was looked at. A clearance of the settings stands between the surfaces here too. A
/// point that has passed through the whole of a shape, as a bar, and is outside again is not found.
///
/// @param contact      the pairs; of joined ones each zone is asked, points are those of all
/// @param u            displacements of all your degrees of freedom, as signorini_model_recover
///                     writes them; at least up to the largest one of the nodes of the faces
/// @param penetration  out: what is found; set penetration->struct_size before
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_penetration(
    contact: *const SignoriniSurfacePairs,
    u: *const f64,
    penetration: *mut SignoriniPenetration,
) -> i32 {
    c_entry!(|arrays| {
        let contact = arrays.at(1, "contact").handle(contact)?;
        let (dofs, dim) = (contact.dofs(), contact.found.dim);
        let of_node = |&node: &usize| &dofs[dim * node..dim * (node + 1)];
        let nodes = contact.kept.iter().flat_map(|kept| kept.surfaces.nodes());
        let length = nodes.flat_map(of_node).max().map_or(0, |last| last + 1);
        let u = arrays.at(2, "u").required(u, length)?;
        let place = arrays.at(3, "penetration").out_structure(penetration)?;
        let moved = |node: usize, axis: usize| u[dofs[dim * node + axis]];
        let monitor = &mut Monitor::new(&Settings::default(), None);
        let (mut found, mut points, mut zone) = (Penetration::default(), 0, 0);
        for (at, kept) in contact.kept.iter().enumerate() {
            let passed = kept.surfaces.penetration(&kept.pairs, moved, monitor);
            let passed = passed.map_err(arrays.refused(2))?;
            points += passed.count;
            if passed.count > 0 && passed.depth >= found.depth {
                (found, zone) = (passed, at as i64);
            }
        }
        let counted =
            |index: Option<usize>| index.map_or(-1, |index| index as i64 + contact.numbering.base);
        let told = SignoriniPenetration {
            struct_size: size_of::<SignoriniPenetration>() as u32,
            points: i32::try_from(points).unwrap_or(i32::MAX),
            depth: found.depth,
            point: found.point,
            face: counted((points > 0).then_some(found.face)),
            node: counted(found.node),
            master_face: counted(found.master),
            zone,
        };
        place.write(0, &told);
        Ok(0)
    })
}
