//! Which master faces may lie opposite a slave face.

use super::face::Face;
use super::mesh::Side;
use super::tree::{Bounds, Tree};
use crate::linalg::vector3::Vector3;

/// Faces oppose each other if the cosine between their normals is below this: they are inclined by less
/// than 78 degrees, and the projection of one on the other keeps a fifth of its area.
const OPPOSED: f64 = -0.2;

/// A curved face may bulge out of the box of its nodes by this share of its size: an arc of a quarter
/// circle bulges by 0.1 of its chord, between nodes by less.
const BULGE: f64 = 0.1;

/// The master faces, to be asked for those near a slave face.
pub(super) struct Candidates {
    tree: Tree,
    normals: Vec<Vector3>,
    reach: f64,
    found: Vec<usize>,
    /// Boxes looked at so far.
    pub(super) searched: usize,
    /// Faces near whose normals do not oppose.
    pub(super) not_opposed: usize,
}

/// A box that holds a face.
pub(super) fn bounds(face: &Face<'_>) -> Bounds {
    let bounds = Bounds::of(face.x[..face.kind.nodes()].iter().copied());
    bounds.grown(if face.is_straight() { 0.0 } else { BULGE * bounds.size() })
}

/// Unit normal in the middle of a face, which has one as faces without area are refused.
pub(super) fn middle_normal(face: &Face<'_>) -> Vector3 {
    face.middle_normal().unwrap_or_default()
}

impl Candidates {
    pub(super) fn new(master: &Side<'_>, reach: f64) -> Candidates {
        let faces = || (0..master.count()).map(|face| master.face(face));
        Candidates {
            tree: Tree::new(faces().map(|face| bounds(&face)).collect()),
            normals: faces().map(|face| middle_normal(&face)).collect(),
            reach,
            found: Vec::new(),
            searched: 0,
            not_opposed: 0,
        }
    }

    /// Master faces within reach of a slave face whose normals oppose its own.
    pub(super) fn of_face(&mut self, face: &Face<'_>) -> &[usize] {
        self.near(bounds(face), middle_normal(face))
    }

    /// Master faces within reach of a point, opposed to a normal.
    pub(super) fn of_point(&mut self, point: Vector3, normal: Vector3) -> &[usize] {
        self.near(Bounds::of(std::iter::once(point)), normal)
    }

    fn near(&mut self, bounds: Bounds, normal: Vector3) -> &[usize] {
        self.searched += self.tree.near(&bounds.grown(self.reach), &mut self.found);
        let before = self.found.len();
        self.found.retain(|&face| self.normals[face].dot(&normal) < OPPOSED);
        self.not_opposed += before - self.found.len();
        &self.found
    }
}
