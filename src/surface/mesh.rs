//! A side of the pairing.

use super::digits::{ON_PLANE, left_open};
use super::face::Face;
use super::motion::Motion;
use super::pairing_progress::PairingProgress;
use super::pairs::Weight;
use super::settings::SurfaceSettings;
use super::shape::{FaceKind, Values, padded};
use super::surfaces::Faces;
use super::sweep::Bounds;
use crate::error::{Argument, Error, index};
use crate::linalg::vector3::{Vector3, vector};

/// One of the two sides, checked.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) name: &'static str,
    pub(super) argument: Argument,
    pub(super) dim: usize,
    pub(super) coordinates: &'a [f64],
    pub(super) faces: Faces<'a>,
    /// The last faces are images of these, by these motions.
    pub(super) origins: &'a [(Motion, usize)],
    is_axisymmetric: bool,
    /// Lengths of the host are multiplied by this power of two, so that coordinates are below 1 whatever its unit is.
    pub(super) scale: f64,
    /// How far apart, in the host's unit, two nodes may be that are one in a sector; without one zero.
    pub(super) left_open: f64,
    /// To be asked often if the pairing goes on.
    pub(super) progress: &'a PairingProgress<'a>,
}

impl<'a> Side<'a> {
    /// Number of faces.
    pub(super) fn count(&self) -> usize {
        self.faces.start.len() - 1
    }

