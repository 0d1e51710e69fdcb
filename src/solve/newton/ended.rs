//! How Newton's method on dense equations ended.

use crate::law::Vector;
use crate::solve::pieces::Point;
use crate::solve::result::{Candidate, Effort, Ending};

/// How Newton's method ended, and where.
pub struct Ended {
    /// Displacements, the force that they need, and their coordinates, of the best point.
    pub d: Vec<f64>,
    pub force: Vec<f64>,
    pub y: Vec<Vector>,
    /// `Done` if `eta` is below the tolerance or at its rounding.
    pub ending: Ending,
    /// Linear systems that were factorised.
    pub systems: u64,
    /// Sign of the determinant of the last system, 0 if there was none.
    pub orientation: i8,
}

impl Ended {
    /// An end at a point, without a system.
    pub fn at(point: Point, ending: Ending) -> Self {
        let Point { y, d, force, .. } = point;
        Ended { d, force, y, ending, systems: 0, orientation: 0 }
    }

    /// The candidate of equations that are a whole problem's.
    pub fn into_candidate(self) -> Candidate {
        let effort = Effort::of_systems(self.systems);
        let mut candidate = Candidate::new(self.d, self.force, self.ending, effort);
        candidate.orientation = self.orientation;
        candidate
    }
}
