//! Which master faces may lie opposite a slave face, and how far away; and those beyond the search distance.

use super::face::Face;
use super::mesh::Side;
use super::overlap::{Overlaps, SlaveFace};
use super::pairs::SurfaceReport;
use super::plane::Plane;
use super::shape::BEYOND;
use super::sweep::Sweep;
use super::tree::Tree;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Faces oppose each other if the cosine between their normals is below this: they are inclined by less
/// than 78 degrees, and the projection of one on the other keeps a fifth of its area.
const OPPOSED: f64 = -0.2;

/// Between neighbours whose normals have a cosine below this is an edge of the body: coarse arcs turn by at most 60 degrees from face to
/// face. Hexagons turn by that, which rounding must not divide.
const BEND: f64 = 0.45;

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
    /// Bodies that are thinner than this are shells: their two sides are one surface.
    pub(super) fn of_shells(&self) -> f64 {
        BEYOND * self.overlap
    }

    pub(super) fn holds(&self, distance: f64) -> bool {
        (-self.overlap..=self.open).contains(&distance)
    }
}

impl Tree<'_> {
    /// True if the body of these faces ends between a point of its surface with an outward normal and a depth below it, at
    /// least so far below: a master face that overlaps by that depth is seen through the body, and touches another part of
    /// its surface, if any.
    pub(super) fn end_above(
        &mut self,
        (point, normal): (Vector3, Vector3),
        depth: f64,
        least: f64,
    ) -> bool {
        if depth <= least {
            return false;
        }
        let mut near = Vec::new();
        self.near(&Sweep::of_point(&point, normal, [depth, 0.0]), &mut near);
        let plane = Plane::new(self.side.dim, point, normal);
        near.into_iter().filter(|&at| self.normals[at].dot(&normal) < 0.0).any(|at| {
            let below = plane.meeting(&self.side.face(at));
            // Bodies that are flush end at the same depth.
            below.is_some_and(|(_, height)| (least..(1.0 + BEYOND) * depth).contains(&-height))
        })
    }
}

/// The master faces, to be asked for those near a slave face.
pub(super) struct Candidates<'a> {
    master: Tree<'a>,
    pub(super) reach: Reach,
    /// No face of either side is further away from another one.
    span: f64,
    found: Vec<usize>,
    /// Boxes looked at so far.
    searched: usize,
    /// Faces near whose normals do not oppose.
    not_opposed: usize,
}

impl<'a> Candidates<'a> {
    pub(super) fn new(master: Tree<'a>, reach: Reach, span: f64) -> Candidates<'a> {
        Candidates { master, reach, span, found: Vec::new(), searched: 0, not_opposed: 0 }
    }

    /// True if master faces beside each other are of one surface, and no edge of the body is between them.
    pub(super) fn are_of_one_surface(&self, [a, b]: [usize; 2]) -> bool {
        self.master.normals[a].dot(&self.master.normals[b]) > BEND
    }

    /// Master faces within reach of a slave face whose normals oppose its own.
    pub(super) fn of_face(&mut self, face: &Face<'_>, normal: Vector3) -> &[usize] {
        self.near(&Sweep::of_face(face, normal, self.ways()), normal)
    }

    /// Master faces within reach of a point, opposed to a normal.
    pub(super) fn of_point(&mut self, point: Vector3, normal: Vector3) -> &[usize] {
        self.near(&Sweep::of_point(&point, normal, self.ways()), normal)
    }

    /// Master faces within reach of a point whose normals look the way of a normal.
    pub(super) fn looking_along(&mut self, point: Vector3, normal: Vector3) -> &[usize] {
        self.searched +=
            self.master.near(&Sweep::of_point(&point, normal, self.ways()), &mut self.found);
        self.found.retain(|&face| self.master.normals[face].dot(&normal) > 0.0);
        &self.found
    }

    /// How far back and forward faces are looked for.
    fn ways(&self) -> [f64; 2] {
        [self.reach.overlap, self.reach.open].map(|reach| reach.min(self.span))
    }

    fn near(&mut self, sweep: &Sweep<'_>, normal: Vector3) -> &[usize] {
        self.searched += self.master.near(sweep, &mut self.found);
        let before = self.found.len();
        self.found.retain(|&face| self.master.normals[face].dot(&normal) < OPPOSED);
        self.not_opposed += before - self.found.len();
        &self.found
    }

    /// Tells the report how far was looked, and adds those of its uncovered faces, with the distance of the nearest master, negative where they overlap it:
    /// where they are inside of a body, and no master face stands before it that looks their way, as that body's other side.
    ///
    /// # Errors
    /// What stops the pairing.
    pub(super) fn look_beyond(
        mut self,
        [slave, master]: [&Side<'_>; 2],
        report: &mut SurfaceReport,
    ) -> Result<(), Error> {
        (report.boxes_searched, report.not_opposed) = (self.searched, self.not_opposed);
        let reach = self.reach;
        (report.search_distance, report.overlap_distance) = (reach.open, reach.overlap);
        (self.reach.overlap, self.reach.open) =
            (f64::max(reach.overlap, self.span), f64::max(reach.open, self.span));
        let mut overlaps = Overlaps::default();
        for &at in &report.uncovered_faces {
            slave.progress.goes_on()?;
            let face = slave.face(at);
            let normal = face.middle_normal();
            let in_plane = SlaveFace::new(&face, normal, 0);
            let mut distances = |masters: &[usize]| {
                let mut found = Vec::new();
                for &other in masters {
                    let part = in_plane.overlap(&master.face(other), |_| true, &mut overlaps);
                    overlaps.points.truncate(0);
                    let part = part.unwrap_or_default();
                    found.extend((part.share > 0.0).then_some(part.distance));
                }
                found
            };
            let opposite = distances(self.of_face(&face, normal));
            let ahead = opposite.iter().copied().filter(|away| *away > reach.open);
            let behind = opposite.iter().copied().filter(|away| *away < -reach.overlap);
            let nearest = ahead.reduce(f64::min).or_else(|| {
                let deep = behind.reduce(f64::max)?;
                let looking_along = distances(self.of_face(&face, -normal));
                let is_between = |away: &f64| (deep..0.0).contains(away);
                (!looking_along.iter().any(is_between)).then_some(deep)
            });
            report.beyond.extend(nearest.map(|nearest| (at, nearest)));
        }
        Ok(())
    }
}
