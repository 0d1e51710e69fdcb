//! How much of the gaps is that of facets: what is lost or added where divisions of two curved sides differ.
//!
//! A face between nodes of a curved surface stands off it by a sagitta. On an edge the normals at its ends, the means of all faces
//! there, tell it by how far they are inclined to the face: a parabola whose slopes at the ends of a chord are `t` stands off by `t / 6`
//! of the chord in the mean, a quartic that meets the middle too by `t / 30`. A mid node on the chord does not meet the surface, which
//! stands off it by `t / 4`. A face stands off by the mean of its edges along each direction, which a triangle and a quadrilateral have
//! alike: half the sum over all edges. Equal facets of both sides cancel, as one is hollow.

use super::digits::left_open;
use super::face::Face;
use super::fitted_normals::SMOOTH;
use super::mesh::Side;
use super::on_chords::on_chords;
use super::pairs::{SurfacePairs, Weight};
use super::settings::{SurfaceSettings, TrueShape};
use super::shape::padded;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Facets are larger than an interference or a clearance allows if they change it by more than this part of it: pressures are wrong by
/// as much.
pub(super) const ALLOWED: f64 = 0.1;

/// They are told if they do so on one of so many parts of the area of curved faces, by how far these stand off: a round body that
/// touches, or is loose, does so at a few of its pairs.
const A_PART: f64 = 4.0;

