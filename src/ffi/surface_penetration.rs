//! The check after a solution: what has passed through the other side without a pair.

use super::args::c_entry;
use super::guard::refused;
use super::surface_new::SignoriniSurfacePairs;
use crate::monitor::Monitor;
use crate::settings::Settings;

/// What has passed through. Set struct_size before the call; the call writes all other fields.
/// Faces and nodes are counted as yours; -1: none.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniPenetration {
    /// sizeof(signorini_penetration).
    pub struct_size: u32,
    /// Number of slave nodes and of middles of slave faces that have passed through; 0: none.
    pub points: i32,
    /// How deep the deepest is, along the slave's normal before the motion; length.
    pub depth: f64,
    /// Where it is, moved; in 2D the third entry is 0.
    pub point: [f64; 3],
    /// Its slave face.
    pub face: i64,
    /// Its slave node; -1: it is the middle of the face.
    pub node: i64,
    /// The master face that it has passed through; -1 of an obstacle that is a shape.
    pub master_face: i64,
}

/// Checks after a solution if parts of the slave's surface have passed through the master or the
/// obstacle: nothing holds what has no pair, such as faces beyond the search distance. Where pairs
/// hold, a tenth of a face's size is left to them.
///
/// @param contact      the pairs of one zone, as they were made
/// @param u            displacements of all your degrees of freedom, as signorini_model_recover
///                     writes them; at least up to the largest one of the nodes
/// @param penetration  out: what is found; set penetration->struct_size before
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_penetration(
    contact: *const SignoriniSurfacePairs,
    u: *const f64,
    penetration: *mut SignoriniPenetration,
) -> i32 {
    c_entry!(|arrays| {
        let at = arrays.at(1, "contact");
        let contact = at.handle(contact)?;
        let Some(kept) = &contact.kept else {
            return at.refuse("is joined of zones: ask the pairs of each zone");
        };
        let (dofs, dim) = (contact.dofs(), contact.found.dim);
        let length = dofs.iter().max().map_or(0, |last| last + 1);
        let u = arrays.at(2, "u").required(u, length)?;
        let place = arrays.at(3, "penetration").out_structure(penetration)?;
        let moved = |node: usize, axis: usize| u[dofs[dim * node + axis]];
        let monitor = &mut Monitor::new(&Settings::default(), None);
        let found = kept.penetration(&contact.found, moved, monitor).map_err(refused(|_| 2))?;
        let counted =
            |index: Option<usize>| index.map_or(-1, |index| index as i64 + contact.base());
        let told = SignoriniPenetration {
            struct_size: size_of::<SignoriniPenetration>() as u32,
            points: i32::try_from(found.count).unwrap_or(i32::MAX),
            depth: found.depth,
            point: found.point,
            face: counted((found.count > 0).then_some(found.face)),
            node: counted(found.node),
            master_face: counted(found.master),
        };
        place.write(0, &told);
        Ok(0)
    })
}
