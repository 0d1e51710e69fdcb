//! Which faces are near another one: a tree of boxes, each with two walls.
//!
//! Each branch halves its faces at the median of their middles along the axis that these differ along most, so
//! building costs `n log n`, and a question costs the branches on the way to its answer. Boxes along the axes
//! say little of slivers and needles: all that lean, or that meet in a point, have boxes over each other. So a branch
//! has two walls besides, lines of its own faces' edges that it does not reach beyond.

use super::face::Face;
use super::mesh::Side;
use super::sweep::{Bounds, Hull, Sweep, Wall};
use super::watch::Watch;
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Most faces of a leaf.
const LEAF: usize = 4;

/// The second wall of a branch looks another way than the first: the cosine between them is below this.
const OTHER_WAY: f64 = 0.5;

#[derive(Debug)]
struct Branch {
    bounds: Bounds,
    walls: [Wall; 2],
    /// Range in `order`.
    faces: std::ops::Range<usize>,
    /// The two halves; `None`: a leaf.
    halves: Option<[usize; 2]>,
}

/// The faces of a side.
#[derive(Debug)]
pub(super) struct Tree<'a> {
    side: &'a Side<'a>,
    boxes: Vec<Bounds>,
    order: Vec<usize>,
    branches: Vec<Branch>,
}

impl<'a> Tree<'a> {
    /// # Errors
    /// What ends the watch.
    pub(super) fn new(side: &'a Side<'a>, watch: &mut Watch<'_, '_>) -> Result<Tree<'a>, Error> {
        let mut boxes: Vec<Bounds> = Vec::with_capacity(side.count());
        for at in 0..side.count() {
            watch.goes_on()?;
            boxes.push(Hull::of(&side.face(at)).bounds());
        }
        let order = (0..boxes.len()).collect();
        let mut tree = Tree { side, boxes, order, branches: Vec::new() };
        if !tree.boxes.is_empty() {
            tree.branch(0..tree.boxes.len(), watch)?;
        }
        Ok(tree)
    }

    /// The box of all faces; `None` if there are none.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        self.branches.first().map(|branch| branch.bounds)
    }

    /// Builds the branch of a range and returns its place.
    fn branch(
        &mut self,
        faces: std::ops::Range<usize>,
        watch: &mut Watch<'_, '_>,
    ) -> Result<usize, Error> {
        watch.goes_on()?;
        let boxes = &self.boxes;
        let part = &mut self.order[faces.clone()];
        let bounds =
            part.iter().map(|&face| boxes[face]).reduce(|a, b| a.with(&b)).expect("not empty");
        let place = self.branches.len();
        let middle = |face: usize| 0.5 * (boxes[face].low + boxes[face].high);
        let middles = Bounds::of(part.iter().map(|&face| middle(face)));
        let axis = (middles.high - middles.low).imax();
        let half = part.len() / 2;
        let split = part.len() > LEAF;
        if split {
            let middle = |face: usize| middle(face)[axis];
            part.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)));
        }
        let walls = Default::default();
        self.branches.push(Branch { bounds, walls, faces: faces.clone(), halves: None });
        let walls = if split {
            let middle = faces.start + half;
            let first = self.branch(faces.start..middle, watch)?;
            let halves = [first, self.branch(middle..faces.end, watch)?];
            self.branches[place].halves = Some(halves);
            halves.iter().flat_map(|&half| self.branches[half].walls).collect()
        } else {
            self.order[faces.clone()].iter().flat_map(|&at| edges(&self.side.face(at))).collect()
        };
        self.branches[place].walls = self.walls(faces, walls, watch)?;
        Ok(place)
    }

    /// The two walls of a branch: of those given, whose lengths are the sizes of their edges, the long ones that the branch
    /// reaches beyond least.
    fn walls(
        &self,
        faces: std::ops::Range<usize>,
        mut given: Vec<Wall>,
        watch: &mut Watch<'_, '_>,
    ) -> Result<[Wall; 2], Error> {
        given.retain(|wall| wall.along != Vector3::zeros());
        let mut worth = vec![0.0; given.len()];
        let before: Vec<f64> = given.iter().map(|wall| wall.most).collect();
        for &at in &self.order[faces] {
            watch.goes_on()?;
            let face = self.side.face(at);
            let hull = Hull::of(&face);
            for wall in &mut given {
                wall.most = wall.most.max(hull.most(&wall.along));
            }
        }
        for ((worth, wall), before) in worth.iter_mut().zip(&given).zip(before) {
            // A wall is as long as its edge: heights along it are lengths times that.
            let length = wall.along.norm();
            *worth = length - (wall.most - before) / length;
        }
        let best = |other: Vector3| {
            let looks_away = |wall: &Wall| {
                wall.along.dot(&other) <= OTHER_WAY * wall.along.norm() * other.norm()
            };
            let found = worth.iter().zip(&given).filter(|(_, wall)| looks_away(wall));
            let found = found.max_by(|a, b| a.0.total_cmp(b.0));
            found.map_or_else(Wall::default, |(_, wall)| *wall)
        };
        let first = best(Vector3::zeros());
        Ok([first, best(first.along)])
    }

    /// Collects the faces that a sweep may meet, in ascending order, and returns how many boxes
    /// were looked at.
    pub(super) fn near(&self, sweep: &Sweep<'_>, found: &mut Vec<usize>) -> usize {
        found.clear();
        let looked = if self.branches.is_empty() { 0 } else { self.collect(0, sweep, found) };
        found.sort_unstable();
        looked
    }

    /// Collects the faces of one branch, in any order.
    fn collect(&self, place: usize, sweep: &Sweep<'_>, found: &mut Vec<usize>) -> usize {
        let branch = &self.branches[place];
        if !sweep.meets(&branch.bounds, &branch.walls) {
            return 1;
        }
        let Some(halves) = branch.halves else {
            let faces = &self.order[branch.faces.clone()];
            let none = Default::default();
            found.extend(faces.iter().filter(|&&face| sweep.meets(&self.boxes[face], &none)));
            return 1 + faces.len();
        };
        1 + halves.map(|half| self.collect(half, sweep, found)).iter().sum::<usize>()
    }
}

/// The walls of a face at its edges, as long as these.
fn edges(face: &Face<'_>) -> Vec<Wall> {
    let corners = face.kind.corners();
    let Some(normal) = face.middle_normal().filter(|_| !face.kind.is_line()) else {
        return Vec::new();
    };
    let wall = |i: usize| {
        let along = (face.x[(i + 1) % corners] - face.x[i]).cross(&normal);
        Wall { along, most: along.dot(&face.x[i]) }
    };
    (0..corners).map(wall).collect()
}
