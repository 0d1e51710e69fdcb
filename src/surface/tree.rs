//! Which faces are near another one: a tree of boxes.
//!
//! Each branch halves its faces at the median of their middles along the longest side of its box, so
//! building costs `n log n`, and a question costs the boxes on the way to its answer. (A hundred lines
//! serve better than a further package: boxes are all that is asked for, and the visits are counted.)

use crate::linalg::vector3::Vector3;

/// Most faces of a leaf.
const LEAF: usize = 4;

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    low: Vector3,
    high: Vector3,
}

impl Bounds {
    /// The smallest box that holds the points.
    pub(super) fn of(points: impl Iterator<Item = Vector3>) -> Bounds {
        let none = Bounds {
            low: Vector3::repeat(f64::INFINITY),
            high: Vector3::repeat(f64::NEG_INFINITY),
        };
        points.fold(none, |bounds, point| Bounds {
            low: bounds.low.inf(&point),
            high: bounds.high.sup(&point),
        })
    }

    /// The longest side.
    pub(super) fn size(&self) -> f64 {
        (self.high - self.low).amax()
    }

    /// The box with a margin on all sides.
    pub(super) fn grown(&self, margin: f64) -> Bounds {
        let margin = Vector3::repeat(margin);
        Bounds { low: self.low - margin, high: self.high + margin }
    }

    fn with(&self, other: &Bounds) -> Bounds {
        Bounds { low: self.low.inf(&other.low), high: self.high.sup(&other.high) }
    }

    fn meets(&self, other: &Bounds) -> bool {
        (0..3).all(|c| self.low[c] <= other.high[c] && other.low[c] <= self.high[c])
    }
}

#[derive(Debug)]
struct Branch {
    bounds: Bounds,
    /// Range in `order`.
    faces: std::ops::Range<usize>,
    /// The two halves; `None`: a leaf.
    halves: Option<[usize; 2]>,
}

/// The boxes of faces.
#[derive(Debug)]
pub(super) struct Tree {
    boxes: Vec<Bounds>,
    order: Vec<usize>,
    branches: Vec<Branch>,
}

impl Tree {
    pub(super) fn new(boxes: Vec<Bounds>) -> Tree {
        let order = (0..boxes.len()).collect();
        let mut tree = Tree { boxes, order, branches: Vec::new() };
        if !tree.boxes.is_empty() {
            tree.branch(0..tree.boxes.len());
        }
        tree
    }

    /// Builds the branch of a range and returns its place.
    fn branch(&mut self, faces: std::ops::Range<usize>) -> usize {
        let boxes = &self.boxes;
        let part = &mut self.order[faces.clone()];
        let bounds =
            part.iter().map(|&face| boxes[face]).reduce(|a, b| a.with(&b)).expect("not empty");
        let place = self.branches.len();
        let axis = (bounds.high - bounds.low).imax();
        let half = part.len() / 2;
        let split = part.len() > LEAF;
        if split {
            let middle = |face: usize| boxes[face].low[axis] + boxes[face].high[axis];
            part.select_nth_unstable_by(half, |&a, &b| middle(a).total_cmp(&middle(b)));
        }
        self.branches.push(Branch { bounds, faces: faces.clone(), halves: None });
        if split {
            let middle = faces.start + half;
            let halves = [self.branch(faces.start..middle), self.branch(middle..faces.end)];
            self.branches[place].halves = Some(halves);
        }
        place
    }

    /// Collects the faces whose boxes meet `bounds`, in ascending order, and returns how many boxes
    /// were looked at.
    pub(super) fn near(&self, bounds: &Bounds, found: &mut Vec<usize>) -> usize {
        found.clear();
        let looked = if self.branches.is_empty() { 0 } else { self.collect(0, bounds, found) };
        found.sort_unstable();
        looked
    }

    /// Collects the faces of one branch, in any order.
    fn collect(&self, place: usize, bounds: &Bounds, found: &mut Vec<usize>) -> usize {
        let branch = &self.branches[place];
        if !branch.bounds.meets(bounds) {
            return 1;
        }
        let Some(halves) = branch.halves else {
            let faces = &self.order[branch.faces.clone()];
            found.extend(faces.iter().filter(|&&face| self.boxes[face].meets(bounds)));
            return 1 + faces.len();
        };
        1 + halves.map(|half| self.collect(half, bounds, found)).iter().sum::<usize>()
    }
}
