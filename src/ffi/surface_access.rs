//! What pairs from surfaces tell.

use libc::c_char;
use std::ptr::null;

use super::pairs::SignoriniPairs;
use super::surface_new::SignoriniSurfacePairs;

/// Number of pairs; -1 if contact is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_count(contact: *const SignoriniSurfacePairs) -> i64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, -1, |contact| contact.arrays.count as i64) }
}

/// The pairs for signorini_model_new_sparse, as general rows, counted from index_base. NULL if
/// contact is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_rows(
    contact: *const SignoriniSurfacePairs,
) -> *const SignoriniPairs {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| &raw const contact.rows) }
}

/// One sentence on what was found, ASCII text for a log. It lives as long as the pairs; empty if
/// contact is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_summary(
    contact: *const SignoriniSurfacePairs,
) -> *const c_char {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, c"".as_ptr(), |contact| contact.summary.as_ptr()) }
}

/// Initial gaps, one for each pair; length: positive if open, negative if the surfaces overlap.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_gaps(
    contact: *const SignoriniSurfacePairs,
) -> *const f64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.arrays.gaps)) }
}

/// Areas, one for each pair; the pressure of a pair is -F_n over its area.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_areas(
    contact: *const SignoriniSurfacePairs,
) -> *const f64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.arrays.areas)) }
}

/// Unit normals, dim for each pair, outward from the slave's body.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_normals(
    contact: *const SignoriniSurfacePairs,
) -> *const f64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.arrays.normals)) }
}

/// First unit tangents, dim for each pair; in 3D the second one is n x t1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_tangents(
    contact: *const SignoriniSurfacePairs,
) -> *const f64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.arrays.tangents)) }
}

/// Where the force of each pair acts on the slave's body, dim for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_points(
    contact: *const SignoriniSurfacePairs,
) -> *const f64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.points)) }
}

/// The slave node of each pair, ascending, counted from index_base.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_nodes(
    contact: *const SignoriniSurfacePairs,
) -> *const i64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.slaves)) }
}

/// Slave nodes without a pair, report.unpaired entries: nothing lies over them, or they are folded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_unpaired(
    contact: *const SignoriniSurfacePairs,
) -> *const i64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.unpaired)) }
}

/// Slave nodes with little cover, each with the node whose pair has taken in its row; 2 for each of
/// report.folded.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_folded(
    contact: *const SignoriniSurfacePairs,
) -> *const i64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.folded)) }
}

/// Slave faces that lie over nothing, report.uncovered entries, counted from index_base.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_surface_uncovered(
    contact: *const SignoriniSurfacePairs,
) -> *const i64 {
    // SAFETY: NULL or pairs, by the header's contract.
    unsafe { look(contact, null(), |contact| array(&contact.uncovered)) }
}

/// # Safety
/// NULL or pairs that live during the call.
unsafe fn look<R>(
    contact: *const SignoriniSurfacePairs,
    none: R,
    part: impl FnOnce(&SignoriniSurfacePairs) -> R,
) -> R {
    // SAFETY: by the caller's contract.
    unsafe { contact.as_ref() }.map_or(none, part)
}

/// The address of an array, NULL if it has no entries.
fn array<T>(values: &[T]) -> *const T {
    if values.is_empty() { null() } else { values.as_ptr() }
}
