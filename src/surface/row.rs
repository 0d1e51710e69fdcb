//! A row while it is summed over the faces at its node.

use std::collections::BTreeMap;

use super::control::Basis;
use super::pairs::Weight;
use super::settings::SurfaceSettings;
use super::shape::{MOST_NODES, Values};
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::Vector3;

/// The bit of a node that is a master: it sorts masters behind all slaves.
const MASTER: usize = 1 << (usize::BITS - 1);

/// `D_j` times the row of a node: `D_j û_j - Σ_k M_jk u_k`.
#[derive(Clone, Debug, Default)]
pub(super) struct Row {
    /// `D_j`: the area of the node on the covered part.
    pub(super) area: f64,
    /// The area that the node would have on the whole of all slave faces around it that look the same way.
    pub(super) whole: f64,
    /// Slave nodes, and master nodes with the bit [`MASTER`], with weights of which those of either side have the sum
    /// `D_j`; nodes may repeat.
    weights: Vec<Weight>,
    /// Unit normals times their areas, of the faces at the node or its averaged one: of length `D_j` if they agree.
    pub(super) normal: Vector3,
    /// `D_j` times the gap between true shapes; 0 if the sides are their faces.
    pub(super) gap: f64,
    /// `true` for a corner of a face with mid nodes.
    pub(super) is_large: bool,
    /// `D_j` times the middle of its function over the covered part.
    middle: Vector3,
    /// The part of `D_j` that supports hold on both sides: it changes no gap.
    pub(super) held: f64,
}

impl Row {
    /// The covered share of the node.
    pub(super) fn cover(&self) -> f64 {
        self.area / self.whole
    }

    /// Where the pressure of the row is that of a field which is linear: `F_j = ∫_C p N̂_j = D_j p(middle)`. The node itself may
    /// stand off the covered part by an element.
    pub(super) fn middle(&self) -> Vector3 {
        self.middle / self.area
    }

    /// Adds a share of the row of a neighbour, a part of which moves.
    pub(super) fn take_in(&mut self, (other, moving): (&Row, f64), share: f64) {
        let part = |(node, weight): &Weight| (*node, share * weight);
        self.area += share * other.area;
        self.held += share * other.area * (1.0 - moving);
        self.normal += share * other.normal;
        self.gap += share * other.gap;
        self.weights.extend(other.weights.iter().map(part));
    }

    /// The slave nodes with their weights.
    pub(super) fn slaves(&self) -> impl Iterator<Item = Weight> {
        self.weights.iter().copied().filter(|(node, _)| node & MASTER == 0)
    }

    /// The part of the row that supports do not hold along its normal: all of it if its node moves, and otherwise the weights of the
    /// masters that do. `None`: it names no node that moves.
    pub(super) fn moving(&self, node: usize, settings: &SurfaceSettings) -> Option<f64> {
        let is_held = |node: usize| settings.is_supported(node, self.normal);
        if !is_held(node) {
            return Some(1.0);
        }
        let is_named = |weight: f64| weight.abs() > ROUNDING * self.area;
        let masters = self.weights.iter().filter(|(node, w)| node & MASTER != 0 && is_named(*w));
        let (held, free): (Vec<Weight>, Vec<Weight>) =
            masters.partition(|(node, _)| is_held(node & !MASTER));
        let part = |free: Vec<Weight>| free.iter().map(|(_, weight)| weight / self.area).sum();
        if held.is_empty() {
            Some(1.0)
        } else {
            Some(free).filter(|free| !free.is_empty()).map(part)
        }
    }

    /// Adds master nodes.
    pub(super) fn add_masters(&mut self, masters: impl Iterator<Item = Weight>) {
        self.weights.extend(masters.map(|(node, weight)| (node | MASTER, weight)));
    }

    /// The nodes, slaves, then masters, and the number of slaves; the weights of either side have the sum 1. Weights that are
    /// zero but for rounding are left out: a node that a row does not move shall not be named by it.
    pub(super) fn into_nodes(self) -> (Vec<Weight>, usize) {
        let mut weights = merged(self.weights, self.area);
        let slaves = weights.partition_point(|(node, _)| node & MASTER == 0);
        weights[slaves..].iter_mut().for_each(|(node, _)| *node &= !MASTER);
        (weights, slaves)
    }
}

/// Adds to the rows of a face's nodes what it has of them. `integrals` are those of its shape functions over the covered
/// part and over all of it, `moments` those of their products with each coordinate over the covered part, `masters` the nodes
/// opposite with the coefficients of their shape functions at its nodes, `gaps` the coefficients of the gap.
pub(super) fn add_face(
    rows: &mut BTreeMap<usize, Row>,
    (nodes, basis): (&[usize], &Basis),
    (integrals, moments): ([Values; 2], [Values; 3]),
    masters: impl Iterator<Item = (usize, Values)>,
    (normals, gaps): ([Vector3; MOST_NODES], Values),
) {
    let [areas, whole] = integrals.map(|integrals| basis.functions(integrals));
    let moments = moments.map(|along| basis.functions(along));
    let control = |(node, values)| (node, basis.control_values(values));
    let mut masters: Vec<(usize, Values)> = masters.map(control).collect();
    // Rows are made of runs that ascend, which are merged in little time.
    masters.sort_unstable_by_key(|(node, _)| *node);
    // Nodal values that are one at a node each.
    let of_one = |one: usize| std::array::from_fn(|node| f64::from(node == one));
    let own = nodes.iter().enumerate().map(|(j, &node)| control((node, of_one(j))));
    let own: Vec<(usize, Values)> = own.collect();
    let gaps = basis.control_values(gaps);
    for (j, &node) in nodes.iter().enumerate() {
        let scaled = |(node, values): &(usize, Values)| (*node, areas[j] * values[j]);
        let row = rows.entry(node).or_default();
        row.is_large |= j < basis.kind.corners() && basis.kind.corners() < nodes.len();
        row.area += areas[j];
        row.whole += whole[j];
        // A node that a row does not move is not named by it: it may face nothing.
        row.weights.extend(own.iter().map(scaled).filter(|(_, weight)| *weight != 0.0));
        row.add_masters(masters.iter().map(scaled));
        row.normal += areas[j] * normals[j];
        row.gap += areas[j] * gaps[j];
        row.middle += Vector3::from(moments.map(|along| along[j]));
    }
}

/// Sums the weights of each node and divides them, in memory of their size: what a shorter list leaves of its own lies between
/// others until all are given back, which takes a fifth longer.
fn merged(mut weights: Vec<Weight>, area: f64) -> Vec<Weight> {
    weights.sort_by_key(|(node, _)| *node);
    weights.dedup_by(|next, sum| {
        let is_same = next.0 == sum.0;
        sum.1 += if is_same { next.1 } else { 0.0 };
        is_same
    });
    weights.iter_mut().for_each(|(_, weight)| *weight /= area);
    weights.retain(|(_, weight)| weight.abs() > ROUNDING);
    weights.as_slice().to_vec()
}
