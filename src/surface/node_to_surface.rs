//! Nodes against surfaces: each slave node meets a point of a master face along its averaged normal, and
//! the face's shape functions there are the weights.
//!
//! The normal of the slave decides and not the closest point: its rays do not miss the wedges that the
//! faces of a curved master leave between their own normals. On quadratic slave faces the rows are those
//! of control values (see `control`), without which corners would carry no area.

use std::collections::BTreeMap;

use super::candidates::Candidates;
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, Weight};
use super::plane::Plane;
use super::shape::{FaceKind, Local};
use super::symmetry::OnPlanes;
use super::whole_faces::whole_rows;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// A point is on a face if its local coordinates are beyond it by less than this: nodes that stand on
/// the rim by construction miss it by rounding.
const BEYOND: f64 = 1e-9;

fn is_on(kind: FaceKind, [s, t]: Local) -> bool {
    if kind.corners() == TRIANGLE && !kind.is_line() {
        return s >= -BEYOND && t >= -BEYOND && s + t <= 1.0 + BEYOND;
    }
    s.abs().max(t.abs()) <= 1.0 + BEYOND
}

/// Corners of a triangle.
const TRIANGLE: usize = 3;

/// The weights of the master point that a node meets, the nearest if there are several.
fn meets(
    master: &Side<'_>,
    (x, normal): (Vector3, Vector3),
    dim: usize,
    candidates: &mut Candidates,
) -> Option<Vec<Weight>> {
    let plane = Plane::new(dim, x, normal);
    let reach = candidates.reach;
    let mut best: Option<(f64, Vec<Weight>)> = None;
    for &at in candidates.of_point(x, normal) {
        let face = master.face(at);
        let flat = plane.flatten(&face);
        let Some(local) = flat.local([0.0; 2]).filter(|local| is_on(face.kind, *local)) else {
            continue;
        };
        let distance = flat.height(local).abs();
        if distance <= reach && best.as_ref().is_none_or(|(least, _)| distance < *least) {
            let weights = face.nodes.iter().copied().zip(face.kind.values(local)).collect();
            best = Some((distance, weights));
        }
    }
    best.map(|(_, weights)| weights)
}

/// The pairs of two sides.
///
/// # Errors
/// Normals that cancel at a slave node, or that are across a plane of symmetry.
pub(super) fn pairs(
    [slave, master]: [&Side<'_>; 2],
    dim: usize,
    planes: &OnPlanes,
    mut candidates: Candidates,
) -> Result<SurfacePairs, Error> {
    let normals = slave.node_normals_on(planes)?;
    let mut met: BTreeMap<usize, Vec<Weight>> = BTreeMap::new();
    for node in slave.all_nodes() {
        let ray = (slave.position(node), normals[&node]);
        if let Some(weights) = meets(master, ray, dim, &mut candidates) {
            met.insert(node, weights);
        }
    }
    let mut found = SurfacePairs { dim, ..SurfacePairs::default() };
    let mut report = SurfaceReport {
        search_distance: candidates.reach,
        slave_faces: slave.count(),
        boxes_searched: candidates.searched,
        not_opposed: candidates.not_opposed,
        ..SurfaceReport::default()
    };
    for (node, mut row) in whole_rows(slave) {
        report.slave_area += row.area;
        if row.slaves.iter().any(|(node, _)| !met.contains_key(node)) {
            found.unpaired.push(node);
            continue;
        }
        for (slave, part) in &row.slaves {
            let parts = met[slave].iter().map(|(node, weight)| (*node, part * weight));
            row.masters.extend(parts);
        }
        let area = row.area;
        let weights = row.into_weights();
        let points = (slave.point(&weights[0]), Some(master.point(&weights[1])));
        let pair = SurfacePair::new(dim, (node, area), weights, normals[&node], points);
        found.pairs.push(planes.hold(pair)?);
        report.covered_area += area;
    }
    found.report = report;
    Ok(found)
}
