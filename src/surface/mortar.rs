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
use super::mesh::Side;
use super::normals::{at_nodes, direction};
use super::overlap::{Overlaps, SlaveFace};
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport};
use super::plane::Plane;
use super::projected_shapes::{Covered, Opposite, Polynomials};
use super::rims::{self, SAME_COVER};
use super::row::{Row, add_face};
use super::settings::{Normals, SurfaceSettings};
use super::shape::{FaceKind, Values};
use super::symmetry::OnPlanes;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::Vector3;

/// A slave face that lies over master faces.
struct CoveredFace<'a> {
    /// Its place among the slave faces.
    at: usize,
    kind: FaceKind,
    nodes: &'a [usize],
    covered: Covered,
    /// Integrals of its shape functions over the whole face.
    whole: Values,
    wholly: bool,
}

/// The memory that the search uses from face to face.
struct Search {
    candidates: Candidates,
    overlaps: Overlaps,
    polynomials: Polynomials,
}

/// The pairs of two sides.
///
/// # Errors
/// Master faces that lie over each other; faces that are turned over in the projection; normals that
/// cancel at a slave node, or that are across a plane of symmetry.
pub(super) fn pairs(
    [slave, master]: [&Side<'_>; 2],
    dim: usize,
    planes: &OnPlanes,
    candidates: Candidates,
    settings: &SurfaceSettings,
) -> Result<SurfacePairs, Error> {
    let mut report = SurfaceReport {
        search_distance: candidates.reach,
        slave_faces: slave.count(),
        ..SurfaceReport::default()
    };
    let (overlaps, polynomials) = (Overlaps::default(), Polynomials::default());
    let SurfaceSettings { normals, rims, .. } = *settings;
    let search = &mut Search { candidates, overlaps, polynomials };
    let mut faces = Vec::new();
    for at in 0..slave.count() {
        let face = slave.face(at);
        let whole = face.integrals();
        report.slave_area += whole.iter().sum::<f64>();
        match cover([slave, master], (at, &face, whole), dim, search)? {
            Some(face) => faces.push(face),
            None => report.uncovered_faces.push(at),
        }
    }
    report.boxes_searched = search.candidates.searched;
    report.not_opposed = search.candidates.not_opposed;
    let mut rows = rows(slave, &faces, normals);
    let around = faces.iter().map(|face| face.nodes);
    let little = rims::settle(rims, &mut rows, around, |node| slave.position(node));
    (report.folded, report.dropped) = (little.folded, little.dropped);
    let averaged = match normals {
        Normals::Averaged => Some(slave.node_normals_on(planes)?),
        Normals::Faces => None,
    };
    let pairs: Vec<SurfacePair> = rows
        .into_iter()
        .map(|(node, row)| {
            let area = row.area;
            let normal = match &averaged {
                Some(normals) => normals[&node],
                None => planes.turned(node, normal_of_faces(node, &row)?),
            };
            let weights = row.into_weights();
            let points = (slave.point(&weights[0]), Some(master.point(&weights[1])));
            planes.hold(SurfacePair::new(dim, (node, area), weights, normal, points))
        })
        .collect::<Result<_, Error>>()?;
    report.covered_area = pairs.iter().map(|pair| pair.area).sum();
    let has_pair = |node: &usize| pairs.binary_search_by_key(node, |pair| pair.slave).is_ok();
    let unpaired = slave.all_nodes().into_iter().filter(|node| !has_pair(node)).collect();
    Ok(SurfacePairs { dim, pairs, unpaired, report })
}

/// The normal of a row from those of the faces in contact.
fn normal_of_faces(node: usize, row: &Row) -> Result<Vector3, Error> {
    direction(row.normal, row.area).ok_or_else(|| {
        let message = format!("the normals of the slave faces at node {} cancel", index(node));
        Error::invalid(Argument::SlaveFaces, message)
    })
}

/// The part of the master that a slave face lies over. `whole` are the integrals of its shape functions over all of it.
fn cover<'a>(
    [slave, master]: [&Side<'a>; 2],
    (at, face, whole): (usize, &Face<'a>, Values),
    dim: usize,
    search: &mut Search,
) -> Result<Option<CoveredFace<'a>>, Error> {
    let normal = middle_normal(face);
    let plane = Plane::new(dim, face.position(face.kind.centre()), normal);
    let in_plane = SlaveFace::new(face, plane);
    let Search { candidates, overlaps, polynomials } = search;
    overlaps.points.clear();
    let reach = candidates.reach;
    let mut parts = Vec::new();
    let (mut area, mut over) = (0.0, Vec::new());
    for &opposite in candidates.of_face(face, normal) {
        let other = master.face(opposite);
        let before = overlaps.points.len();
        area += in_plane.overlap(&other, reach, overlaps).map_err(|_| {
            let opposite = index(opposite);
            let what = format!(
                "cannot be projected on master face {opposite}: one of them is turned over or \
                 strongly curved as seen along the slave's normal; refine there"
            );
            slave.refuse(at, &what)
        })?;
        let points = before..overlaps.points.len();
        if !points.is_empty() {
            over.push(opposite);
            parts.push(Opposite { kind: other.kind, nodes: other.nodes, points });
        }
    }
    if parts.is_empty() {
        return Ok(None);
    }
    let cover = area / in_plane.area;
    if cover > 1.0 + SAME_COVER {
        let over: Vec<String> = over.iter().map(index).collect();
        let what = format!(
            "lies under master faces that lie over each other, among {}: leave the hidden ones out, or \
             give a smaller search distance",
            over.join(", ")
        );
        return Err(slave.refuse(at, &what));
    }
    let covered = polynomials.project(face.kind, &overlaps.points, &parts);
    let (kind, nodes, wholly) = (face.kind, face.nodes, cover >= 1.0 - SAME_COVER);
    Ok(Some(CoveredFace { at, kind, nodes, covered, whole, wholly }))
}

/// The rows of all nodes with cover, by node. `whose` are the normals that they have.
fn rows(slave: &Side<'_>, faces: &[CoveredFace<'_>], whose: Normals) -> BTreeMap<usize, Row> {
    let mut edges = Edges::default();
    for CoveredFace { kind, nodes, wholly, .. } in faces {
        edges.add(*kind, nodes, *wholly);
    }
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for CoveredFace { at, kind, nodes, covered, whole, wholly } in faces {
        let basis = edges.basis(*kind, nodes, *wholly);
        let normals = match whose {
            Normals::Averaged => Default::default(),
            Normals::Faces => at_nodes(&slave.face(*at)),
        };
        let integrals = [covered.integrals, *whole];
        add_face(&mut rows, (nodes, &basis), integrals, covered.weights(), &normals);
    }
    rows
}
