//! Which faces are near another one: a tree of boxes, each with two walls.
//!
//! Each branch halves its faces at the median of their middles along the axis that these differ along most, when a question
//! comes to it first: all questions cost `n log n`, and few of them little more than the boxes. Boxes along the axes
//! say little of slivers and needles: all that lean, or that meet in a point, have boxes over each other. So a branch
//! has two walls besides, along edges of its own faces, that it does not reach beyond.

use super::face::Face;
use super::mesh::Side;
use super::shape::{BEYOND, MANY_FACES};
use super::sweep::{Bounds, Hull, Sweep, Wall};
use crate::error::Error;
use crate::linalg::vector3::Vector3;

/// Most faces of a leaf, and number of those whose edges walls may follow.
const LEAF: usize = 4;

/// The second wall of a branch looks another way than the first: the cosine between them is below this.
const OTHER_WAY: f64 = 0.5;

#[derive(Debug)]
struct Branch {
    bounds: Bounds,
    /// Range in `order`.
    faces: std::ops::Range<usize>,
    /// The content behind its box; `None`: no question has come to it.
    inside: Option<Inside>,
}

#[derive(Clone, Copy, Debug)]
struct Inside {
    walls: [Wall; 2],
    /// The two halves; `None`: a leaf.
    halves: Option<[usize; 2]>,
}

/// The faces of a side.
pub(super) struct Tree<'a> {
    pub(super) side: &'a Side<'a>,
    /// Unit normals in the middle of the faces.
    pub(super) normals: Vec<Vector3>,
    boxes: Vec<Bounds>,
    order: Vec<usize>,
    branches: Vec<Branch>,
    /// In some nodes many faces meet: all touch the line over which one moves, and walls along it tell them from each other.
    has_hubs: bool,
}

