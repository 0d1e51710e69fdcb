//! A fitted side: its faces as patches through their nodes.
//!
//! A face whose mid nodes stand on chords is the patch of its corners, as one without mid nodes is, by normals that are fitted to the
//! corners of all faces. Fits of other faces have its mid nodes where that patch has them.

use super::curved_patch::Patch;
use super::face::Face;
use super::fitted_normals::{Fitted, fitted};
use super::mesh::Side;
use super::on_chords::on_chords;
use super::shape::FaceKind;
use super::surfaces::Faces;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

pub(super) struct FittedSide {
    normals: Fitted,
    on_chords: Option<OnChords>,
}

/// A side with faces whose mid nodes stand on chords.
struct OnChords {
    /// `true` of these faces.
    is_one: Vec<bool>,
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

    /// The coordinates of all nodes, on the surface; `None`: where they stand.
    pub(super) fn places(self) -> Option<Vec<f64>> {
        Some(self.on_chords?.places)
    }

    /// A face of the side as a patch.
    pub(super) fn patch(&self, side: &Side<'_>, at: usize) -> Patch {
        match &self.on_chords {
            Some(found) if found.is_one[at] => {
                Patch::new(&of_corners(&side.face(at)), &found.of_corners[at])
            }
            Some(found) => Patch::new(&found.moved(side).face(at), &self.normals[at]),
            None => Patch::new(&side.face(at), &self.normals[at]),
        }
    }
}

impl OnChords {
    /// `None`: there are none.
    fn of(side: &Side<'_>) -> Result<Option<OnChords>, Error> {
        let is_one = on_chords(side)?;
        if !is_one.contains(&true) {
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
        for at in (0..side.count()).filter(|at| is_one[*at]) {
            side.progress.goes_on()?;
            let face = side.face(at);
            let patch = Patch::new(&of_corners(&face), &normals[at]);
            let mids = face.nodes.iter().zip(face.kind.places()).skip(face.kind.corners());
            for (&node, &place) in mids {
                let (sum, count) = &mut sums[node];
                *sum += patch.at(place).0;
                *count += 1.0;
            }
        }
        let mut places = side.coordinates.to_vec();
        for (x, (sum, count)) in places.chunks_exact_mut(side.dim).zip(sums) {
            if count > 0.0 {
                x.copy_from_slice(&(sum / (count * side.scale)).as_slice()[..side.dim]);
            }
        }
        Ok(Some(OnChords { is_one, of_corners: normals, places }))
    }

    /// The side with all nodes on the surface.
    fn moved<'s>(&'s self, side: &Side<'s>) -> Side<'s> {
        side.moved(&self.places)
    }
}

/// The face of the corners of a face.
fn of_corners<'f>(face: &Face<'f>) -> Face<'f> {
    let nodes = &face.nodes[..face.kind.corners()];
    let kind = FaceKind::of(face.kind.dim(), nodes.len()).expect("corners are a face");
    Face { kind, nodes, ..face.clone() }
}