/// How far true surfaces stand off the facets of both sides at each pair, in the mean. Where the slave is seen `by_nodes`, these have
/// gaps, and its faces none.
pub(super) fn stand_off(
    [slave, master]: [&Side<'_>; 2],
    (settings, by_nodes): (&SurfaceSettings, bool),
    found: &mut SurfacePairs,
) -> Result<(), Error> {
    // Those of sides that are tied fit.
    if settings.keep_turns {
        return Ok(());
    }
    let [own, opposite] = settings.shapes.map(|shape| shape == TrueShape::Facets);
    let of_side = |side, is_of_facets, by_nodes| {
        if is_of_facets { at_all_nodes(side, by_nodes) } else { Ok(Vec::new()) }
    };
    let sides = [of_side(slave, own, by_nodes)?, of_side(master, opposite, false)?];
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

/// How far the surface stands off at each node: off a node on a chord by its sagitta, which the rows of pairs carry through faces, and
/// by the mean of what the faces around a node have beside that, unless nodes alone are seen; zero at other nodes.
fn at_all_nodes(side: &Side<'_>, by_nodes: bool) -> Result<Vec<f64>, Error> {
    let (normals, on_chords) = (Normals::of(side)?, on_chords(side)?);
    // Of faces, and of sagittas: sums, and how many there are.
    let mut sums = vec![[[0.0; 2]; 2]; normals.at_nodes.len()];
    for face in side.each_face() {
        let (at, face) = face?;
        let (mut mean, mut middle) = (0.0, 0.0);
        for edge in normals.edges(at, &face) {
            // The mean of a quartic, and of a parabola with these slopes at its ends, or what it is in the middle.
            match edge.mid {
                Some(_) if !on_chords[at] => mean += edge.turn / 120.0,
                None => mean += edge.turn / 24.0,
                Some(mid) => {
                    middle += edge.turn / 16.0;
                    let [_, [sum, count]] = &mut sums[face.nodes[mid]];
                    *sum += edge.turn / 8.0;
                    *count += 1.0;
                }
            }
        }
        let seen = if by_nodes { &[] } else { face.nodes };
        for &node in seen {
            let [[sum, count], _] = &mut sums[node];
            *sum += mean;
            *count += 1.0;
        }
        if let Some(centre) = face.kind.central_node() {
            sums[face.nodes[centre]][1] = [middle, 1.0];
        }
    }
    let mean = |[sum, count]: [f64; 2]| sum / f64::max(count, 1.0);
    Ok(sums.into_iter().map(|sums| sums.map(mean).iter().sum()).collect())
}

/// Unit normals of a face at its corners; of linear ones that in the middle.
fn at_corners(face: &Face<'_>) -> [Vector3; 4] {
    if face.kind.mids().next().is_none() {
        return [face.middle_normal(); 4];
    }
    padded(face.kind.places()[..face.kind.corners()].iter().map(|at| face.normal(*at)))
}

/// Normals of a side at its nodes, of any length, and of each face at its corners.
struct Normals {
    at_nodes: Vec<Vector3>,
    of_faces: Vec<[Vector3; 4]>,
}

/// An edge of a face on a curved surface.
struct Edge {
    /// How far its ends fall behind the surface together, over the whole edge, by their slopes.
    turn: f64,
    /// Its mid node, by its place in the face.
    mid: Option<usize>,
}

impl Normals {
    fn of(side: &Side<'_>) -> Result<Normals, Error> {
        let mut at_nodes = vec![Vector3::zeros(); side.coordinates.len() / side.dim];
        let mut of_faces: Vec<[Vector3; 4]> = Vec::with_capacity(side.count());
        for face in side.each_face() {
            let (_, face) = face?;
            let own = at_corners(&face);
            for (&node, normal) in face.nodes.iter().take(face.kind.corners()).zip(&own) {
                at_nodes[node] += normal;
            }
            of_faces.push(own);
        }
        Ok(Normals { at_nodes, of_faces })
    }

    /// The edges of a face by its place.
    fn edges(&self, at: usize, face: &Face<'_>) -> impl Iterator<Item = Edge> {
        let (own, steepest) = (&self.of_faces[at], (1.0 - SMOOTH) / (1.0 + SMOOTH));
        // How far the face falls behind the surface from a corner on along an edge, by slope; across a sharp edge there is no surface.
        let slopes: [Vector3; 4] = padded((0..face.kind.corners()).map(|at| {
            let mean = self.at_nodes[face.nodes[at]];
            let across = mean.dot(&own[at]);
            if across > 0.0 { own[at] - mean / across } else { Vector3::zeros() }
        }));
        face.kind.edges().map(move |[at, next]| {
            let along = face.x[next] - face.x[at];
            let fall = |at: usize| {
                let fall = slopes[at].dot(&along);
                if fall * fall <= steepest * along.norm_squared() { fall } else { 0.0 }
            };
            // A face that is bent at one end alone is flat, beside an edge of the body.
            let [a, b] = [fall(at), -fall(next)];
            let least = if a * b > 0.0 { 4.0 * a.abs().min(b.abs()) } else { 0.0 };
            let turn = (a + b).clamp(-least, least);
            let mid = face.kind.mids().find(|(_, ends)| ends.contains(&at) && ends.contains(&next));
            Edge { turn, mid: mid.map(|(mid, _)| mid) }
        })
    }
}

/// Pairs at which facets change gaps much.
#[derive(Clone, Copy, Default)]
pub(super) struct Large {
    pub(super) count: usize,
    /// The most by which they change one.
    pub(super) most: f64,
    weight: f64,
}

impl Large {
    /// One more pair, of which facets change the gap so much, with its weight.
    pub(super) fn add(&mut self, change: f64, weight: f64) {
        self.count += 1;
        self.most = self.most.max(change);
        self.weight += weight;
    }

    /// True if they are many beside all with such a weight.
    pub(super) fn is_many_of(&self, of_all: f64) -> bool {
        self.count > 0 && A_PART * self.weight >= of_all
    }
}

/// True of a change that is clear of the digits of coordinates, of which flat faces are made too.
pub(super) fn is_clear_of_digits(change: f64, side: &Side<'_>) -> bool {
    ALLOWED * change > left_open(side.dim, &side.lengths().collect::<Vec<f64>>())
}

/// Number of pairs at which facets change an interference or a clearance by more than it allows, and the most by which they do; `None`:
/// these are few, or the faces are flat but for the digits of coordinates.
///
/// # Errors
/// What stops the pairing.
pub(super) fn too_large(
    found: &SurfacePairs,
    (slave, settings): (&Side<'_>, &SurfaceSettings),
) -> Result<Option<(usize, f64)>, Error> {
    // Those that press, by the faces or by the surfaces, and all.
    let mut large = [Large::default(); 2];
    let (mut of_all, mut changes, mut sizes) = (0.0, 0.0, 0.0);
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
        let presses = f64::max(seen, interference + ALLOWED * change) > 0.0;
        of_all += weight;
        changes += weight * change * change;
        sizes += weight * interference * interference;
        if change > ALLOWED * interference.abs() {
            large[usize::from(!presses)..].iter_mut().for_each(|large| large.add(change, weight));
        }
    }
    let [pressed, all] = large;
    let are_many = pressed.is_many_of(of_all);
    // A body that is loose all around, as a shaft in its bearing.
    let is_loose = changes > ALLOWED * ALLOWED * sizes;
    let told = if are_many { pressed } else { all };
    let is_told = (are_many || is_loose) && is_clear_of_digits(told.most, slave);
    Ok(is_told.then_some((told.count, told.most)))
}
