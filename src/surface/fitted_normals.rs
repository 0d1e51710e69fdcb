//! Normals at nodes for curving faces, fitted to the places of nodes around: the mean of the faces' normals is wrong by as
//! much as divisions differ, which at 64 divisions is more than an interference of a thousandth.
//!
//! In the plane tangents of chords, each by the inverse of its length: exact on a circle, whatever the divisions. In space a
//! quadric by least squares through the node, over the faces around it and, of linear ones or if they have few nodes, those
//! around these, in the frame of the normal, twice. Products with the height make it exact on spheres,
//! cylinders and cones; faces with mid nodes, which are near their shape as they are, have that of the height with itself
//! alone. Neither looks across an edge at which faces turn sharply. Images beyond planes of symmetry and boundaries of sectors
//! count as in the whole body.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::face::Face;
use super::fitted_quadric::{Form, fit};
use super::mesh::Side;
use super::normals::direction;
use super::shape::{MANY_FACES, MOST_NODES, padded};
use crate::error::Error;
use crate::linalg::vector3::{Vector3, axis, unit};
use crate::problem::Islands;

/// Neighbours are parts of one smooth surface if the cosine between their normals is above this: 35 degrees, as 13
/// divisions of a circle whose nodes are shifted by a fifth have them.
pub(super) const SMOOTH: f64 = 0.82;

/// Unit normals of each face at its nodes.
pub(super) type Fitted = Vec<[Vector3; MOST_NODES]>;

/// # Errors
/// What stops the pairing.
pub(super) fn fitted(side: &Side<'_>) -> Result<Fitted, Error> {
    if side.dim == 2 { on_lines(side) } else { on_faces(side) }
}

/// The nodes of a line in the order in which it runs through them.
fn along(face: &Face<'_>) -> Vec<usize> {
    [0, 2, 1].into_iter().filter(|&i| i < face.kind.nodes()).collect()
}

/// The neighbours of a node along its line: the chord that ends there, and the one that begins there.
type Chords = [Option<Vector3>; 2];

fn on_lines(side: &Side<'_>) -> Result<Fitted, Error> {
    let mut chords: HashMap<usize, Chords> = HashMap::new();
    for face in side.each_face() {
        let (_, face) = face?;
        for ends in along(&face).windows(2) {
            let chord = face.x[ends[1]] - face.x[ends[0]];
            chords.entry(face.nodes[ends[0]]).or_default()[1] = Some(chord);
            chords.entry(face.nodes[ends[1]]).or_default()[0] = Some(chord);
        }
    }
    let inner = |node: &usize| match chords[node] {
        [Some(a), Some(b)] if a.dot(&b) > SMOOTH * a.norm() * b.norm() => {
            unit(a / a.norm_squared() + b / b.norm_squared())
        }
        _ => None,
    };
    let normals = |at: usize| {
        let face = side.face(at);
        let mut normals = [Vector3::zeros(); MOST_NODES];
        let order = along(&face);
        for (place, &i) in order.iter().enumerate() {
            // At an end the tangent of the arc that the neighbour's tangent determines.
            let beside = order[if place == 0 { 1 } else { place - 1 }];
            let chord = unit(face.x[i] - face.x[beside]).unwrap_or_default();
            let mirrored = |t: Vector3| 2.0 * chord.dot(&t) * chord - t;
            let tangent = inner(&face.nodes[i])
                .or_else(|| inner(&face.nodes[beside]).map(mirrored))
                .unwrap_or(if place == 0 { -chord } else { chord });
            normals[i] = tangent.cross(&axis(2));
        }
        normals
    };
    Ok((0..side.count()).map(normals).collect())
}

/// The fans of nodes: the faces around a node, apart where sharp edges part them.
struct Fans {
    /// Number of nodes of the faces before each one.
    before: Vec<usize>,
    /// The fan of each node of each face, those of a face one behind the other.
    of_node: Vec<usize>,
    /// The faces of each fan.
    faces: Vec<Vec<usize>>,
    /// True for a fan with an edge at which no face goes on smoothly, and at mid nodes, which do not tell.
    at_rim: Vec<bool>,
}

