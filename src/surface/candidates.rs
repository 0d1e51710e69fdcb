//! Which master faces may lie opposite a slave face, and how far away.

use super::face::Face;
use super::mesh::Side;
use super::sweep::Sweep;
use super::tree::Tree;
use super::watch::Watch;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Faces oppose each other if the cosine between their normals is below this: they are inclined by less
/// than 78 degrees, and the projection of one on the other keeps a fifth of its area.
const OPPOSED: f64 = -0.2;

/// Faces look the same way if the cosine between their normals is above this. Of two meshes of one curved surface, and
/// of neighbours on it, normals differ by the angle of a face, say 30 degrees on coarse ones.
pub(super) const SAME_WAY: f64 = 0.7;

/// How far from a slave face a master face may be, along the slave's normal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    /// How deep they overlap at most.
    pub(super) overlap: f64,
    /// The largest distance, if they are apart.
    pub(super) open: f64,
    /// How much further a master face may be than the nearest one over the same slave face.
    pub(super) layer: f64,
}

impl Reach {
    pub(super) fn holds(&self, distance: f64) -> bool {
        (-self.overlap..=self.open).contains(&distance)
    }
}

/// The faces of a side as a search needs them.
pub(super) struct SearchFaces<'a> {
    pub(super) tree: Tree<'a>,
    /// Unit normals in the middle of the faces.
    pub(super) normals: Vec<Vector3>,
}

impl<'a> SearchFaces<'a> {
    /// # Errors
    /// What ends the watch.
    pub(super) fn new(
        side: &'a Side<'a>,
        watch: &mut Watch<'_, '_>,
    ) -> Result<SearchFaces<'a>, Error> {
        let mut normals = Vec::with_capacity(side.count());
        for face in 0..side.count() {
            watch.goes_on()?;
            normals.push(side.face(face).middle_normal());
        }
        Ok(SearchFaces { tree: Tree::new(side), normals })
    }
}

/// The master faces, to be asked for those near a slave face.
pub(super) struct Candidates<'a> {
    master: SearchFaces<'a>,
    pub(super) reach: Reach,
    /// No face of either side is further away from another one.
    pub(super) span: f64,
    found: Vec<usize>,
    /// Boxes looked at so far.
    pub(super) searched: usize,
    /// Faces near whose normals do not oppose.
    pub(super) not_opposed: usize,
}

impl<'a> Candidates<'a> {
    pub(super) fn new(master: SearchFaces<'a>, reach: Reach, span: f64) -> Candidates<'a> {
        Candidates { master, reach, span, found: Vec::new(), searched: 0, not_opposed: 0 }
    }

    /// Master faces within reach of a slave face whose normals oppose its own.
    pub(super) fn of_face(&mut self, face: &Face<'_>, normal: Vector3) -> &[usize] {
        self.near(&Sweep::of_face(face, normal, self.ways()), normal)
    }

    /// Master faces within reach of a point, opposed to a normal.
    pub(super) fn of_point(&mut self, point: Vector3, normal: Vector3) -> &[usize] {
        self.near(&Sweep::of_point(&point, normal, self.ways()), normal)
    }

    /// How far back and forward faces are looked for.
    fn ways(&self) -> [f64; 2] {
        [self.reach.overlap, self.reach.open].map(|reach| reach.min(self.span))
    }

    fn near(&mut self, sweep: &Sweep<'_>, normal: Vector3) -> &[usize] {
        self.searched += self.master.tree.near(sweep, &mut self.found);
        let before = self.found.len();
        self.found.retain(|&face| self.master.normals[face].dot(&normal) < OPPOSED);
        self.not_opposed += before - self.found.len();
        &self.found
    }
}
