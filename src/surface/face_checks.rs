//! Faces that are refused: for their lists, for their shape, and neighbours of which one is turned over.

use std::collections::HashMap;

use super::digits::ON_PLANE;
use super::mesh::Side;
use super::shape::FaceKind;
use crate::error::{Error, entry, index};

/// A face whose area, at one of its nodes, is below this part of the square of its size has none: 1e-10
/// is a corner of a ten-thousandth of a degree, far below what a mesh for computations has.
const LEAST_AREA: f64 = 1e-10;

impl Side<'_> {
    pub(super) fn check_lists(&self) -> Result<(), Error> {
        let (dim, coordinates) = (self.dim, self.coordinates.len());
        if !coordinates.is_multiple_of(dim) {
            let message = format!("there are {coordinates} coordinates, no multiple of dim {dim}");
            return Err(Error::invalid(self.of_coordinates(), message));
        }
        self.check_start()?;
        (0..self.count()).try_for_each(|face| self.check_nodes(face))
    }

    fn check_start(&self) -> Result<(), Error> {
        let (start, nodes) = (self.faces.start, self.faces.nodes.len());
        let descends = start.windows(2).position(|ends| ends[0] > ends[1]);
        let message = match (start, descends) {
            ([], _) => "start is empty, it needs one entry more than faces".into(),
            ([first, ..], _) if *first != 0 => {
                format!("{} is {first}, it must be 0", entry("start", [0]))
            }
            (_, Some(face)) => {
                let (here, next) = (entry("start", [face]), entry("start", [face + 1]));
                format!("{next} is less than {here}, start must not descend")
            }
            ([.., last], None) if *last != nodes => {
                format!("start ends with {last}, there are {nodes} nodes in the list")
            }
            _ => return Ok(()),
        };
        Err(Error::invalid(self.argument, format!("{}: {message}", self.name)))
    }

    fn check_nodes(&self, face: usize) -> Result<(), Error> {
        let nodes = self.nodes(face);
        if FaceKind::of(self.dim, nodes.len()).is_none() {
            let known = if self.dim == 2 { "2 or 3" } else { "3, 4, 6, 8 or 9" };
            let what = format!("has {} nodes, a face has {known}", nodes.len());
            return Err(self.refuse(face, &what));
        }
        let count = self.coordinates.len() / self.dim;
        for (i, &node) in nodes.iter().enumerate() {
            if node >= count {
                let what = format!(
                    "has node {}, the coordinates are those of {count} nodes: check the number from which nodes count",
                    index(node)
                );
                return Err(self.refuse(face, &what));
            }
            if nodes[..i].contains(&node) {
                return Err(self.refuse(face, &format!("has node {} twice", index(node))));
            }
            let place = self.dim * node;
            let coordinates = &self.coordinates[place..place + self.dim];
            if let Some(c) = coordinates.iter().position(|x| !x.is_finite()) {
                let place = entry("coordinates", [place + c]);
                let message = format!(
                    "{place} of node {} in {} face {} is not finite",
                    index(node),
                    self.name,
                    index(face)
                );
                return Err(Error::invalid(self.of_coordinates(), message));
            }
        }
        Ok(())
    }

    /// Refuses a face without area, and one that turns over in itself.
    pub(super) fn check_shape(&self, at: usize) -> Result<(), Error> {
        let face = self.face(at);
        let size = face.size();
        let inner = |&&node: &&usize| self.position(node).x < -ON_PLANE * size;
        if let Some(&node) = face.nodes.iter().find(inner).filter(|_| face.is_ring) {
            let radius = self.coordinates[self.dim * node];
            let what =
                format!("has node {} at the radius {radius}, beyond the axis x = 0", index(node));
            return Err(self.refuse(at, &what));
        }
        let least = LEAST_AREA * if self.dim == 2 { size } else { size * size };
        let middle = face.outward(face.kind.centre());
        // Written so that zero and NaN are refused.
        if !(middle.norm() > least) {
            let has_order = !face.kind.is_line() && !face.kind.is_triangle();
            let order = if has_order { ", or they are not in their order around it" } else { "" };
            let what = format!("has no area: its nodes coincide or stand in one line{order}");
            return Err(self.refuse(at, &what));
        }
        for (i, &place) in face.kind.places().iter().enumerate() {
            let normal = face.outward(place);
            if !(normal.norm() > least && normal.dot(&middle) > 0.0) {
                let what = format!(
                    "is folded at node {}: check the order of its nodes, the number from which \
                     they count, and that corners are convex and mid nodes near the middle of their edges",
                    index(face.nodes[i])
                );
                return Err(self.refuse(at, &what));
            }
        }
        Ok(())
    }

    /// Refuses neighbours that run along their common edge in the same direction, if none runs along it in the other: where
    /// bodies meet in an edge, two do in each.
    pub(super) fn check_orientation(&self) -> Result<(), Error> {
        let mut seen: HashMap<(usize, usize), usize> =
            HashMap::with_capacity(self.faces.nodes.len());
        let mut again = Vec::new();
        for face in 0..self.count() {
            self.progress.goes_on()?;
            for (i, [a, b]) in self.edges(face).enumerate() {
                // On a line the node and its end: 0 if it begins there, 1 if it ends there.
                let [key, opposite] =
                    if self.dim == 2 { [(a, i), (a, 1 - i)] } else { [(a, b), (b, a)] };
                if let Some(other) = seen.insert(key, face) {
                    again.push(([face, other], [a, b], opposite));
                }
            }
        }
        let alone = again.iter().find(|(.., opposite)| !seen.contains_key(opposite));
        let Some(([face, other], [a, b], _)) = alone else { return Ok(()) };
        let where_ = if self.dim == 2 {
            format!("node {}", index(a))
        } else {
            format!("the edge of nodes {} and {}", index(a), index(b))
        };
        let what = format!(
            "and face {} disagree at {where_}: one of them is turned over, or they lie \
             upon each other; turn the order of its nodes, leave it out, or check the number from which nodes count",
            index(other)
        );
        Err(self.refuse(*face, &what))
    }
}
