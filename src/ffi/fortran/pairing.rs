//! SGSURF, SGSURC: pairs from two surfaces are made.

use super::super::args::Arrays;
use super::super::guard::Failure;
use super::super::surface::SignoriniFaces;
use super::super::surface_new::{SignoriniSurfacePairs, signorini_surface_pair};
use super::super::surface_settings::{
    SIGNORINI_NORMALS_AVERAGED, SIGNORINI_NORMALS_FACES, SIGNORINI_PAIRING_DUAL_MORTAR,
    SIGNORINI_PAIRING_NODE_TO_SURFACE, SIGNORINI_RIMS_DROP, SIGNORINI_RIMS_FOLD,
    SignoriniSurfaceSettings,
};
use super::arguments::{Integer, choice, count, dimension, read, run, write};
use super::sparse::numbers;
use super::surfaces::SURFACES;

/// The first arguments of both entries.
struct Given<I> {
    ndim: *const I,
    nnode: *const I,
    x: *const f64,
    ndof: *const I,
    /// Nodes of a face, number of faces, faces.
    slave: [*const I; 3],
    master: [*const I; 3],
    pairng: *const I,
    dist: *const f64,
}

/// What SGSURC is told beyond: planes of symmetry, normals, rims.
struct Chosen {
    axes: Vec<i32>,
    at: Vec<f64>,
    normals: i32,
    rims: i32,
}

impl Chosen {
    const DEFAULT: Chosen = Chosen {
        axes: Vec::new(),
        at: Vec::new(),
        normals: SIGNORINI_NORMALS_AVERAGED,
        rims: SIGNORINI_RIMS_FOLD,
    };
}

impl<I: Integer> Given<I> {
    /// # Safety
    /// As include/signorini.inc demands, as for all entries.
    unsafe fn pair(
        &self,
        chosen: &Chosen,
        contact: *mut *mut SignoriniSurfacePairs,
        npair: *mut I,
    ) -> Result<i32, Failure> {
        // SAFETY: by the caller's contract.
        unsafe {
            let (dim, nodes) = (dimension(1, self.ndim)?, count(2, "NNODE", self.nnode)?);
            let dofs = count(4, "NDOF", self.ndof)?;
            if dofs != 0 && dofs < i64::from(dim) {
                let message = format!("NDOF is {dofs}, it must be 0 or at least NDIM ({dim})");
                return Err(Failure::argument(4, message));
            }
            let [[lsl, nsl, slave], [lma, nma, master]] = [self.slave, self.master];
            let slave = Faces::read((5, "LSL"), lsl, (6, "NSL"), nsl, (7, "SLAVE"), slave)?;
            let master = Faces::read((8, "LMA"), lma, (9, "NMA"), nma, (10, "MASTER"), master)?;
            let settings = SignoriniSurfaceSettings {
                pairing: one_of(
                    (11, "PAIRNG", "0 (dual mortar) or 1 (nodes against surfaces)"),
                    self.pairng,
                    SIGNORINI_PAIRING_DUAL_MORTAR..=SIGNORINI_PAIRING_NODE_TO_SURFACE,
                )?,
                search_distance: read(12, "DIST", self.dist)?,
                index_base: 1,
                dofs_per_node: dofs as i32,
                symmetry_planes: chosen.axes.len() as i64,
                symmetry_axes: chosen.axes.as_ptr(),
                symmetry_at: chosen.at.as_ptr(),
                normals: chosen.normals,
                rims: chosen.rims,
                ..SignoriniSurfaceSettings::default_one()
            };
            check_rims(&settings)?;
            let (slave, master) = (slave.view(), master.view());
            let (slave, master) = (&raw const slave, &raw const master);
            let (settings, report) = (&raw const settings, std::ptr::null_mut());
            let status = signorini_surface_pair(
                dim, nodes, self.x, slave, master, settings, contact, report,
            );
            if status == 0 {
                write(npair, I::nearest((**contact).rows.count));
            }
            Ok(status)
        }
    }
}

