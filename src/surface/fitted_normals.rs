//! Normals at nodes for curving faces, fitted to the places of nodes around: the mean of the faces' normals is wrong by as
//! much as divisions differ, which at 64 divisions is more than an interference of a thousandth.
//!
//! In the plane tangents of chords, each by the inverse of its length: exact on a circle, whatever the divisions. In space a
//! quadric by least squares through the node, over the faces around it and, of linear ones or if they have few nodes, those
//! around these, in the frame of the normal, twice. Products with the height make it exact on spheres,
//! cylinders and cones; faces with mid nodes, which are near their shape as they are, have that of the height with itself
//! alone. Neither looks across an edge at which faces turn sharply. Images beyond planes of symmetry and boundaries of sectors
//! count as in the whole body.

use std::collections::{BTreeSet, HashMap};
use std::f64::consts::SQRT_2;

use super::digits::ON_PLANE;
use super::face::Face;
use super::mesh::Side;
use super::normals::direction;
use super::plane;
use super::shape::MOST_NODES;
use super::watch::Watch;
use crate::error::Error;
use crate::linalg::least_squares::least_coefficients;
use crate::linalg::vector::norm;
use crate::linalg::vector3::{Vector3, axis, unit};
use crate::problem::Islands;

/// Neighbours are parts of one smooth surface if the cosine between their normals is above this: 35 degrees, as 13
/// divisions of a circle whose nodes are shifted by a fifth have them.
const SMOOTH: f64 = 0.82;

/// How dear slopes, and products with heights, are beside squares: nodes at the end of a patch have three places along an axis,
/// through which squares alone lead to the right slope, and those in one layer do not tell of a slope across it.
const DEAR: [f64; 2] = [3.0, 30.0];

/// Fits, each in the frame of the normal before.
const TURNS: usize = 2;

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

/// The smooth surface that each face is a part of, by number.
fn surfaces(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Vec<usize>, Error> {
    let mut edges: HashMap<[usize; 2], (usize, [Vector3; 2])> = HashMap::new();
    let mut smooth = Vec::new();
    for at in 0..side.count() {
        watch.goes_on()?;
        let face = side.face(at);
        let corners = face.kind.corners();
        for i in 0..corners {
            let mut ends = [i, (i + 1) % corners];
            ends.sort_unstable_by_key(|&i| face.nodes[i]);
            let normals = ends.map(|i| face.normal(face.kind.places()[i]));
            let edge = edges.insert(ends.map(|i| face.nodes[i]), (at, normals));
            let Some((other, others)) = edge else { continue };
            if normals.iter().zip(&others).all(|(a, b)| a.dot(b) > SMOOTH) {
                smooth.push((at, other));
            }
        }
    }
    let mut surface = vec![0; side.count()];
    for (number, faces) in Islands::new(side.count(), smooth.into_iter()).each().enumerate() {
        faces.iter().for_each(|&face| surface[face] = number);
    }
    Ok(surface)
}

fn on_faces(side: &Side<'_>, watch: &mut Watch<'_, '_>) -> Result<Fitted, Error> {
    let surface = surfaces(side, watch)?;
    // The faces at each node of a smooth surface.
    let mut around: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
    for (at, &surface) in surface.iter().enumerate() {
        for &node in side.face(at).nodes {
            around.entry((surface, node)).or_default().push(at);
        }
    }
    let ring = |surface: usize, nodes: &BTreeSet<usize>| {
        let faces = nodes.iter().flat_map(|&node| &around[&(surface, node)]);
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
        near.remove(&node);
        let from = near.iter().map(|&other| side.position(other) - side.position(node));
        // Two nodes may stand at one place.
        let from: Vec<Vector3> = from.filter(|x| x.norm() > 0.0).collect();
        normals.insert((surface, node), fit(mean(side, faces, node), &from, is_linear));
    }
    let of_face = |(at, &surface): (usize, &usize)| {
        let mut found = [Vector3::zeros(); MOST_NODES];
        let nodes = side.face(at).nodes;
        found.iter_mut().zip(nodes).for_each(|(n, &node)| *n = normals[&(surface, node)]);
        found
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

/// The normal of the quadric through the origin that is nearest to some places; the given one if they tell of another side.
fn fit(mean: Vector3, places: &[Vector3], is_linear: bool) -> Vector3 {
    let mut normal = mean;
    for _ in 0..TURNS {
        let across = plane::tangents(3, normal);
        let slopes = slopes(places, [across[0], across[1], normal], is_linear);
        normal = unit(normal - slopes[0] * across[0] - slopes[1] * across[1]).unwrap_or(normal);
    }
    if normal.dot(&mean) > SMOOTH { normal } else { mean }
}

/// The slopes along two axes of the quadric that is nearest to places. These may leave one free: a pair of planes holds the nodes of
/// one layer of faces around a cylinder or a cone. Then it is the one of least coefficients, with heights in a unit of their own;
/// its choice does not depend on how the axes are turned.
fn slopes(places: &[Vector3], axes: [Vector3; 3], is_linear: bool) -> [f64; 2] {
    let along = axes.map(|axis| places.iter().map(|x| axis.dot(x)).collect::<Vec<f64>>());
    let each = (places.len() as f64).sqrt();
    let size = |of: &[Vec<f64>]| of.iter().map(|x| norm(x) / each).fold(0.0, f64::hypot);
    let [wide, high] = [size(&along[..2]), size(&along[2..])];
    if high == 0.0 {
        return [0.0; 2];
    }
    let [a, b, height] = [(0, wide), (1, wide), (2, high)]
        .map(|(k, size)| along[k].iter().map(|x| x / size).collect::<Vec<f64>>());
    let column = |a: &[f64], b: &[f64], by: f64| {
        let values = places.iter().zip(a).zip(b);
        values.map(|((x, a), b)| by * a * b * (wide / x.norm())).collect::<Vec<f64>>()
    };
    let ones = vec![1.0; places.len()];
    let [of_slope, of_height] = DEAR.map(|dear| 1.0 / dear);
    let mut columns = vec![
        column(&a, &ones, of_slope),
        column(&b, &ones, of_slope),
        column(&a, &a, 1.0),
        column(&b, &b, 1.0),
        column(&a, &b, SQRT_2),
        column(&height, &height, of_height),
    ];
    if is_linear {
        columns.extend([&a, &b].map(|a| column(a, &height, SQRT_2 * of_height)));
    }
    let found = least_coefficients(&columns, &column(&height, &ones, 1.0), ON_PLANE);
    [0, 1].map(|k| of_slope * found[k] * high / wide)
}
