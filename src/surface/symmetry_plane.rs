//! A plane of symmetry of a half or quarter model.

use crate::error::index;
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

    /// Its place for a message.
    pub(super) fn name(&self) -> String {
        let [x, y, z] = self.normal;
        let axis = (0..3).find(|&axis| self.normal == SymmetryPlane::across(axis, self.at).normal);
        let across =
            axis.map_or_else(|| format!("{x}, {y}, {z}"), |axis| format!("axis {}", index(axis)));
        format!("across {across} at {}", self.at)
    }

    /// The height of a point above it.
    pub(super) fn height(&self, normal: &Vector3, x: Vector3, scale: f64) -> f64 {
        normal.dot(&x) - scale * self.at
    }
}
