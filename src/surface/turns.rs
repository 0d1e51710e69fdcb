//! Rows that keep rigid turns, as ties ask for.
//!
//! The points `Σ a x_s` and `Σ w x_m` of a pair of facets are apart by `r`, so that a rigid turn `u = θ × x` of both bodies moves
//! `d = Σ a u_s - Σ w u_m` by `θ × r`, and strains what is tied. A row that keeps turns takes the master's own part of that off,
//! `d - ω × r`. `ω` is the turn of the master nodes of the row by least squares: `ω = J⁺ Σ y × u`, `J = Σ (|y|² - y yᵀ)`, `y` from their
//! mean to each. Moments of its forces then balance as forces do, however far the points are apart.

use super::mesh::Side;
use super::pairs::SurfacePair;
use crate::linalg::tolerances::{ROUNDING_OF_SUM, SINGULAR};
use crate::linalg::vector3::{Matrix3, Vector3};

impl SurfacePair {
    /// Makes the row keep rigid turns of the nodes at their places.
    pub(super) fn keep_turns(&mut self, [slave, master]: [&Side<'_>; 2]) {
        let masters = self.masters();
        let apart = slave.point(self.slaves()) - master.point(masters);
        let places: Vec<Vector3> =
            masters.iter().map(|(node, _)| master.point(&[(*node, 1.0)])).collect();
        let size = places.iter().map(Vector3::norm).fold(0.0, f64::max);
        if apart.norm() <= ROUNDING_OF_SUM * size {
            return;
        }
        let mean = places.iter().sum::<Vector3>() / places.len() as f64;
        let from_mean = || places.iter().map(|place| place - mean);
        let inertia: Matrix3 =
            from_mean().map(|y| y.norm_squared() * Matrix3::identity() - y * y.transpose()).sum();
        // Masters on a line tell no turn about it.
        let inverse = inertia.pseudo_inverse(SINGULAR * inertia.trace()).unwrap_or_default();
        let of_turn = apart.cross_matrix() * inverse;
        self.turns = from_mean().map(|y| (of_turn * y.cross_matrix()).into()).collect();
    }
}