/// What the entry of C would name by its settings, which are several arguments here.
fn check_rims(settings: &SignoriniSurfaceSettings) -> Result<(), Failure> {
    let of_nodes = settings.pairing == SIGNORINI_PAIRING_NODE_TO_SURFACE;
    if of_nodes && settings.rims != SIGNORINI_RIMS_FOLD {
        let message =
            "RIMS: nodes against surfaces have no cover that a rim could be told by, it must be 0";
        return Err(Failure::argument(17, message));
    }
    Ok(())
}

/// # Safety
/// As above.
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
    let (slave, master) = ([lsl, nsl, slave], [lma, nma, master]);
    let given = Given { ndim, nnode, x, ndof, slave, master, pairng, dist };
    // SAFETY: by the caller's contract.
    let make = |contact| unsafe { given.pair(&Chosen::DEFAULT, contact, npair) };
    let positions = [1, 2, 3, 7, 10, 12, 13];
    // SAFETY: by the caller's contract.
    unsafe { run(info, &positions, || SURFACES.create(13, hsurf, make)) }
}

/// SGSURC.
///
/// # Safety
/// As above.
pub(super) unsafe fn pair_chosen<I: Integer>(
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
    nplane: *const I,
    axis: *const I,
    place: *const f64,
    normls: *const I,
    rims: *const I,
    hsurf: *mut i64,
    npair: *mut I,
    info: *mut I,
) {
    let (slave, master) = ([lsl, nsl, slave], [lma, nma, master]);
    let given = Given { ndim, nnode, x, ndof, slave, master, pairng, dist };
    // SAFETY: by the caller's contract.
    let make = |contact| unsafe {
        let planes = count(13, "NPLANE", nplane)?;
        let (axes, at) = planes_of(planes, axis, place)?;
        let normals = (16, "NORMLS", "0 (averaged) or 1 (of faces)");
        let normals =
            one_of(normals, normls, SIGNORINI_NORMALS_AVERAGED..=SIGNORINI_NORMALS_FACES)?;
        let all = (17, "RIMS", "0 (fold), 1 (keep) or 2 (drop)");
        let rims = one_of(all, rims, SIGNORINI_RIMS_FOLD..=SIGNORINI_RIMS_DROP)?;
        let dist = read(12, "DIST", dist)?;
        // Written so that NaN is refused.
        if !(dist >= 0.0 && dist.is_finite()) {
            let message = format!("DIST is {dist}, it must be 0 or positive and finite");
            return Err(Failure::argument(12, message));
        }
        given.pair(&Chosen { axes, at, normals, rims }, contact, npair)
    };
    // What is wrong with the settings of C is wrong with the planes here.
    let positions = [1, 2, 3, 7, 10, 14, 18];
    // SAFETY: by the caller's contract.
    unsafe { run(info, &positions, || SURFACES.create(18, hsurf, make)) }
}

/// Axes and places of planes of symmetry.
///
/// # Safety
/// As above.
unsafe fn planes_of<I: Integer>(
    planes: i64,
    axis: *const I,
    place: *const f64,
) -> Result<(Vec<i32>, Vec<f64>), Failure> {
    // SAFETY: by the caller's contract.
    let (axes, at) = unsafe {
        let at = Arrays::default().required(15, "PLACE", place, planes as usize)?;
        (numbers(14, "AXIS", axis, planes)?, at.to_vec())
    };
    let narrow = |axis: i64| {
        i32::try_from(axis).map_err(|_| Failure::argument(14, format!("AXIS holds {axis}")))
    };
    Ok((axes.into_iter().map(narrow).collect::<Result<_, _>>()?, at))
}

/// An integer that is one of some; `must` says which.
///
/// # Safety
/// As above.
unsafe fn one_of<I: Integer>(
    (position, name, must): (i32, &str, &str),
    place: *const I,
    range: std::ops::RangeInclusive<i32>,
) -> Result<i32, Failure> {
    // SAFETY: by the caller's contract.
    let number = unsafe { choice(position, name, place)? };
    if !range.contains(&number) {
        let message = format!("{name} is {number}, it must be {must}");
        return Err(Failure::argument(position, message));
    }
    Ok(number)
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
