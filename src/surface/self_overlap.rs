//! Faces of one side that lie upon each other are refused: their area, and the pressure on it, would count twice.
//!
//! Legal surfaces pass: two sides of a plate, whose normals oppose each other; a surface folded upon
//! itself; faces that meet in an edge or a node; layers further apart than the search reaches.

use super::candidates::SAME_WAY;
use super::face::Face;
use super::mesh::Side;
use super::overlap::{Overlaps, SlaveFace};
use super::sweep::Sweep;
use super::tree::Tree;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Faces lie upon each other up to this distance, relative to the smaller one: two meshes of a curved
/// surface differ by `h² / 8 R`, which is 0.05 of `h` where a face turns by 23 degrees. More than this share of it is common: parts
/// of a surface whose meshes meet along a curved line overlap by segments of the circle, 0.034 of a square that turns so.
pub(super) const UPON: f64 = 0.05;

/// Refuses faces that lie upon each other within `reach`.
///
/// It asks the tree once for each face, so it costs `n log n`.
///
/// # Errors
/// The two faces, and the share that is common; what stops the pairing.
pub(super) fn check(side: &Side<'_>, faces: &mut Tree<'_>, reach: f64) -> Result<(), Error> {
    let (mut near, mut overlaps) = (Vec::new(), Overlaps::default());
    for at in 0..side.count() {
        side.progress.step()?;
        let face = side.face(at);
        let distance = reach.min(UPON * face.size());
        faces.near(&Sweep::of_face(&face, faces.normals[at], [distance; 2]), &mut near);
        near.retain(|&other| other < at && faces.normals[other].dot(&faces.normals[at]) > SAME_WAY);
        // Of faces that look the same way and share an edge each lies on its own side of it.
        let shares = |[a, b]: [usize; 2], other| side.edges(other).any(|edge| edge == [b, a]);
        let is_beside = |other: usize| side.edges(at).any(|edge| shares(edge, other));
        let is_apart = |other| {
            is_beside(other) || meet_in_a_corner([&face, &side.face(other)], faces.normals[at])
        };
        near.retain(|&other| side.dim == 2 || !is_apart(other));
        if near.is_empty() {
            continue;
        }
        let in_plane = SlaveFace::new(&face, faces.normals[at], 0);
        for &other in &near {
            let second = side.face(other);
            let distance = distance.min(UPON * second.size());
            let is_upon = |apart: f64| apart.abs() <= distance;
            // Faces that cannot be projected on each other do not lie upon each other.
            let common = in_plane.overlap(&second, is_upon, &mut overlaps);
            overlaps.points.truncate(0);
            let share = common.map_or(0.0, |part| part.share);
            let share = if share > 0.0 { in_plane.of_smaller(share, &second) } else { 0.0 };
            if share > UPON {
                return Err(upon(side, (at, other), share));
            }
        }
    }
    Ok(())
}

/// True if two faces have a common corner, and a line along an edge of the first there has each on its own side, seen along a
/// normal, but for an eighth of [`UPON`] of how far the narrower one reaches from the line. Either has at most twice that share of it
/// beyond the line, so that half of `UPON` is common at most.
fn meet_in_a_corner([first, second]: [&Face<'_>; 2], normal: Vector3) -> bool {
    let corners = first.kind.corners();
    let of_second = &second.nodes[..second.kind.corners()];
    (0..corners).filter(|i| of_second.contains(&first.nodes[*i])).any(|i| {
        let [after, before] = [i + 1, i + corners - 1].map(|beside| first.x[beside % corners]);
        let corner = first.x[i];
        [normal.cross(&(after - corner)), (before - corner).cross(&normal)].iter().any(|inward| {
            let [own, other] = [first, second].map(|face| {
                let heights = face.control_points().map(|x| inward.dot(&(x - corner)));
                heights.fold([0.0, 0.0], |[low, high], x| [f64::min(low, x), f64::max(high, x)])
            });
            let least = UPON / 8.0 * f64::min(own[1], -other[0]);
            own[0] >= -least && other[1] <= least
        })
    })
}

fn upon(side: &Side<'_>, (at, other): (usize, usize), share: f64) -> Error {
    let remedy = if side.is_image(at) && side.is_rigid() {
        "of an obstacle give the faces in the sector or the period alone"
    } else if side.is_image(at) {
        "give the axis of the sector and the number of sectors, or the period, or planes of symmetry of the whole body, whose angle divides a half turn"
    } else {
        "leave one of them out, or pair them in two calls if they belong to two contacts"
    };
    let what = format!(
        "lies upon face {}, with {:.0} % of the smaller one: the area would count twice; {remedy}",
        side.named(other),
        100.0 * share.min(1.0)
    );
    side.refuse(at, &what)
}
