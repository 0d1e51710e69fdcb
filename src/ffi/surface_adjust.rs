//! Slave nodes that move onto the other side, once.

use super::args::c_entry;
use super::guard::refused;
use super::surface_new::SignoriniSurfacePairs;
use crate::error::Argument;
use crate::monitor::Monitor;
use crate::settings::Settings;

/// Moves slave nodes so that the two points of each pair meet, as little as that takes; of pairs
/// whose points are no further apart than `within`. A tie of curved sides then follows a rigid turn.
/// Assemble your matrix with the moved nodes, and pair again.
///
/// @param contact      the pairs
/// @param within       largest distance that is closed, also +infinity; length
/// @param coordinates  in: those that were paired, dim for each node; out: moved
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_adjust(
    contact: *const SignoriniSurfacePairs,
    within: f64,
    coordinates: *mut f64,
) -> i32 {
    c_entry!(|arrays| {
        let contact = arrays.at(1, "contact").handle(contact)?;
        let length = contact.found.dim * contact.nodes;
        let place = arrays.at(3, "coordinates").output(coordinates, length)?;
        let mut moved = place.read();
        let monitor = &mut Monitor::new(&Settings::default(), None);
        let position = |argument| if argument == Argument::Settings { 2 } else { 3 };
        contact.found.adjust(within, &mut moved, monitor).map_err(refused(position))?;
        place.write(&moved);
        Ok(0)
    })
}
