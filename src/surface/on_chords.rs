//! Faces with mid nodes in the middle of their edges, on a curved side: meshers leave them there that place nodes of the second order on
//! straight edges. They stand on chords, and are no points of the surface.
//!
//! Such a face meets another at an angle, as faces without mid nodes do. A flat face that runs into a round meets a curved face there,
//! which is inclined to it by the error of its own slope alone: little beside the half of the angle by which that turns itself.

use super::digits::{ON_PLANE, left_open};
use super::fitted_normals::SMOOTH;
use super::mesh::Side;
use super::shape::MANY_FACES;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// A face is inclined to a curved one by this part of the half of its turn at least, if its mid nodes stand on chords.
const INCLINED: f64 = 0.5;

/// `true` of each face whose mid nodes stand on chords.
///
/// # Errors
/// What stops the pairing.
pub(super) fn on_chords(side: &Side<'_>) -> Result<Vec<bool>, Error> {
    let mut found = vec![false; side.count()];
    let has_mids = |at: &usize| side.corners(*at).len() < side.nodes(*at).len();
    if !(0..side.count()).any(|at| has_mids(&at)) {
        return Ok(found);
    }
    let own = |node: usize| &side.coordinates[side.dim * node..side.dim * (node + 1)];
    let own: Vec<f64> = side.all_nodes().into_iter().flat_map(own).copied().collect();
    let off = side.scale * left_open(side.dim, &own);
    let straight: Vec<bool> =
        (0..side.count()).map(|at| has_mids(&at) && side.face(at).is_bilinear_to(off)).collect();
    if !straight.contains(&true) {
        return Ok(found);
    }
    // By corner: the face, its normal there, and how far it turns to its middle.
    let mut corners: Vec<(usize, usize, Vector3, f64)> = Vec::new();
    for face in side.each_face() {
        let (at, face) = face?;
        let middle = face.middle_normal();
        let places = face.nodes.iter().zip(face.kind.places()).take(face.kind.corners());
        corners.extend(places.map(|(&node, &place)| {
            let normal = face.normal(place);
            (node, at, normal, (normal - middle).norm())
        }));
    }
    corners.sort_unstable_by_key(|&(node, at, ..)| (node, at));
    // The slivers around a hub have other corners.
    let around = corners.chunk_by(|one, other| one.0 == other.0);
    for around in around.filter(|around| around.len() <= MANY_FACES) {
        side.progress.goes_on()?;
        for &(_, at, own, _) in around.iter().filter(|(_, at, ..)| straight[*at]) {
            found[at] |= around.iter().any(|&(_, other, normal, turn)| {
                let apart = (normal - own).norm();
                other != at && normal.dot(&own) > SMOOTH && apart > (INCLINED * turn).max(ON_PLANE)
            });
        }
    }
    Ok(found)
}
