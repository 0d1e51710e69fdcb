//! Nodes against surfaces: each slave node meets a point of a master face along its averaged normal, and
//! the face's shape functions there are the weights.
//!
//! The normal of the slave decides and not the closest point: its rays do not miss the wedges that the
//! faces of a curved master leave between their own normals. If pairs shall have the normals of master faces, the
//! point is the foot of the nearest perpendicular on one, so that forces still balance moments; only in a wedge
//! it is the point that the ray meets. On quadratic slave faces the rows are those
//! of control values (see `control`), without which corners would carry no area.

use std::collections::BTreeMap;

use super::candidates::Candidates;
use super::face::Face;
use super::mesh::Side;
use super::normals::{cancel, foot};
use super::pairs::{SurfacePairs, SurfaceReport, Weight};
use super::plane::Plane;
use super::row::{Row, pair_of_row, pairs_of_rows, whole_rows};
use super::settings::Normals;
use super::shape::BEYOND;
use super::symmetry::OnPlanes;
use super::tree::Tree;
use crate::error::Error;
use crate::linalg::vector3::{Vector3, unit};

/// A point of a master face that a slave node meets.
struct MasterPoint {
    distance: f64,
    /// The face's nodes with its shape functions there.
    weights: Vec<Weight>,
    /// The unit normal of the pair, outward from the slave's body.
    normal: Vector3,
}

/// The meetings that are nearest, up to a rounding, the very nearest first. The order of faces chooses none of their normals: all have
/// the mean.
fn nearest(meetings: impl Iterator<Item = MasterPoint>, rounding: f64) -> Vec<MasterPoint> {
    let mut meetings: Vec<MasterPoint> = meetings.collect();
    meetings.sort_by(|a, b| a.distance.abs().total_cmp(&b.distance.abs()));
    let Some(first) = meetings.first() else { return meetings };
    let (most, mut mean) = ((1.0 + BEYOND) * first.distance.abs() + rounding, first.normal);
    meetings.retain(|met| met.distance.abs() <= most);
    let mut normals: Vec<Vector3> = Vec::new();
    for MasterPoint { normal, .. } in &meetings {
        if !normals.iter().any(|known| (known - normal).norm() <= BEYOND) {
            normals.push(*normal);
        }
    }
    if normals.len() > 1 {
        mean = unit(normals.iter().sum()).unwrap_or(mean);
    }
    meetings.iter_mut().for_each(|met| met.normal = mean);
    meetings
}

/// The master point that a node with an averaged normal meets, the nearest if there are several.
fn meets(
    master: &Side<'_>,
    (x, averaged): (Vector3, Vector3),
    normals: Normals,
    (own, candidates): (&mut Tree<'_>, &mut Candidates<'_>),
) -> Option<MasterPoint> {
    let plane = Plane::new(master.dim, x, averaged);
    let reach = candidates.reach;
    let found = candidates.of_point(x, averaged);
    let faces = || found.iter().map(|&at| master.face(at));
    let rounding = BEYOND * faces().map(|face| face.size()).fold(0.0, f64::max);
    let weights =
        |face: &Face<'_>, at| face.nodes.iter().copied().zip(face.kind.values(at)).collect();
    let along_ray = faces().filter_map(|face| {
        let (at, distance) = plane.meeting(&face).filter(|(_, distance)| reach.holds(*distance))?;
        let normal = match normals {
            Normals::Averaged => averaged,
            Normals::Faces => -unit(face.outward(at))?,
        };
        Some(MasterPoint { distance, weights: weights(&face, at), normal })
    });
    let along_ray = nearest(along_ray, rounding).into_iter().next()?;
    if own.end_above((x, averaged), -along_ray.distance, reach.of_shells()) {
        return None;
    }
    if normals == Normals::Averaged {
        return Some(along_ray);
    }
    // On the face that the ray meets it is no further; another one further away is no neighbour.
    let most = (1.0 + BEYOND) * along_ray.distance.abs() + rounding;
    let perpendicular = faces().filter_map(|face| {
        let (at, outward) = foot(&face, x).filter(|(at, _)| face.kind.holds(*at))?;
        let distance = (face.position(at) - x).norm();
        let weights = weights(&face, at);
        (distance <= most).then_some(MasterPoint { distance, weights, normal: -outward })
    });
    let feet = nearest(perpendicular, rounding);
    let place = |foot: &MasterPoint| master.point(&foot.weights);
    let are_apart = |foot: &MasterPoint| (place(foot) - place(&feet[0])).norm() > rounding;
    let of_feet = feet.first().map(|foot| foot.normal);
    match of_feet {
        // Between feet that are apart the pair has the point that the ray meets.
        Some(normal) if feet.iter().any(are_apart) => Some(MasterPoint { normal, ..along_ray }),
        _ => Some(feet.into_iter().next().unwrap_or(along_ray)),
    }
}

/// The pairs of two sides.
///
/// # Errors
/// Normals that cancel at a slave node.
pub(super) fn pairs(
    sides: [&Side<'_>; 2],
    planes: &OnPlanes,
    (mut own, mut candidates): (Tree<'_>, Candidates<'_>),
    normals: Normals,
) -> Result<SurfacePairs, Error> {
    let [slave, master] = sides;
    let averaged = slave.node_normals(planes, |_, _, _| true)?;
    let mut met: BTreeMap<usize, MasterPoint> = BTreeMap::new();
    for node in slave.all_nodes() {
        slave.progress.goes_on()?;
        let ray = (slave.position(node), averaged[&node]);
        if ray.1 == Vector3::zeros() {
            return Err(cancel(node));
        }
        if let Some(meeting) = meets(master, ray, normals, (&mut own, &mut candidates)) {
            met.insert(node, meeting);
        }
    }
    let mut report = SurfaceReport::default();
    let rows = whole_rows(|node| met.contains_key(&node), slave, &mut report)?;
    let pair = |node, mut row: Row| {
        let slaves: Vec<Weight> = row.slaves().collect();
        for (slave, part) in slaves {
            let masters = met[&slave].weights.iter();
            row.add_masters(masters.map(|(node, weight)| (*node, part * weight)));
        }
        Ok(pair_of_row(sides, planes, (node, row), met[&node].normal))
    };
    let mut found = pairs_of_rows(slave, rows, report, pair)?;
    for face in slave.each_face() {
        let (at, face) = face?;
        let is_met = face.nodes.iter().any(|node| met.contains_key(node));
        found.report.uncovered_faces.extend((!is_met).then_some(at));
    }
    // Their memory is given back between questions.
    met.into_iter().try_for_each(|_| slave.progress.goes_on())?;
    candidates.look_beyond(sides, &mut found.report)?;
    Ok(found)
}