impl Fans {
    fn new(side: &Side<'_>) -> Result<Self, Error> {
        let (mut before, mut edges) = (vec![0], Vec::new());
        for face in side.each_face() {
            let (at, face) = face?;
            before.push(before[at] + face.nodes.len());
            for mut ends in face.kind.edges() {
                ends.sort_unstable_by_key(|&i| face.nodes[i]);
                let normals = ends.map(|i| face.normal(face.kind.places()[i]));
                edges.push((ends.map(|i| face.nodes[i]), at, normals));
            }
        }
        edges.sort_unstable_by_key(|&(ends, at, _)| (ends, at));
        let (mut smooth, mut inner) = (Vec::new(), HashSet::new());
        for faces in edges.chunk_by(|one, other| one.0 == other.0) {
            for (k, (ends, at, normals)) in faces.iter().enumerate() {
                for (_, other, others) in &faces[..k] {
                    if normals.iter().zip(others).all(|(a, b)| a.dot(b) > SMOOTH) {
                        smooth.push([*at, *other]);
                        inner.insert(*ends);
                    }
                }
            }
        }
        let places = |at: usize| side.nodes(at).iter().zip(before[at]..);
        let common = |[at, other]: [usize; 2]| {
            let of_other = move |node| places(other).find(|(other, _)| *other == node);
            places(at).filter_map(move |(node, place)| Some((place, of_other(node)?.1)))
        };
        let joined = smooth.iter().flat_map(|&faces| common(faces));
        let fans = Islands::new(before[side.count()], joined);
        let mut of_node = vec![0; before[side.count()]];
        for (fan, places) in fans.each().enumerate() {
            places.iter().for_each(|&place| of_node[place] = fan);
        }
        let (mut faces, mut at_rim) = (vec![Vec::new(); fans.len()], vec![false; fans.len()]);
        for at in 0..side.count() {
            let (nodes, own) = (side.nodes(at), &of_node[before[at]..before[at + 1]]);
            own.iter().for_each(|&fan| faces[fan].push(at));
            let kind = side.kind(nodes);
            own[kind.corners()..].iter().for_each(|&fan| at_rim[fan] = true);
            for ends in kind.edges() {
                let mut key = ends.map(|i| nodes[i]);
                key.sort_unstable();
                if !inner.contains(&key) {
                    ends.iter().for_each(|&i| at_rim[own[i]] = true);
                }
            }
        }
        Ok(Fans { before, of_node, faces, at_rim })
    }

    /// The fans of the nodes of a face.
    fn of_face(&self, at: usize) -> &[usize] {
        &self.of_node[self.before[at]..self.before[at + 1]]
    }

    /// The fans at the nodes of the faces of some fans. A hub of many faces would tell of those far away, to each node around it.
    fn around(&self, fans: &BTreeSet<usize>) -> BTreeSet<usize> {
        let faces = fans.iter().map(|&fan| &self.faces[fan]);
        let near = faces.filter(|faces| fans.len() == 1 || faces.len() <= MANY_FACES).flatten();
        near.flat_map(|&at| self.of_face(at)).copied().collect()
    }
}

fn on_faces(side: &Side<'_>) -> Result<Fitted, Error> {
    let fans = Fans::new(side)?;
    let node = |fan: usize| {
        let at = fans.faces[fan][0];
        let place = fans.of_face(at).iter().position(|&other| other == fan);
        side.nodes(at)[place.unwrap_or_default()]
    };
    let middles: Vec<Vector3> = (0..side.count()).map(|at| side.face(at).middle_normal()).collect();
    let mut normals = Vec::with_capacity(fans.faces.len());
    for (fan, faces) in fans.faces.iter().enumerate() {
        side.progress.goes_on()?;
        let ring = fans.around(&BTreeSet::from([fan]));
        let is_linear = side.face(faces[0]).kind.mids().next().is_none();
        // Three rows of nodes, of which the largest faces at an edge have five each, do not determine cubes.
        let is_enough = !is_linear && ring.len() >= 2 * MOST_NODES;
        let near = if is_enough { ring.clone() } else { fans.around(&ring) };
        let form = match near.iter().all(|&fan| fans.at_rim[fan]) {
            true => Form::Layer,
            false if is_linear => Form::Linear,
            false => Form::Curved,
        };
        let own = node(fan);
        let nodes: BTreeSet<usize> = near.into_iter().map(node).collect();
        let from = nodes.iter().map(|&other| side.position(other) - side.position(own));
        // Two nodes may stand at one place.
        let from: Vec<Vector3> = from.filter(|x| x.norm() > 0.0).collect();
        // Normals of faces around enclose it, but where a quadric bends in ways of its own: next to what is flat, and of rounding.
        let mean = mean(side, faces, own);
        let fitted = fit(mean, &from, form);
        let apart = |&at: &usize| (middles[at] - mean).norm();
        let spread = ring.iter().flat_map(|&fan| &fans.faces[fan]).map(apart).fold(0.0, f64::max);
        normals.push(if (fitted - mean).norm() <= spread { fitted } else { mean });
    }
    let of_face = |at| padded(fans.of_face(at).iter().map(|&fan| normals[fan]));
    Ok((0..side.count()).map(of_face).collect())
}

/// The mean normal at a node of some faces; that of the first if they cancel.
fn mean(side: &Side<'_>, faces: &[usize], node: usize) -> Vector3 {
    let normal = |&at: &usize| {
        let face = side.face(at);
        let place = face.nodes.iter().position(|&other| other == node).unwrap_or_default();
        face.normal(face.kind.places()[place])
    };
    let sum = faces.iter().map(normal).sum();
    direction(sum, faces.len() as f64).unwrap_or_else(|| normal(&faces[0]))
}