    /// A face by its place.
    pub(super) fn face(&self, face: usize) -> Face<'a> {
        let nodes = self.nodes(face);
        let x = padded(nodes.iter().map(|&node| self.position(node)));
        Face { kind: self.kind(nodes), nodes, x, is_ring: self.is_axisymmetric }
    }

    /// The faces with their places; before each it is asked if the pairing goes on.
    pub(super) fn each_face(&self) -> impl Iterator<Item = Result<(usize, Face<'a>), Error>> {
        (0..self.count()).map(|at| self.progress.goes_on().map(|()| (at, self.face(at))))
    }

    /// Place of a node, in the unit of the pairing.
    pub(super) fn position(&self, node: usize) -> Vector3 {
        self.scale * vector(&self.coordinates[self.dim * node..self.dim * (node + 1)])
    }

    /// Place of a node, in the host's unit.
    pub(super) fn of_host(&self, node: usize) -> Vector3 {
        self.position(node) / self.scale
    }

    /// The host's coordinates of all nodes of faces.
    pub(super) fn lengths(&self) -> impl Iterator<Item = f64> {
        let of_node = |&node: &usize| &self.coordinates[self.dim * node..self.dim * (node + 1)];
        self.faces.nodes.iter().flat_map(of_node).copied()
    }

    /// The side with its scale, its shape checked.
    pub(super) fn checked(
        mut self,
        scale: f64,
        settings: &SurfaceSettings,
    ) -> Result<Side<'a>, Error> {
        (self.scale, self.is_axisymmetric) = (scale, settings.axisymmetric);
        if settings.sector.is_some() {
            self.left_open = left_open(self.dim, self.coordinates);
        }
        for face in 0..self.count() {
            self.progress.goes_on()?;
            self.check_shape(face)?;
        }
        self.check_orientation()?;
        Ok(self)
    }

    /// The nodes of all faces, each once, ascending.
    pub(super) fn all_nodes(&self) -> Vec<usize> {
        let mut nodes = self.faces.nodes.to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// A box around all nodes.
    pub(super) fn bounds(&self) -> Bounds {
        Bounds::of(self.faces.nodes.iter().map(|&node| self.position(node)))
    }

    /// The size of its largest face.
    pub(super) fn largest_face(&self) -> f64 {
        (0..self.count()).map(|face| self.face(face).size()).fold(0.0, f64::max)
    }

    /// Places of nodes that are nearer than this to each other, or to a plane, are the same.
    pub(super) fn nearness(&self) -> f64 {
        let Bounds { low, high } = self.bounds();
        ON_PLANE * (high - low).amax()
    }

    /// The mean of the places of its nodes.
    pub(super) fn mean(&self) -> Vector3 {
        let nodes = self.all_nodes();
        nodes.iter().map(|&node| self.position(node)).sum::<Vector3>() / nodes.len() as f64
    }

    /// The largest distance of a node from a point: from the mean half the diagonal of a rectangle, however it is turned.
    pub(super) fn radius(&self, from: Vector3) -> f64 {
        let nodes = self.faces.nodes.iter();
        nodes.map(|&node| (self.position(node) - from).norm()).fold(0.0, f64::max)
    }

    pub(super) fn nodes(&self, face: usize) -> &'a [usize] {
        &self.faces.nodes[self.faces.start[face]..self.faces.start[face + 1]]
    }

    /// Corners of a face.
    pub(super) fn corners(&self, face: usize) -> &'a [usize] {
        let nodes = self.nodes(face);
        &nodes[..self.kind(nodes).corners()]
    }

    /// The edges of a face by their nodes, in order around it; of a line it itself, to and fro.
    pub(super) fn edges(&self, face: usize) -> impl Iterator<Item = [usize; 2]> {
        let corners = self.corners(face);
        let next = corners.iter().cycle().skip(1);
        corners.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    /// The kind of a face with these nodes.
    pub(super) fn kind(&self, nodes: &[usize]) -> FaceKind {
        FaceKind::of(self.dim, nodes.len()).expect("the kind has been checked")
    }

    pub(super) fn is_slave(&self) -> bool {
        self.argument == Argument::SlaveFaces
    }

    /// `true` of a rigid mesh with nodes of its own.
    pub(super) fn is_rigid(&self) -> bool {
        self.argument == Argument::Obstacle
    }

    /// The motion and the face of the host that a face is the image of, if it is one.
    pub(super) fn origin(&self, face: usize) -> Option<(Motion, usize)> {
        let image = (face + self.origins.len()).checked_sub(self.count());
        image.map(|image| self.origins[image])
    }

    /// `true` of a face that is the image of one of the host.
    pub(super) fn is_image(&self, face: usize) -> bool {
        self.origin(face).is_some()
    }

    /// The area of a face with such integrals of shape functions, if the host has it.
    pub(super) fn own_area(&self, face: usize, integrals: Values) -> f64 {
        if self.is_image(face) { 0.0 } else { integrals.iter().sum() }
    }

    /// The number of a face for a message.
    pub(super) fn named(&self, face: usize) -> String {
        match self.origin(face) {
            Some((_, origin)) => format!("{} (turned, mirrored or shifted)", index(origin)),
            None => index(face),
        }
    }

    /// An error about a face.
    pub(super) fn refuse(&self, face: usize, what: &str) -> Error {
        Error::invalid(self.argument, format!("{} face {} {what}", self.name, self.named(face)))
    }

    /// A side of lists that are in order, or that [`Side::check_lists`] checks next. `argument` is that of its faces.
    pub(super) fn new(
        name: &'static str,
        argument: Argument,
        (dim, coordinates): (usize, &'a [f64]),
        faces: Faces<'a>,
        progress: &'a PairingProgress<'a>,
    ) -> Side<'a> {
        Side {
            name,
            argument,
            dim,
            coordinates,
            faces,
            origins: &[],
            is_axisymmetric: false,
            scale: 1.0,
            left_open: 0.0,
            progress,
        }
    }

    /// These faces with other coordinates of their nodes.
    pub(super) fn moved(&self, coordinates: &'a [f64]) -> Side<'a> {
        Side { coordinates, ..*self }
    }

    /// Master faces of the same mesh, whose nodes must not be on this side.
    pub(super) fn opposite(&self, faces: Faces<'a>) -> Result<Side<'a>, Error> {
        let side = Side { name: "master", argument: Argument::MasterFaces, faces, ..*self };
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

    /// The side with other nodes and faces, behind its own the images of some of these.
    pub(super) fn with(
        self,
        coordinates: &'a [f64],
        faces: Faces<'a>,
        origins: &'a [(Motion, usize)],
    ) -> Side<'a> {
        Side { coordinates, faces, origins, ..self }
    }

    /// The argument that the coordinates are part of.
    pub(super) fn of_coordinates(&self) -> Argument {
        match self.argument {
            Argument::Obstacle => Argument::Obstacle,
            _ => Argument::Coordinates,
        }
    }

    /// Sum of places of nodes by their weights.
    pub(super) fn point(&self, weights: &[Weight]) -> Vector3 {
        weights.iter().map(|&(node, weight)| weight * self.position(node)).sum()
    }
}
