//! SGSMOD, SGSGAP, SGSUMM, SGSFRE: pairs from two surfaces, known by numbers.

use libc::c_char;

use super::super::guard::Failure;
use super::super::model_new::signorini_model_new_sparse_within;
use super::super::settings::SignoriniSettings;
use super::super::surface_new::SignoriniSurfacePairs;
use super::arguments::{Integer, count, run, write};
use super::handles::Handles;
use super::message::fill;
use super::models::MODELS;
use super::sparse::{Matrix, numbers};

/// The pairs from surfaces that live.
pub(super) static SURFACES: Handles<SignoriniSurfacePairs> =
    Handles::new("HSURF", "are no such pairs", *b"SF");

/// SGSMOD: the sparse model of the host's matrix with these pairs.
///
/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn model<I: Integer>(
    n: *const I,
    nnz: *const I,
    colptr: *const I,
    rowind: *const I,
    values: *const f64,
    tri: *const I,
    nfix: *const I,
    fixed: *const I,
    hsurf: *const i64,
    handle: *mut i64,
    info: *mut I,
) {
    let matrix = Matrix { n, nnz, colptr, rowind, values, tri, order: std::ptr::null() };
    let settings = SignoriniSettings::default_one();
    // SAFETY: by the caller's contract.
    let make = |model| unsafe {
        let matrix = matrix.read()?;
        let n_fixed = count(7, "NFIX", nfix)?;
        let fixed = numbers(8, "FIXED", fixed, n_fixed)?;
        let contact = SURFACES.find(9, hsurf)?;
        let (matrix, rows) = (&raw const matrix, &raw const contact.rows);
        let (fixed, settings) = (fixed.as_ptr(), &raw const settings);
        Ok(signorini_model_new_sparse_within(matrix, n_fixed, fixed, rows, settings, model))
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[5, 7, 8, 9, 10, 10], || MODELS.create(10, handle, make)) }
}

/// SGSGAP: slave node, gap, area and normal of each pair.
///
/// # Safety
/// As above.
pub(super) unsafe fn gaps<I: Integer>(
    hsurf: *const i64,
    node: *mut I,
    gap: *mut f64,
    area: *mut f64,
    normal: *mut f64,
    info: *mut I,
) {
    let body = || {
        // SAFETY: by the caller's contract.
        let contact = unsafe { SURFACES.find(1, hsurf)? };
        let places = [(3, "GAP", gap), (4, "AREA", area), (5, "NORMAL", normal)];
        let arrays = &contact.arrays;
        let nulls =
            places.iter().map(|(position, name, place)| (*position, *name, place.is_null()));
        for (position, name, is_null) in nulls.chain([(2, "NODE", node.is_null())]) {
            if is_null && arrays.count > 0 {
                return Err(Failure::argument(position, format!("{name} is NULL")));
            }
        }
        // SAFETY: arrays of the caller, which has learnt their lengths from NPAIR.
        unsafe {
            for (i, slave) in contact.slaves.iter().enumerate() {
                write(node.wrapping_add(i), I::nearest(*slave));
            }
            let sources = [&arrays.gaps, &arrays.areas, &arrays.normals];
            for ((_, _, place), values) in places.iter().zip(sources) {
                for (i, value) in values.iter().enumerate() {
                    write(place.wrapping_add(i), *value);
                }
            }
        }
        Ok(0)
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[], body) }
}

/// SGSUMM: what was found, in one sentence.
///
/// # Safety
/// As above.
pub(super) unsafe fn summary<I: Integer>(
    hsurf: *const i64,
    text: *mut c_char,
    ltext: *const I,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let body = || unsafe {
        let contact = SURFACES.find(1, hsurf)?;
        fill(text, count(3, "LTEXT", ltext)?, &contact.summary.to_string_lossy());
        Ok(0)
    };
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[], body) }
}

/// SGSFRE. A handle of 0, which is no pairing, is allowed.
///
/// # Safety
/// As above.
pub(super) unsafe fn free<I: Integer>(hsurf: *mut i64, info: *mut I) {
    // SAFETY: by the caller's contract.
    unsafe { run(info, &[], || SURFACES.free(hsurf)) }
}
