//! A fitted side: its faces as patches through their nodes.
//!
//! Nodes on chords, where meshers leave them that place nodes of the second order in the middle of edges, are not on the surface. A face
//! that has some is the patch of its corners, by normals that are fitted to the corners of all faces. Fits of other faces have such
//! nodes where that patch has them.

use super::curved_patch::Patch;
use super::face::Face;
use super::facets::Normals;
use super::fitted_normals::{Fitted, fitted};
use super::mesh::Side;
use super::shape::FaceKind;
use super::surfaces::Faces;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

pub(super) struct FittedSide {
    normals: Fitted,
    on_chords: Option<OnChords>,
}

/// A side on which nodes stand on chords.
struct OnChords {
    /// The faces that have some.
    has_some: Vec<bool>,
    /// The normals of all corners.
    of_corners: Fitted,
    /// The coordinates of all nodes, on the surface.
    places: Vec<f64>,
}

impl FittedSide {
    /// # Errors
    /// What stops the pairing.
    pub(super) fn new(side: &Side<'_>) -> Result<FittedSide, Error> {
        let on_chords = OnChords::of(side)?;
        let normals = fitted(&on_chords.as_ref().map_or(*side, |found| found.moved(side)))?;
        Ok(FittedSide { normals, on_chords })
    }

    /// A face of the side as a patch.
    pub(super) fn patch(&self, side: &Side<'_>, at: usize) -> Patch {
        match &self.on_chords {
            Some(found) if found.has_some[at] => {
                Patch::new(&of_corners(&side.face(at)), &found.of_corners[at])
            }
            Some(found) => Patch::new(&found.moved(side).face(at), &self.normals[at]),
            None => Patch::new(&side.face(at), &self.normals[at]),
        }
    }
}

impl OnChords {
    /// `None`: the side has no such nodes.
    fn of(side: &Side<'_>) -> Result<Option<OnChords>, Error> {
        let nodes = on_chords(side)?;
        if nodes.iter().all(Vec::is_empty) {
            return Ok(None);
        }
        let mut corners = [vec![0], Vec::new()];
        for at in 0..side.count() {
            corners[1].extend(side.corners(at));
            corners[0].push(corners[1].len());
        }
        let [start, list] = &corners;
        let of_corners_alone = Faces { start, nodes: list };
        let normals = fitted(&side.with(side.coordinates, of_corners_alone, side.origins))?;
        let mut sums = vec![(Vector3::zeros(), 0.0); side.coordinates.len() / side.dim];
        for face in side.each_face() {
            let (at, face) = face?;
            let patch = Patch::new(&of_corners(&face), &normals[at]);
            for &place in &nodes[at] {
                let (sum, count) = &mut sums[face.nodes[place]];
                *sum += patch.at(face.kind.places()[place]).0;
                *count += 1.0;
            }
        }
        let mut places = side.coordinates.to_vec();
        for (x, (sum, count)) in places.chunks_exact_mut(side.dim).zip(sums) {
            if count > 0.0 {
                x.copy_from_slice(&(sum / (count * side.scale)).as_slice()[..side.dim]);
            }
        }
        let has_some = nodes.iter().map(|nodes| !nodes.is_empty()).collect();
        Ok(Some(OnChords { has_some, of_corners: normals, places }))
    }

    /// The side with all nodes on the surface.
    fn moved<'s>(&'s self, side: &Side<'s>) -> Side<'s> {
        side.with(&self.places, side.faces, side.origins)
    }
}

/// The face of the corners of a face.
fn of_corners<'f>(face: &Face<'f>) -> Face<'f> {
    let nodes = &face.nodes[..face.kind.corners()];
    let kind = FaceKind::of(face.kind.dim(), nodes.len()).expect("corners are a face");
    Face { kind, nodes, ..face.clone() }
}

/// The nodes of each face that stand on chords, by their places in it: mid nodes, and the centre between these.
fn on_chords(side: &Side<'_>) -> Result<Vec<Vec<usize>>, Error> {
    let normals = Normals::of(side)?;
    let of_face = |face| {
        let (at, face) = face?;
        let off = normals.edges(at, &face).filter(|edge| !edge.meets);
        let mids: Vec<usize> = off.filter_map(|edge| edge.mid).collect();
        let centre = face.kind.central_node().filter(|_| !mids.is_empty());
        Ok(mids.into_iter().chain(centre).collect())
    };
    side.each_face().map(of_face).collect()
}
