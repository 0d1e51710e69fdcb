//! SGSURF, SGSMOD, SGSGAP, SGSUMM, SGSFRE: pairs from two surfaces, known by numbers.

use libc::c_char;

use super::super::guard::Failure;
use super::super::model_new::signorini_model_new_sparse_within;
use super::super::settings::SignoriniSettings;
use super::super::surface::SignoriniFaces;
use super::super::surface_new::{SignoriniSurfacePairs, signorini_surface_pair};
use super::super::surface_settings::{
    SIGNORINI_PAIRING_DUAL_MORTAR, SIGNORINI_PAIRING_NODE_TO_SURFACE, SignoriniSurfaceSettings,
};
use super::arguments::{Integer, choice, count, dimension, read, run, write};
use super::handles::Handles;
use super::message::fill;
use super::models::MODELS;
use super::sparse::{Matrix, numbers};

/// The pairs from surfaces that live.
pub(super) static SURFACES: Handles<SignoriniSurfacePairs> =
    Handles::new("HSURF", "are no such pairs", *b"SF");

/// # Safety
/// As include/signorini.inc demands, as for all entries.
pub(super) unsafe fn pair<I: Integer>(
    ndim: *const I,
    nnode: *const I,
    x: *const f64,
    ndof: *const I,
    lsl: *const I,
    nsl: *const I,
    slave: *const I,
    lma: *const I,
    nma: *const I,
    master: *const I,
    pairng: *const I,
    dist: *const f64,
    hsurf: *mut i64,
    npair: *mut I,
    info: *mut I,
) {
    // SAFETY: by the caller's contract.
    let make = |contact| unsafe {
        let (dim, nodes) = (dimension(1, ndim)?, count(2, "NNODE", nnode)?);
        let dofs = count(4, "NDOF", ndof)?;
        if dofs != 0 && dofs < i64::from(dim) {
            let message = format!("NDOF is {dofs}, it must be 0 or at least NDIM ({dim})");
            return Err(Failure::argument(4, message));
        }
        let slave = Faces::read((5, "LSL"), lsl, (6, "NSL"), nsl, (7, "SLAVE"), slave)?;
        let master = Faces::read((8, "LMA"), lma, (9, "NMA"), nma, (10, "MASTER"), master)?;
        let settings = SignoriniSurfaceSettings {
            pairing: pairing(pairng)?,
            search_distance: read(12, "DIST", dist)?,
            index_base: 1,
            dofs_per_node: dofs as i32,
            ..SignoriniSurfaceSettings::default_one()
        };
        let (slave, master) = (slave.view(), master.view());
        let (slave, master) = (&raw const slave, &raw const master);
        let (settings, report) = (&raw const settings, std::ptr::null_mut());
        let status =
            signorini_surface_pair(dim, nodes, x, slave, master, settings, contact, report);
        if status == 0 {
            write(npair, I::nearest((**contact).rows.count));
        }
        Ok(status)
    };
    let positions = [1, 2, 3, 7, 10, 12, 13];
    // SAFETY: by the caller's contract.
    unsafe { run(info, &positions, || SURFACES.create(13, hsurf, make)) }
}

/// # Safety
/// As above.
unsafe fn pairing<I: Integer>(place: *const I) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let pairing = unsafe { choice(11, "PAIRNG", place)? };
    if !(SIGNORINI_PAIRING_DUAL_MORTAR..=SIGNORINI_PAIRING_NODE_TO_SURFACE).contains(&pairing) {
        let message = format!(
            "PAIRNG is {pairing}, it must be 0 (dual mortar) or 1 (nodes against surfaces)"
        );
        return Err(Failure::argument(11, message));
    }
    Ok(pairing)
}

/// Faces in the form of C, counted from 1.
struct Faces {
    start: Vec<i64>,
    nodes: Vec<i64>,
}

impl Faces {
    /// Columns of a table, which faces with fewer nodes fill up with zeros.
    ///
    /// # Safety
    /// As above.
    unsafe fn read<I: Integer>(
        (each_at, each_name): (i32, &str),
        each: *const I,
        (faces_at, faces_name): (i32, &str),
        faces: *const I,
        (table_at, table_name): (i32, &'static str),
        table: *const I,
    ) -> Result<Faces, Failure> {
        // SAFETY: by the caller's contract.
        let table = unsafe {
            let each = count(each_at, each_name, each)?;
            let faces = count(faces_at, faces_name, faces)?;
            if each == 0 && faces > 0 {
                let message = format!("{each_name} is 0, it must be the nodes of a face");
                return Err(Failure::argument(each_at, message));
            }
            let table = numbers(table_at, table_name, table, each * faces)?;
            table.chunks(each.max(1) as usize).map(<[i64]>::to_vec).collect::<Vec<_>>()
        };
        let (mut start, mut nodes) = (vec![1], Vec::new());
        for face in &table {
            let last = face.iter().rposition(|node| *node != 0).map_or(0, |last| last + 1);
            nodes.extend(&face[..last]);
            start.push(1 + nodes.len() as i64);
        }
        Ok(Faces { start, nodes })
    }

    fn view(&self) -> SignoriniFaces {
        SignoriniFaces {
            struct_size: size_of::<SignoriniFaces>() as u32,
            face_nodes: 0,
            count: self.start.len() as i64 - 1,
            start: self.start.as_ptr(),
            nodes: self.nodes.as_ptr(),
        }
    }
}

/// SGSMOD: the sparse model of the host's matrix with these pairs.
///
/// # Safety
/// As above.
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
