//! Points where a slave face and master faces lie over each other.

use std::ops::Range;

use super::shape::Local;

/// Points with their local coordinates on both faces: the numbers of each kind are beside each other.
#[derive(Debug, Default)]
pub(super) struct Meetings {
    pub(super) slave: [Vec<f64>; 2],
    pub(super) master: [Vec<f64>; 2],
    /// Areas of the slave face.
    pub(super) weights: Vec<f64>,
}

impl Meetings {
    pub(super) fn count(&self) -> usize {
        self.weights.len()
    }

    /// Local coordinates of a point on both faces.
    pub(super) fn at(&self, point: usize) -> [Local; 2] {
        [&self.slave, &self.master].map(|at| [at[0][point], at[1][point]])
    }

    /// All of them.
    pub(super) fn lists(&mut self) -> [&mut Vec<f64>; 5] {
        let ([s, t], [u, v]) = (self.slave.each_mut(), self.master.each_mut());
        [s, t, u, v, &mut self.weights]
    }

    /// Leaves the first points alone.
    pub(super) fn truncate(&mut self, count: usize) {
        self.lists().into_iter().for_each(|list| list.truncate(count));
    }

    /// Moves points to an earlier place.
    pub(super) fn move_to(&mut self, place: usize, points: Range<usize>) {
        self.lists().into_iter().for_each(|list| list.copy_within(points.clone(), place));
    }
}
