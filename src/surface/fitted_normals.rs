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
use super::watch::Watch;
use crate::error::Error;
use crate::linalg::vector3::{Vector3, axis, unit};
use crate::problem::Islands;

/// Neighbours are parts of one smooth surface if the cosine between their normals is above this: 35 degrees, as 13
/// divisions of a circle whose nodes are shifted by a fifth have them.
pub(super) const SMOOTH: f64 = 0.82;

/// Unit normals of each face at its nodes.
pub(super) type Fitted = Vec<[Vector3; MOST_NODES]>;

/// # Errors
/// What ends the watch.
pub(super) fn fitted(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Fitted, Error> {
    if side.dim == 2 { on_lines(side, watch) } else { on_faces(side, watch) }
}

/// The nodes of a line in the order in which it runs through them.
fn along(face: &Face<'_>) -> Vec<usize> {
    [0, 2, 1].into_iter().filter(|&i| i < face.kind.nodes()).collect()
}

/// The neighbours of a node along its line: the chord that ends there, and the one that begins there.
type Chords = [Option<Vector3>; 2];

fn on_lines(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Fitted, Error> {
    let mut chords: HashMap<usize, Chords> = HashMap::new();
    for at in 0..side.count() {
        watch.goes_on()?;
        let face = side.face(at);
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

/// The smooth surface that each face is a part of, by number, and the corners at its rims with it.
type Surfaces = (Vec<usize>, HashSet<(usize, usize)>);

fn surfaces(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Surfaces, Error> {
    let mut edges: HashMap<[usize; 2], (usize, [Vector3; 2])> = HashMap::new();
    let (mut smooth, mut inner) = (Vec::new(), HashSet::new());
    for at in 0..side.count() {
        watch.goes_on()?;
        let face = side.face(at);
        for mut ends in face.kind.edges() {
            ends.sort_unstable_by_key(|&i| face.nodes[i]);
            let normals = ends.map(|i| face.normal(face.kind.places()[i]));
            let edge = edges.insert(ends.map(|i| face.nodes[i]), (at, normals));
            let Some((other, others)) = edge else { continue };
            if normals.iter().zip(&others).all(|(a, b)| a.dot(b) > SMOOTH) {
                smooth.push((at, other));
                inner.insert(ends.map(|i| face.nodes[i]));
            }
        }
    }
    let mut surface = vec![0; side.count()];
    for (number, faces) in Islands::new(side.count(), smooth.into_iter()).each().enumerate() {
        faces.iter().for_each(|&face| surface[face] = number);
    }
    let mut rims = HashSet::new();
    for (at, &surface) in surface.iter().enumerate() {
        let face = side.face(at);
        for ends in face.kind.edges() {
            let mut ends = ends.map(|i| face.nodes[i]);
            ends.sort_unstable();
            if !inner.contains(&ends) {
                rims.extend(ends.map(|node| (surface, node)));
            }
        }
    }
    Ok((surface, rims))
}

fn on_faces(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Fitted, Error> {
    let (surface, rims) = surfaces(side, watch)?;
    // The faces at each node of a smooth surface.
    let mut around: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
    for (at, &surface) in surface.iter().enumerate() {
        for &node in side.face(at).nodes {
            around.entry((surface, node)).or_default().push(at);
        }
    }
    // A hub of many faces would tell of those far away, to each node around it.
    let ring = |surface: usize, nodes: &BTreeSet<usize>| {
        let faces = nodes.iter().map(|&node| &around[&(surface, node)]);
        let faces = faces.filter(|faces| nodes.len() == 1 || faces.len() <= MANY_FACES).flatten();
        faces.flat_map(|&at| side.face(at).nodes.to_vec()).collect::<BTreeSet<usize>>()
    };
    let mut normals = HashMap::with_capacity(around.len());
    for (&(surface, node), faces) in &around {
        watch.goes_on()?;
        let mut near = ring(surface, &BTreeSet::from([node]));
        let is_linear = side.face(faces[0]).kind.mids().next().is_none();
        // Fewer nodes than the largest face has determine a quadric badly.
        if is_linear || near.len() < MOST_NODES {
            near = ring(surface, &near);
        }
        let is_at_rim = |node: &usize| rims.contains(&(surface, *node));
        let form = match is_linear {
            true if near.iter().all(is_at_rim) => Form::Layer,
            true => Form::Linear,
            false => Form::Curved,
        };
        near.remove(&node);
        let from = near.iter().map(|&other| side.position(other) - side.position(node));
        // Two nodes may stand at one place.
        let from: Vec<Vector3> = from.filter(|x| x.norm() > 0.0).collect();
        // Places may tell of another side.
        let mean = mean(side, faces, node);
        let fitted = fit(mean, &from, form);
        let normal = if fitted.dot(&mean) > SMOOTH { fitted } else { mean };
        normals.insert((surface, node), normal);
    }
    let of_face = |(at, &surface): (usize, &usize)| {
        padded(side.nodes(at).iter().map(|&node| normals[&(surface, node)]))
    };
    Ok(surface.iter().enumerate().map(of_face).collect())
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
