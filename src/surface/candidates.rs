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

/// The faces of a side as a search needs them.
pub(super) struct SearchFaces {
    pub(super) tree: Tree,
    /// Unit normals in the middle of the faces.
    pub(super) normals: Vec<Vector3>,
}

impl SearchFaces {
    pub(super) fn new(side: &Side<'_>) -> SearchFaces {
        let faces = || (0..side.count()).map(|face| side.face(face));
        SearchFaces {
            tree: Tree::new(faces().map(|face| bounds(&face)).collect()),
            normals: faces().map(|face| middle_normal(&face)).collect(),
        }
    }
}

/// The master faces, to be asked for those near a slave face.
pub(super) struct Candidates {
    master: SearchFaces,
    /// The search distance.
    pub(super) reach: f64,
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
    pub(super) fn new(master: SearchFaces, reach: f64) -> Candidates {
        Candidates { master, reach, found: Vec::new(), searched: 0, not_opposed: 0 }
    }

    /// Master faces within reach of a slave face whose normals oppose its own.
    pub(super) fn of_face(&mut self, face: &Face<'_>, normal: Vector3) -> &[usize] {
        self.near(bounds(face), normal)
    }

    /// Master faces within reach of a point, opposed to a normal.
    pub(super) fn of_point(&mut self, point: Vector3, normal: Vector3) -> &[usize] {
        self.near(Bounds::of(std::iter::once(point)), normal)
    }

    fn near(&mut self, bounds: Bounds, normal: Vector3) -> &[usize] {
        self.searched += self.master.tree.near(&bounds.grown(self.reach), &mut self.found);
        let before = self.found.len();
        self.found.retain(|&face| self.master.normals[face].dot(&normal) < OPPOSED);
        self.not_opposed += before - self.found.len();
        &self.found
    }
}
