//! A row while it is summed over the faces at its node.

use super::pairs::Weight;
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::Vector3;

/// `D_j` times the row of a node: `D_j û_j - Σ_k M_jk u_k`.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    /// `D_j`: the area of the node on the covered part.
    pub(super) area: f64,
    /// The area that the node would have on the whole of the faces of which a part is covered.
    pub(super) whole: f64,
    /// Slave nodes with weights whose sum is `D_j`; nodes may repeat.
    pub(super) slaves: Vec<Weight>,
    /// Master nodes likewise.
    pub(super) masters: Vec<Weight>,
    /// The faces' unit normals at the node times its areas on them, of length `D_j` if they agree; zero if
    /// it is not needed.
    pub(super) normal: Vector3,
}

impl Row {
    /// The covered share of the node.
    pub(super) fn cover(&self) -> f64 {
        self.area / self.whole
    }

    /// Adds the row of a neighbour.
    pub(super) fn take_in(&mut self, other: Row) {
        self.area += other.area;
        self.whole += other.whole;
        self.normal += other.normal;
        self.slaves.extend(other.slaves);
        self.masters.extend(other.masters);
    }

    /// The weights of slaves and masters, by node, each set with the sum 1. Weights that are zero but
    /// for rounding are left out: a node that a row does not move shall not be named by it.
    pub(super) fn into_weights(self) -> [Vec<Weight>; 2] {
        [merged(self.slaves, self.area), merged(self.masters, self.area)]
    }
}

/// Sums the weights of each node and divides them.
pub(super) fn merged(mut weights: Vec<Weight>, area: f64) -> Vec<Weight> {
    weights.sort_by_key(|(node, _)| *node);
    let mut sums: Vec<Weight> = Vec::new();
    for (node, weight) in weights {
        match sums.last_mut() {
            Some((last, sum)) if *last == node => *sum += weight,
            _ => sums.push((node, weight)),
        }
    }
    sums.iter_mut().for_each(|(_, weight)| *weight /= area);
    sums.retain(|(_, weight)| weight.abs() > ROUNDING);
    sums
}
