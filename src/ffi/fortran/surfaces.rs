//! SGSURF, SGSGAP, SGSMOD, SGSFLD, SGSUMM, SGSFRE: pairs from two surfaces, known by numbers.

use std::ptr::null;
use std::sync::Arc;

use libc::c_char;

use super::super::guard::Outcome;
use super::super::structures::Structure;
use super::super::surface::SignoriniFaces;
use super::super::surface_fields::{SignoriniContactFields, signorini_surface_fields};
use super::super::surface_new::{SignoriniSurfacePairs, signorini_surface_pair};
use super::super::surface_settings::{
    SIGNORINI_PAIRING_DUAL_MORTAR, SIGNORINI_PAIRING_NODE_TO_SURFACE, SignoriniSurfaceSettings,
};
use super::arguments::{Argument, Integer, fill, run, write};
use super::calls::{Integers, Matrix};
use super::handles::{create, find, free};

entry! {
    sgsurf_ sgsurf_64_ calls [NDIM, NNODE, X, SLAVE, MASTER, DIST, HSURF],
    (
        NDIM: *const I, NNODE: *const I, X: *const f64, NDOF: *const I, LSL: *const I,
        NSL: *const I, SLAVE: *const I, LMA: *const I, NMA: *const I, MASTER: *const I,
        PAIRNG: *const I, DIST: *const f64, HSURF: *mut i64, NPAIR: *mut I,
    ) {
        create(HSURF, |contact| {
            let (dim, nodes) = (NDIM.dimension()?, NNODE.count()?);
            let dofs = NDOF.choice()?;
            if dofs != 0 && dofs < dim {
                return NDOF.refuse(format!("is {dofs}, it must be 0 or at least NDIM ({dim})"));
            }
            let kinds = SIGNORINI_PAIRING_DUAL_MORTAR..=SIGNORINI_PAIRING_NODE_TO_SURFACE;
            let wanted = "0 (dual mortar) or 1 (nodes against surfaces)";
            let settings = SignoriniSurfaceSettings {
                dofs_per_node: dofs,
                pairing: PAIRNG.one_of(kinds, wanted)?,
                search_distance: DIST.read()?,
                index_base: 1,
                ..SignoriniSurfaceSettings::default_one()
            };
            let (slave, master) = (Faces::read(LSL, NSL, SLAVE)?, Faces::read(LMA, NMA, MASTER)?);
            let (slave, master) = (slave.view(), master.view());
            let (slave, master) = (&raw const slave, &raw const master);
            let settings = &raw const settings;
            let status =
                signorini_surface_pair(dim, nodes, X.pointer, slave, master, settings, contact);
            if status == 0 {
                write(NPAIR.pointer, I::nearest((**contact).rows.count));
            }
            Ok(status)
        })
    }
}

/// Faces in the form of C, counted from 1.
struct Faces {
    start: Vec<i64>,
    nodes: Vec<i64>,
}

impl Faces {
    /// Columns of a table, which faces with fewer nodes fill up with zeros.
    fn read<I: Integer>(
        each: Integers<I>,
        faces: Integers<I>,
        table: Integers<I>,
    ) -> Outcome<Faces> {
        let (of_face, faces) = (each.count()?, faces.count()?);
        if of_face == 0 && faces > 0 {
            return each.refuse("is 0, it must be the nodes of a face");
        }
        let table = table.numbers(of_face * faces)?;
        let (mut start, mut nodes) = (vec![1], Vec::new());
        for face in table.chunks(of_face.max(1) as usize) {
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
    sgsgap_ sgsgap_64_ calls [],
    (HSURF: *const i64, NODE: *mut I, GAP: *mut f64, AREA: *mut f64, NORMAL: *mut f64) {
        let contact = find::<SignoriniSurfacePairs>(HSURF)?;
        let (found, pairs) = (&contact.arrays, contact.arrays.count);
        let node = NODE.output(pairs)?;
        let outputs = [
            (GAP.output(pairs)?, &found.gaps),
            (AREA.output(pairs)?, &found.areas),
            (NORMAL.output(contact.found.dim * pairs)?, &found.normals),
        ];
        node.write_each(contact.slaves.iter().map(|slave| I::nearest(*slave)));
        outputs.iter().for_each(|(place, values)| place.write(values));
        Ok(0)
    }
}

entry! {
    // As for SGSPAR; HSURF in the place of the pairs.
    sgsmod_ sgsmod_64_ calls [VALUES, NFIX, FIXED, HSURF, HANDLE, HANDLE],
    (
        N: *const I, NNZ: *const I, COLPTR: *const I, ROWIND: *const I, VALUES: *const f64,
        TRI: *const I, NFIX: *const I, FIXED: *const I, HSURF: *const i64, HANDLE: *mut i64,
    ) {
        create(HANDLE, |model| {
            let contact = find::<SignoriniSurfacePairs>(HSURF)?;
            let matrix = Matrix { N, NNZ, COLPTR, ROWIND, VALUES, TRI, NFIX, FIXED };
            matrix.with(&raw const contact.rows, model)
        })
    }
}

entry! {
    sgsfld_ sgsfld_64_ calls [HSURF, GAP, SLIP0, D, R, R, PRESS],
    (
        HSURF: *const i64, GAP: *const f64, SLIP0: *const f64, D: *const f64, R: *const f64,
        PRESS: *mut f64, TRACT: *mut f64, CLEAR: *mut f64, SLIP: *mut f64,
    ) {
        let contact = find::<SignoriniSurfacePairs>(HSURF)?;
        let fields = SignoriniContactFields {
            pressure: PRESS.pointer,
            traction: TRACT.pointer,
            clearance: CLEAR.pointer,
            slip: SLIP.pointer,
            ..SignoriniContactFields::zeros()
        };
        Ok(signorini_surface_fields(
            Arc::as_ptr(&contact), GAP.pointer, SLIP0.pointer, D.pointer, R.pointer, null(),
            &raw const fields,
        ))
    }
}

entry! {
    sgsumm_ sgsumm_64_ calls [],
    (HSURF: *const i64, TEXT: *mut c_char, LTEXT: *const I) {
        let contact = find::<SignoriniSurfacePairs>(HSURF)?;
        fill(TEXT.pointer, LTEXT.count()?, &contact.summary.to_string_lossy());
        Ok(0)
    }
}

entry! {
    sgsfre_ sgsfre_64_ calls [],
    (HSURF: *mut i64) {
        free::<SignoriniSurfacePairs>(HSURF)
    }
}
