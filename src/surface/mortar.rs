//! Dual mortar: rows that hold the two surfaces together in the mean, so that a uniform pressure of one
//! side is a uniform pressure of the other.
//!
//! Over the covered part `C` of every slave face, with functions `N̂` of the slave (see `control`) and
//! dual functions `ψ`, `∫_C ψ_j N̂_i = δ_ij D_j`, `Σ ψ_j = 1`, the row of node `j` is
//! `û_j - Σ_k w_jk u_k` with `D_j w_jk = Σ_faces ∫_C ψ_j Nᵐ_k`: Wohlmuth (2000), Hüeber and Wohlmuth (2005),
//! in space Popp, Gitterle, Gee and Wall (2010); faces that are covered in part: Cichosz and Bischoff
//! (2011). As `Σ ψ_j = 1`, forces `F_j = p D_j` load the master's nodes by `p ∫ Nᵐ_k`: the patch test.

use std::collections::BTreeMap;

use super::candidates::{Candidates, middle_normal};
use super::control::Edges;
use super::face::Face;
use super::fold;
use super::mesh::Side;
use super::overlap::SlaveFace;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, Weight};
use super::plane::Plane;
use super::projected_shapes::{Covered, project};
use super::row::Row;
use super::shape::Values;
use super::whole_faces::{unit_values, whole_integrals};
use crate::error::{Error, index};

/// A face that lacks less than this share of cover is covered wholly, and one that has more than all of
/// it by more than this share lies under two faces: far above the rounding of edges.
const COVER: f64 = 1e-6;

/// A slave face that lies over master faces.
struct CoveredFace<'a> {
    face: Face<'a>,
    covered: Covered,
    wholly: bool,
}

/// The pairs of two sides.
///
/// # Errors
/// Master faces that lie over each other; faces that are turned over in the projection; normals that
/// cancel at a slave node.
pub(super) fn pairs(
    slave: &Side<'_>,
    master: &Side<'_>,
    dim: usize,
    reach: f64,
) -> Result<SurfacePairs, Error> {
    let mut candidates = Candidates::new(master, reach);
    let mut report = SurfaceReport {
        search_distance: reach,
        slave_faces: slave.count(),
        ..SurfaceReport::default()
    };
    let mut faces = Vec::new();
    for at in 0..slave.count() {
        let face = slave.face(at);
        report.slave_area += face.area_points().iter().map(|(_, weight)| weight).sum::<f64>();
        match cover(slave, master, (at, face), dim, (&mut candidates, reach))? {
            Some(face) => faces.push(face),
            None => report.uncovered_faces.push(at),
        }
    }
    report.boxes_searched = candidates.searched;
    report.not_opposed = candidates.not_opposed;
    let mut rows = rows(&faces);
    let around = faces.iter().map(|face| face.face.nodes);
    report.folded = fold::fold(&mut rows, around, |node| slave.position(node));
    let normals = slave.node_normals()?;
    let pairs: Vec<SurfacePair> = rows
        .into_iter()
        .map(|(node, row)| {
            let area = row.area;
            let weights = row.into_weights();
            let points = (slave.point(&weights[0]), Some(master.point(&weights[1])));
            SurfacePair::new(dim, (node, area), weights, normals[&node], points)
        })
        .collect();
    report.covered_area = pairs.iter().map(|pair| pair.area).sum();
    let has_pair = |node: &usize| pairs.binary_search_by_key(node, |pair| pair.slave).is_ok();
    let unpaired = slave.all_nodes().into_iter().filter(|node| !has_pair(node)).collect();
    Ok(SurfacePairs { dim, pairs, unpaired, report })
}

/// What a slave face lies over.
fn cover<'a>(
    slave: &Side<'_>,
    master: &Side<'_>,
    (at, face): (usize, Face<'a>),
    dim: usize,
    (candidates, reach): (&mut Candidates, f64),
) -> Result<Option<CoveredFace<'a>>, Error> {
    let plane = Plane::new(dim, face.position(face.kind.centre()), middle_normal(&face));
    let in_plane = SlaveFace::new(&face, plane);
    let mut parts = Vec::new();
    let (mut area, mut over) = (0.0, Vec::new());
    for &opposite in candidates.of_face(&face) {
        let other = master.face(opposite);
        let part = in_plane.overlap(&other, reach).map_err(|_| {
            let opposite = index(opposite);
            let what = format!(
                "cannot be projected on master face {opposite}: one of them is turned over or \
                 strongly curved as seen along the slave's normal; refine there"
            );
            slave.refuse(at, &what)
        })?;
        if !part.points.is_empty() {
            area += part.area;
            over.push(opposite);
            parts.push((other.kind, other.nodes, part));
        }
    }
    if parts.is_empty() {
        return Ok(None);
    }
    let cover = area / in_plane.area;
    if cover > 1.0 + COVER {
        let over: Vec<String> = over.iter().map(index).collect();
        let what = format!(
            "lies under master faces that lie over each other, among {}: leave the hidden ones out, or \
             give a smaller search distance",
            over.join(", ")
        );
        return Err(slave.refuse(at, &what));
    }
    let covered = project(face.kind, &parts);
    Ok(Some(CoveredFace { face, covered, wholly: cover >= 1.0 - COVER }))
}

/// The rows of all nodes with cover, by node.
fn rows(faces: &[CoveredFace<'_>]) -> BTreeMap<usize, Row> {
    let mut edges = Edges::default();
    for CoveredFace { face, wholly, .. } in faces {
        edges.add(face.kind, face.nodes, *wholly);
    }
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for CoveredFace { face, covered, wholly } in faces {
        let basis = edges.basis(face.kind, face.nodes, *wholly);
        let areas = basis.functions(covered.integrals);
        let whole = basis.functions(whole_integrals(face));
        let masters: Vec<(usize, Values)> = covered
            .masters
            .iter()
            .map(|(node, values)| (*node, basis.control_values(*values)))
            .collect();
        let own = unit_values(face.kind.nodes()).map(|unit| basis.control_values(unit));
        let own: Vec<(usize, Values)> = face.nodes.iter().copied().zip(own).collect();
        for (j, &node) in face.nodes.iter().enumerate() {
            let scaled = |values: &[(usize, Values)]| -> Vec<Weight> {
                values.iter().map(|(node, values)| (*node, areas[j] * values[j])).collect()
            };
            let row = rows.entry(node).or_default();
            row.area += areas[j];
            row.whole += whole[j];
            row.slaves.extend(scaled(&own));
            row.masters.extend(scaled(&masters));
        }
    }
    rows
}
