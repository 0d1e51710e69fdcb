//! A side of the pairing, and what is refused: faces for their shape, and neighbours of which one is turned over.

use std::collections::HashMap;

use super::face::Face;
use super::pairs::Weight;
use super::shape::{FaceKind, MOST_NODES};
use super::surfaces::Faces;
use super::sweep::Bounds;
use super::watch::Watch;
use crate::error::{Argument, Error, entry, index};
use crate::linalg::vector3::{Vector3, vector};

/// A node is on a plane if it is nearer than this part of the size of its side: ten times the error of
/// coordinates with seven digits.
pub(super) const ON_PLANE: f64 = 1e-6;

/// A face whose area, at one of its nodes, is below this part of the square of its size has none: 1e-10
/// is a corner of a ten-thousandth of a degree, far below what a mesh for computations has.
const LEAST_AREA: f64 = 1e-10;

/// One of the two sides, checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side<'a> {
    name: &'static str,
    argument: Argument,
    pub(super) dim: usize,
    pub(super) coordinates: &'a [f64],
    pub(super) faces: Faces<'a>,
    /// Number of faces that the host has; others behind them are images of theirs.
    own: usize,
    is_axisymmetric: bool,
    /// Lengths of the host are multiplied by this power of two, so that coordinates are below 1 whatever its unit is.
    pub(super) scale: f64,
}

impl<'a> Side<'a> {
    /// Number of faces.
    pub(super) fn count(&self) -> usize {
        self.faces.start.len() - 1
    }

