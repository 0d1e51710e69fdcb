//! How much of the gaps is that of facets: what is lost or added where divisions of two curved sides differ.
//!
//! A face between nodes of a curved surface stands off it by a sagitta. On an edge the normals at its ends, the means of all faces
//! there, tell it by how far they are inclined to the face: a parabola whose slopes at the ends of a chord are `t` stands off by `t / 6`
//! of the chord in the mean, a quartic that meets the middle too by `t / 30`. A mid node that lies on the chord does not meet the
//! surface. A face stands off by the mean of its edges along each direction, which a triangle and a quadrilateral have alike: half the
//! sum over all edges. Equal facets of both sides cancel, as one is hollow.

use super::digits::left_open;
use super::face::Face;
use super::fitted_normals::SMOOTH;
use super::mesh::Side;
use super::pairs::{SurfacePairs, Weight};
use super::settings::{Pairing, SurfaceSettings, TrueShape};
use super::shape::padded;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Facets are larger than an interference allows if they change it by more than this part of it: pressures are wrong by as much.
const ALLOWED: f64 = 0.1;

/// They are told if they do so on one of so many parts of the area of curved faces, by how far these stand off: a round body that
/// touches, or is loose, does so at a few of its pairs.
const A_PART: f64 = 4.0;

/// How far true surfaces stand off the facets of both sides at each pair, in the mean.
pub(super) fn stand_off(
    [slave, master]: [&Side<'_>; 2],
    settings: &SurfaceSettings,
    found: &mut SurfacePairs,
) -> Result<(), Error> {
    // Those of sides that are tied fit.
    if settings.keep_turns {
        return Ok(());
    }
    let [own, opposite] = settings.shapes.map(|shape| shape == TrueShape::Facets);
    // Of nodes against surfaces slave nodes are on the true surface.
    let own = own && settings.pairing == Pairing::DualMortar;
    let of_side =
        |side, is_of_facets| if is_of_facets { at_all_nodes(side) } else { Ok(Vec::new()) };
    let sides = [of_side(slave, own)?, of_side(master, opposite)?];
    let mean = |away: &[f64], nodes: &[Weight]| -> f64 {
        nodes.iter().map(|(node, part)| part * away.get(*node).unwrap_or(&0.0)).sum()
    };
    found.report.stand_off.reserve_exact(found.pairs.len());
    for pair in &found.pairs {
        slave.progress.goes_on()?;
        let both = [mean(&sides[0], pair.slaves()), mean(&sides[1], pair.masters())];
        found.report.stand_off.push((pair.slave, both));
    }
    Ok(())
}

/// The mean at each node of what the faces around it stand off; zero at other nodes.
fn at_all_nodes(side: &Side<'_>) -> Result<Vec<f64>, Error> {
    let count = side.coordinates.len() / side.dim;
    let mut normals = vec![Vector3::zeros(); count];
    let mut of_faces: Vec<[Vector3; 4]> = Vec::with_capacity(side.count());
    for face in side.each_face() {
        let (_, face) = face?;
        let own = at_corners(&face);
        for (&node, normal) in face.nodes.iter().take(face.kind.corners()).zip(&own) {
            normals[node] += normal;
        }
        of_faces.push(own);
    }
    let mut sums = vec![[0.0; 2]; count];
    for face in side.each_face() {
        let (at, face) = face?;
        let away = of_face((&face, &of_faces[at]), &normals);
        for &node in face.nodes {
            let [sum, faces] = &mut sums[node];
            *sum += away;
            *faces += 1.0;
        }
    }
    Ok(sums.into_iter().map(|[sum, faces]| sum / f64::max(faces, 1.0)).collect())
}

/// Unit normals of a face at its corners; of linear ones that in the middle.
fn at_corners(face: &Face<'_>) -> [Vector3; 4] {
    if face.kind.mids().next().is_none() {
        return [face.middle_normal(); 4];
    }
    padded(face.kind.places()[..face.kind.corners()].iter().map(|at| face.normal(*at)))
}

/// How far the true surface stands off a face with its `own` normals in the mean, outward, with normals of nodes of any length.
fn of_face((face, own): (&Face<'_>, &[Vector3; 4]), normals: &[Vector3]) -> f64 {
    let steepest = (1.0 - SMOOTH) / (1.0 + SMOOTH);
    // How far the face falls behind the surface from a corner on along an edge, by slope; across a sharp edge there is no surface.
    let slopes: [Vector3; 4] = padded((0..face.kind.corners()).map(|at| {
        let mean = normals[face.nodes[at]];
        let across = mean.dot(&own[at]);
        if across > 0.0 { own[at] - mean / across } else { Vector3::zeros() }
    }));
    let fall = |at: usize, along: &Vector3| {
        let fall = slopes[at].dot(along);
        if fall * fall <= steepest * along.norm_squared() { fall } else { 0.0 }
    };
    let of_edge = |[at, next]: [usize; 2]| {
        let along = face.x[next] - face.x[at];
        // A face that is bent at one end alone is flat, beside an edge of the body.
        let [a, b] = [fall(at, &along), -fall(next, &along)];
        let least = if a * b > 0.0 { 4.0 * a.abs().min(b.abs()) } else { 0.0 };
        let turn = (a + b).clamp(-least, least);
        // A parabola with these slopes at its ends stands off by an eighth of their sum in the middle. A mid node that stands off the
        // chord by less than half of it is not on the surface: the mean of both normals has half the length of their sum.
        let sagitta = turn.abs() / 8.0;
        let meets = face.kind.mids().any(|(mid, ends)| {
            let off = face.x[mid] - 0.5 * (face.x[at] + face.x[next]);
            let off = off.dot(&(own[at] + own[next])).abs();
            ends.contains(&at) && ends.contains(&next) && off >= sagitta
        });
        turn / if meets { 60.0 } else { 12.0 }
    };
    0.5 * face.kind.edges().map(of_edge).sum::<f64>()
}

/// Number of pairs at which facets change an interference by more than it allows, and the most by which they do; `None`: these
/// are few, or the faces are flat but for the digits of coordinates.
///
/// # Errors
/// What stops the pairing.
pub(super) fn too_large(
    found: &SurfacePairs,
    (slave, settings): (&Side<'_>, &SurfaceSettings),
) -> Result<Option<(usize, f64)>, Error> {
    let (mut count, mut most, mut of_them, mut of_all) = (0, 0.0, 0.0, 0.0);
    for (pair, &(_, [own, opposite])) in found.pairs.iter().zip(&found.report.stand_off) {
        slave.progress.goes_on()?;
        let lost = own + opposite;
        let weight = pair.area * (own.abs() + opposite.abs());
        // Nodes that were moved onto the other side have left nearly nothing between them.
        let meets = pair.measured_gap.abs() <= ALLOWED * ALLOWED * lost.abs();
        let lost = if meets { 0.0 } else { lost };
        let [seen, interference] =
            [0.0, lost].map(|lost| -settings.gap(pair.measured_gap - lost, pair.moving));
        let change = (interference - seen).abs();
        // A fit without play is one but for the accuracy of what is lost.
        let overlap = f64::max(seen, interference + ALLOWED * change);
        of_all += weight;
        if overlap > 0.0 && change > ALLOWED * interference.max(0.0) {
            count += 1;
            of_them += weight;
            most = f64::max(most, change);
        }
    }
    let are_many = count > 0 && A_PART * of_them >= of_all;
    // Clear of the digits of coordinates, of which flat faces are made too.
    let digits = || left_open(slave.dim, &slave.lengths().collect::<Vec<f64>>());
    let is_seen = || ALLOWED * most > digits();
    Ok((are_many && is_seen()).then_some((count, most)))
}