impl<'a> Tree<'a> {
    /// # Errors
    /// What stops the pairing.
    pub(super) fn new(side: &'a Side<'a>) -> Result<Tree<'a>, Error> {
        let count = side.count();
        let (mut normals, mut boxes) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for face in side.each_face() {
            let (_, face) = face?;
            normals.push(face.middle_normal());
            boxes.push(Hull::of(&face).bounds());
        }
        let mut faces = vec![0; side.coordinates.len() / side.dim];
        side.faces.nodes.iter().for_each(|&node| faces[node] += 1);
        let has_hubs = faces.iter().any(|&faces| faces > MANY_FACES);
        let (order, branches) = ((0..count).collect(), Vec::new());
        let mut tree = Tree { side, normals, boxes, order, branches, has_hubs };
        if count > 0 {
            tree.grow(0..count);
        }
        Ok(tree)
    }

    /// The box of all faces; `None` if there are none.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        self.branches.first().map(|branch| branch.bounds)
    }

    /// Adds the branch of a range, and returns its place.
    fn grow(&mut self, faces: std::ops::Range<usize>) -> usize {
        let boxes = self.order[faces.clone()].iter().map(|&face| self.boxes[face]);
        let bounds = boxes.reduce(|a, b| a.with(&b)).expect("not empty");
        self.branches.push(Branch { bounds, faces, inside: None });
        self.branches.len() - 1
    }

    /// Looks behind the box of a branch for the first time.
    fn open(&mut self, place: usize) -> Inside {
        let Branch { bounds, faces, .. } = &self.branches[place];
        let (faces, across) = (faces.clone(), bounds.diagonal());
        let is_deep = self.are_deep(&self.order[faces.clone()], across);
        let mut walls =
            if is_deep { self.walls(&self.order[faces.clone()]) } else { [Wall::default(); 2] };
        if self.has_hubs && is_deep {
            walls.iter_mut().for_each(|wall| wall.tilts = [-1.0 / BEYOND, 1.0 / BEYOND]);
            for &at in &self.order[faces.clone()] {
                let face = self.side.face(at);
                walls.iter_mut().for_each(|wall| wall.hold(Hull::of(&face)));
            }
        }
        let halves = (faces.len() > LEAF).then(|| {
            let boxes = &self.boxes;
            let part = &mut self.order[faces.clone()];
            let middle = |face: usize| 0.5 * (boxes[face].low + boxes[face].high);
            let middles = Bounds::of(part.iter().map(|&face| middle(face)));
            let axis = (middles.high - middles.low).imax();
            let half = part.len() / 2;
            let along = |face: usize| boxes[face].low[axis] + boxes[face].high[axis];
            part.select_nth_unstable_by(half, |&a, &b| along(a).total_cmp(&along(b)));
            let middle = faces.start + half;
            [faces.start..middle, middle..faces.end].map(|half| self.grow(half))
        });
        let inside = Inside { walls, halves };
        self.branches[place].inside = Some(inside);
        inside
    }

    /// True if boxes of faces lie over each other more often than a leaf has faces, in the mean over the box of all, which is so far
    /// `across`: those of needles that lean do, and of layers.
    fn are_deep(&self, faces: &[usize], across: f64) -> bool {
        let areas = faces.iter().map(|&at| self.boxes[at].diagonal().powi(2));
        areas.sum::<f64>() > LEAF as f64 * across * across
    }

    /// The two walls of faces: of the edges of some of them, whose lengths are their sizes, that beyond which these reach least,
    /// or the like edge of the face which stands out furthest; none where faces reach further than the edge is long.
    fn walls(&self, faces: &[usize]) -> [Wall; 2] {
        let some = faces.iter().step_by(faces.len().div_ceil(LEAF));
        let some: Vec<Face<'_>> = some.map(|&at| self.side.face(at)).collect();
        let hulls: Vec<Hull<'_>> = some.iter().map(Hull::of).collect();
        let of_some = some.iter().flat_map(edges).map(|edge| {
            let heights = hulls.iter().map(|hull| hull.most(&edge.along));
            (worth(&edge, heights.fold(edge.most, f64::max)), edge)
        });
        let of_some: Vec<(f64, Wall)> = of_some.collect();
        let best = |other: Vector3| {
            let looks_away = |wall: &Wall| {
                wall.along.dot(&other) <= OTHER_WAY * wall.along.norm() * other.norm()
            };
            let away = of_some.iter().filter(|(_, edge)| looks_away(edge));
            let first = away.max_by(|a, b| a.0.total_cmp(&b.0))?.1;
            let (left, wall, furthest) = self.hold(first, faces);
            let outermost = furthest.iter().flat_map(edges).filter(looks_away);
            let cos = |wall: &Wall| wall.along.dot(&first.along) / wall.along.norm();
            let like = outermost.max_by(|a, b| cos(a).total_cmp(&cos(b)));
            let (left, wall) = match like.map(|edge| self.hold(edge, faces)) {
                Some((more, wall, _)) if more > left => (more, wall),
                _ => (left, wall),
            };
            (left > 0.0).then_some(wall)
        };
        let first = best(Vector3::zeros()).unwrap_or_default();
        [first, best(first.along).unwrap_or_default()]
    }

    /// Moves the wall of an edge out until it holds faces: its worth, and the face that stands out furthest.
    fn hold(&self, edge: Wall, faces: &[usize]) -> (f64, Wall, Option<Face<'_>>) {
        let (mut most, mut furthest) = (edge.most, None);
        for &at in faces {
            if self.boxes[at].most(&edge.along) > most {
                let face = self.side.face(at);
                let reaches = Hull::of(&face).most(&edge.along);
                if reaches > most {
                    (most, furthest) = (reaches, Some(face));
                }
            }
        }
        (worth(&edge, most), Wall { most, ..edge }, furthest)
    }

    /// Collects the faces that a sweep may meet, in ascending order, and returns how many boxes
    /// were looked at.
    pub(super) fn near(&mut self, sweep: &Sweep<'_>, found: &mut Vec<usize>) -> usize {
        found.clear();
        let looked = if self.branches.is_empty() { 0 } else { self.collect(0, sweep, found) };
        found.sort_unstable();
        looked
    }

    /// Collects the faces of one branch, in any order.
    fn collect(&mut self, place: usize, sweep: &Sweep<'_>, found: &mut Vec<usize>) -> usize {
        let branch = &self.branches[place];
        if !sweep.meets(&branch.bounds) {
            return 1;
        }
        let Inside { walls, halves } = branch.inside.unwrap_or_else(|| self.open(place));
        if !walls.iter().all(|wall| sweep.passes(wall)) {
            return 1;
        }
        let Some(halves) = halves else {
            let faces = &self.order[self.branches[place].faces.clone()];
            found.extend(faces.iter().filter(|&&face| sweep.meets(&self.boxes[face])));
            return 1 + faces.len();
        };
        1 + halves.map(|half| self.collect(half, sweep, found)).iter().sum::<usize>()
    }
}

/// How much longer an edge is than its wall is moved out. A wall is as long as its edge: heights along it are lengths times
/// that.
fn worth(edge: &Wall, most: f64) -> f64 {
    let length = edge.along.norm();
    length - (most - edge.most) / length
}

/// The walls of a face at its edges, as long as these.
fn edges(face: &Face<'_>) -> Vec<Wall> {
    if face.kind.is_line() {
        return Vec::new();
    }
    let normal = face.middle_normal();
    let wall = |[from, to]: [usize; 2]| {
        let edge = face.x[to] - face.x[from];
        let along = edge.cross(&normal);
        // The normal of a sliver leans along its edge by more than rounding.
        let normal = along.cross(&edge) / edge.norm_squared();
        let (most, height) = (along.dot(&face.x[from]), normal.dot(&face.x[from]));
        Wall { along, most, normal, height, ..Wall::default() }
    };
    face.kind.edges().map(wall).filter(|wall| wall.along != Vector3::zeros()).collect()
}