    /// A face by its place.
    pub(super) fn face(&self, face: usize) -> Face<'a> {
        let nodes = self.nodes(face);
        let mut x = [Vector3::zeros(); MOST_NODES];
        for (x, &node) in x.iter_mut().zip(nodes) {
            *x = self.position(node);
        }
        Face { kind: self.kind(nodes), nodes, x, is_ring: self.is_axisymmetric }
    }

    /// Place of a node, in the unit of the pairing.
    pub(super) fn position(&self, node: usize) -> Vector3 {
        self.scale * vector(&self.coordinates[self.dim * node..self.dim * (node + 1)])
    }

    /// The host's coordinates of all nodes of faces.
    pub(super) fn lengths(&self) -> impl Iterator<Item = f64> {
        let of_node = |&node: &usize| &self.coordinates[self.dim * node..self.dim * (node + 1)];
        self.faces.nodes.iter().flat_map(of_node).copied()
    }

    /// The side with its scale, its shape checked.
    pub(super) fn checked(
        mut self,
        (scale, is_axisymmetric): (f64, bool),
        watch: &mut Watch<'_, '_>,
    ) -> Result<Side<'a>, Error> {
        (self.scale, self.is_axisymmetric) = (scale, is_axisymmetric);
        for face in 0..self.count() {
            watch.goes_on()?;
            self.check_shape(face)?;
        }
        self.check_orientation(watch)?;
        Ok(self)
    }

    /// The nodes of all faces, each once, ascending.
    pub(super) fn all_nodes(&self) -> Vec<usize> {
        let mut nodes = self.faces.nodes.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// Places of nodes that are nearer than this to each other, or to a plane, are the same.
    pub(super) fn nearness(&self) -> f64 {
        let nodes = self.faces.nodes.iter();
        let Bounds { low, high } = Bounds::of(nodes.map(|&node| self.position(node)));
        ON_PLANE * (high - low).amax()
    }

    /// The largest distance of a node from the mean of all of them: half the diagonal of a rectangle, however it is turned.
    pub(super) fn radius(&self) -> f64 {
        let nodes = self.all_nodes();
        let places = || nodes.iter().map(|&node| self.position(node));
        let mean = places().sum::<Vector3>() / nodes.len() as f64;
        places().map(|x| (x - mean).norm()).fold(0.0, f64::max)
    }

    fn nodes(&self, face: usize) -> &'a [usize] {
        &self.faces.nodes[self.faces.start[face]..self.faces.start[face + 1]]
    }

    /// Corners of a face.
    pub(super) fn corners(&self, face: usize) -> &'a [usize] {
        let nodes = self.nodes(face);
        &nodes[..self.kind(nodes).corners()]
    }

    /// The kind of a face with these nodes.
    fn kind(&self, nodes: &[usize]) -> FaceKind {
        FaceKind::of(self.dim, nodes.len()).expect("the kind has been checked")
    }

    pub(super) fn is_slave(&self) -> bool {
        self.argument == Argument::SlaveFaces
    }

    /// `true` of a rigid mesh with nodes of its own.
    pub(super) fn is_rigid(&self) -> bool {
        self.argument == Argument::Obstacle
    }

    /// `true` of a face that is the image of one of the host.
    pub(super) fn is_image(&self, face: usize) -> bool {
        face >= self.own
    }

    /// The number of a face for a message.
    pub(super) fn named(&self, face: usize) -> String {
        if self.is_image(face) {
            return format!("{} of a neighbouring sector", index(face % self.own));
        }
        index(face)
    }

    /// An error about a face.
    pub(super) fn refuse(&self, face: usize, what: &str) -> Error {
        Error::invalid(self.argument, format!("{} face {} {what}", self.name, self.named(face)))
    }

    /// A side whose lists are in order. `argument` is that of its faces.
    pub(super) fn new(
        name: &'static str,
        argument: Argument,
        (dim, coordinates): (usize, &'a [f64]),
        faces: Faces<'a>,
    ) -> Result<Side<'a>, Error> {
        let (own, is_axisymmetric, scale) = (faces.start.len().saturating_sub(1), false, 1.0);
        let side = Side { name, argument, dim, coordinates, faces, own, is_axisymmetric, scale };
        if !coordinates.len().is_multiple_of(dim) {
            let message =
                format!("there are {} coordinates, no multiple of dim {dim}", coordinates.len());
            return Err(Error::invalid(side.of_coordinates(), message));
        }
        side.check_lists()?;
        Ok(side)
    }

    /// Master faces of the same mesh, whose nodes must not be on this side.
    pub(super) fn opposite(&self, faces: Faces<'a>) -> Result<Side<'a>, Error> {
        let (name, argument) = ("master", Argument::MasterFaces);
        let own = faces.start.len().saturating_sub(1);
        let side = Side { name, argument, faces, own, ..*self };
        side.check_lists()?;
        let mut is_own = vec![false; self.coordinates.len() / self.dim];
        self.faces.nodes.iter().for_each(|&node| is_own[node] = true);
        for face in 0..side.count() {
            if let Some(&node) = side.nodes(face).iter().find(|&&node| is_own[node]) {
                let what = format!(
                    "has node {}, which is on the slave side too: give each side nodes of its own, \
                     or leave out the faces around that node on one side",
                    index(node)
                );
                return Err(side.refuse(face, &what));
            }
        }
        Ok(side)
    }

    /// The side with other nodes and faces, behind its own those of images.
    pub(super) fn with(self, coordinates: &'a [f64], faces: Faces<'a>) -> Side<'a> {
        Side { coordinates, faces, ..self }
    }

    /// The argument that the coordinates are part of.
    fn of_coordinates(&self) -> Argument {
        match self.argument {
            Argument::Obstacle => Argument::Obstacle,
            _ => Argument::Coordinates,
        }
    }

    /// Sum of places of nodes by their weights.
    pub(super) fn point(&self, weights: &[Weight]) -> Vector3 {
        weights.iter().map(|&(node, weight)| weight * self.position(node)).sum()
    }

    fn check_lists(&self) -> Result<(), Error> {
        self.check_start()?;
        (0..self.count()).try_for_each(|face| self.check_nodes(face))
    }

    fn check_start(&self) -> Result<(), Error> {
        let refuse = |message: String| {
            Err(Error::invalid(self.argument, format!("{}: {message}", self.name)))
        };
        let (start, nodes) = (self.faces.start, self.faces.nodes.len());
        match start {
            [] => return refuse("start is empty, it needs one entry more than faces".into()),
            [first, ..] if *first != 0 => {
                return refuse(format!("{} is {first}, it must be 0", entry("start", [0])));
            }
            _ => {}
        }
        if let Some(face) = start.windows(2).position(|ends| ends[0] > ends[1]) {
            let (here, next) = (entry("start", [face]), entry("start", [face + 1]));
            return refuse(format!("{next} is less than {here}, start must not descend"));
        }
        if start[start.len() - 1] != nodes {
            let last = start[start.len() - 1];
            return refuse(format!("start ends with {last}, there are {nodes} nodes in the list"));
        }
        Ok(())
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
                let what =
                    format!("has node {}, the coordinates are those of {count} nodes", index(node));
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
    fn check_shape(&self, at: usize) -> Result<(), Error> {
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
            return Err(self.refuse(at, "has no area: its nodes coincide or stand in one line"));
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
    fn check_orientation(&self, watch: &mut Watch<'_, '_>) -> Result<(), Error> {
        let mut seen: HashMap<(usize, usize), usize> =
            HashMap::with_capacity(self.faces.nodes.len());
        let mut again = Vec::new();
        for face in 0..self.count() {
            watch.goes_on()?;
            let corners = self.corners(face);
            for (i, &a) in corners.iter().enumerate() {
                let b = corners[(i + 1) % corners.len()];
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
             upon each other; turn the order of its nodes, or leave it out",
            index(other)
        );
        Err(self.refuse(*face, &what))
    }
}
