//! A plane of symmetry of a half or quarter model.

use crate::linalg::vector3::{self, Vector3};

/// A plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryPlane {
    /// The direction across it, of any length.
    pub normal: [f64; 3],
    /// Where it stands along that direction, from the origin; length.
    pub at: f64,
}

impl SymmetryPlane {
    /// The plane across an axis, 0, 1 or 2.
    ///
    /// # Panics
    /// If there is no such axis.
    pub fn across(axis: usize, at: f64) -> SymmetryPlane {
        SymmetryPlane { normal: vector3::axis(axis).into(), at }
    }

    /// The height of a point above it.
    pub(super) fn height(&self, normal: &Vector3, x: Vector3, scale: f64) -> f64 {
        normal.dot(&x) - scale * self.at
    }
}
