//! SGSURF, SGSGAP, SGSMOD, SGSFLD, SGSUMM, SGSFRE: pairs from two surfaces, known by numbers.

use std::sync::Arc;

use libc::c_char;

use super::super::args::Arrays;
use super::super::guard::Failure;
use super::super::structures::Structure;
use super::super::surface::SignoriniFaces;
use super::super::surface_fields::{SignoriniContactFields, signorini_surface_fields};
use super::super::surface_new::{SignoriniSurfacePairs, signorini_surface_pair};
use super::super::surface_settings::{
    SIGNORINI_PAIRING_DUAL_MORTAR, SIGNORINI_PAIRING_NODE_TO_SURFACE, SignoriniSurfaceSettings,
};
use super::arguments::{Given, Integer, run, write};
use super::handles::{create, find, free};
use super::message::fill;
use super::sparse::Matrix;

entry! {
    sgsurf_ sgsurf_64_ positions [1, 2, 3, 7, 10, 12, 13],
    (
        ndim: Given<I>,
        nnode: Given<I>,
        x: *const f64,
        ndof: Given<I>,
        lsl: Given<I>,
        nsl: Given<I>,
        slave: Given<I>,
        lma: Given<I>,
        nma: Given<I>,
        master: Given<I>,
        pairng: Given<I>,
        dist: Given<f64>,
        hsurf: *mut i64,
        npair: *mut I,
    ) {
        create(13, hsurf, |contact| {
            let (dim, nodes) = (ndim.dimension(1)?, nnode.count(2, "NNODE")?);
            let settings = SignoriniSurfaceSettings {
                dofs_per_node: dofs_of_a_node(dim, ndof)?,
                pairing: pairing(pairng)?,
                search_distance: dist.read(12, "DIST")?,
                index_base: 1,
                ..SignoriniSurfaceSettings::default_one()
            };
            let slave = Faces::read((5, "LSL", lsl), (6, "NSL", nsl), (7, "SLAVE", slave))?;
            let master = Faces::read((8, "LMA", lma), (9, "NMA", nma), (10, "MASTER", master))?;
            let (slave, master) = (slave.view(), master.view());
            let (slave, master) = (&raw const slave, &raw const master);
            let settings = &raw const settings;
            let status = signorini_surface_pair(dim, nodes, x, slave, master, settings, contact);
            if status == 0 {
                write(npair, I::nearest((**contact).rows.count));
            }
            Ok(status)
        })
    }
}

/// NDOF.
fn dofs_of_a_node<I: Integer>(dim: i32, ndof: Given<I>) -> Result<i32, Failure> {
    let dofs = ndof.choice(4, "NDOF")?;
    if dofs != 0 && dofs < dim {
        let message = format!("NDOF is {dofs}, it must be 0 or at least NDIM ({dim})");
        return Err(Failure::argument(4, message));
    }
    Ok(dofs)
}

/// PAIRNG.
fn pairing<I: Integer>(pairng: Given<I>) -> Result<i32, Failure> {
    let kinds = SIGNORINI_PAIRING_DUAL_MORTAR..=SIGNORINI_PAIRING_NODE_TO_SURFACE;
    pairng.one_of(11, "PAIRNG", kinds, "0 (dual mortar) or 1 (nodes against surfaces)")
}

/// Faces in the form of C, counted from 1.
struct Faces {
    start: Vec<i64>,
    nodes: Vec<i64>,
}

impl Faces {
    /// Columns of a table, which faces with fewer nodes fill up with zeros.
    fn read<I: Integer>(
        (each_at, each_name, each): (i32, &str, Given<I>),
        (faces_at, faces_name, faces): (i32, &str, Given<I>),
        (table_at, table_name, table): (i32, &'static str, Given<I>),
    ) -> Result<Faces, Failure> {
        let each = each.count(each_at, each_name)?;
        let faces = faces.count(faces_at, faces_name)?;
        if each == 0 && faces > 0 {
            let message = format!("{each_name} is 0, it must be the nodes of a face");
            return Err(Failure::argument(each_at, message));
        }
        let table = table.numbers(table_at, table_name, each * faces)?;
        let (mut start, mut nodes) = (vec![1], Vec::new());
        for face in table.chunks(each.max(1) as usize) {
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

entry! {
    sgsgap_ sgsgap_64_ positions [],
    (hsurf: Given<i64>, node: *mut I, gap: *mut f64, area: *mut f64, normal: *mut f64) {
        let contact = find::<SignoriniSurfacePairs>(1, hsurf)?;
        let (found, pairs) = (&contact.arrays, contact.arrays.count);
        let mut arrays = Arrays::of_call();
        let node = arrays.output(2, "NODE", node, pairs)?;
        let outputs = [
            (arrays.output(3, "GAP", gap, pairs)?, &found.gaps),
            (arrays.output(4, "AREA", area, pairs)?, &found.areas),
            (arrays.output(5, "NORMAL", normal, contact.found.dim * pairs)?, &found.normals),
        ];
        node.write(&contact.slaves.iter().map(|slave| I::nearest(*slave)).collect::<Vec<I>>());
        outputs.iter().for_each(|(place, values)| place.write(values));
        Ok(0)
    }
}

entry! {
    // As for SGSPAR; HSURF in the place of the pairs.
    sgsmod_ sgsmod_64_ positions [5, 7, 8, 9, 10, 10],
    (
        n: Given<I>,
        nnz: Given<I>,
        colptr: Given<I>,
        rowind: Given<I>,
        values: *const f64,
        tri: Given<I>,
        nfix: Given<I>,
        fixed: Given<I>,
        hsurf: Given<i64>,
        handle: *mut i64,
    ) {
        create(10, handle, |model| {
            let contact = find::<SignoriniSurfacePairs>(9, hsurf)?;
            let matrix = Matrix { n, nnz, colptr, rowind, values, tri, nfix, fixed };
            matrix.with(&raw const contact.rows, model)
        })
    }
}

entry! {
    sgsfld_ sgsfld_64_ positions [1, 2, 3, 4, 5, 5, 6],
    (
        hsurf: Given<i64>,
        gap: *const f64,
        slip0: *const f64,
        d: *const f64,
        r: *const f64,
        press: *mut f64,
        tract: *mut f64,
        clear: *mut f64,
        slip: *mut f64,
    ) {
        let contact = find::<SignoriniSurfacePairs>(1, hsurf)?;
        let fields = SignoriniContactFields {
            pressure: press,
            traction: tract,
            clearance: clear,
            slip,
            ..SignoriniContactFields::zeros()
        };
        let (states, fields) = (std::ptr::null(), &raw const fields);
        Ok(signorini_surface_fields(Arc::as_ptr(&contact), gap, slip0, d, r, states, fields))
    }
}

entry! {
    sgsumm_ sgsumm_64_ positions [],
    (hsurf: Given<i64>, text: *mut c_char, ltext: Given<I>) {
        let contact = find::<SignoriniSurfacePairs>(1, hsurf)?;
        fill(text, ltext.count(3, "LTEXT")?, &contact.summary.to_string_lossy());
        Ok(0)
    }
}

entry! {
    sgsfre_ sgsfre_64_ positions [],
    (hsurf: *mut i64) {
        free::<SignoriniSurfacePairs>(hsurf)
    }
}
