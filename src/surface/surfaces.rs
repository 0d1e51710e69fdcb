//! A surface of a mesh and the other side, as the host hands them over.

use super::exact_shape::Obstacle;

/// Faces as lists of nodes.
#[derive(Clone, Copy, Debug)]
pub struct Faces<'a> {
    /// Start of each face in `nodes`, and the length of `nodes`: one entry more than faces.
    pub start: &'a [usize],
    /// Nodes, counted from 0, face after face: corners first, in order around the face, then mid nodes
    /// (the first one between the first two corners), then the centre. Seen from outside the body the
    /// corners of a face run counterclockwise; in the plane the body lies to the left of a line that
    /// runs from its first node to its second.
    pub nodes: &'a [usize],
}

/// A surface, and what it may touch.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Coordinates of all nodes of the host, `dim` for each node.
    pub coordinates: &'a [f64],
    /// The side whose nodes become slaves: lines with 2 or 3 nodes in the plane; in space triangles
    /// with 3 or 6 nodes and quadrilaterals with 4, 8 or 9, in any mixture.
    pub slave: Faces<'a>,
    /// The other side.
    pub master: Master<'a>,
}

/// The other side, which a surface may touch. A rigid one does not move: rows have slaves alone.
#[derive(Clone, Copy, Debug)]
pub enum Master<'a> {
    /// Faces of the same mesh.
    Faces(Faces<'a>),
    /// A rigid mesh: triangles of a scan or of a drawing, or any other faces. Gaps are those that two deformable surfaces of
    /// the same places have.
    RigidFaces {
        /// Coordinates of its nodes, `dim` for each node.
        coordinates: &'a [f64],
        /// Its faces, in nodes of its own counted from 0; seen from the body that may touch them the corners
        /// run counterclockwise, in the plane the obstacle lies to the left of a line.
        faces: Faces<'a>,
    },
    /// A rigid shape: each slave node against its nearest point.
    RigidShape(Obstacle),
}
