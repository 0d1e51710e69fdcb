//! Rows while they are summed over the faces at their nodes; the rows of faces that count as covered wholly; and pairs of rows.

use std::collections::BTreeMap;

use super::control::{Basis, Edges};
use super::mesh::Side;
use super::pairs::{SurfacePair, SurfacePairs, SurfaceReport, Weight, without_rounding};
use super::settings::SurfaceSettings;
use super::shape::{MOST_NODES, Values};
use super::symmetry::OnPlanes;
use crate::error::Error;
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::Vector3;

/// The bit of a node that is a master: it sorts masters behind all slaves.
const MASTER: usize = 1 << (usize::BITS - 1);

/// What supports leave of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Moves {
    Wholly,
    /// Supports hold its node and some of its masters. The weights of the others: none, if it names another slave node that moves.
    InPart(f64),
    /// It names no node that moves, and the pair rests.
    Nothing,
}

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

    /// What supports leave of the row along its normal: all of it if its node moves, or all of its masters do.
    pub(super) fn moves(&self, node: usize, settings: &SurfaceSettings) -> Moves {
        let is_held = |node: usize| settings.is_supported(node, self.normal);
        if !is_held(node) {
            return Moves::Wholly;
        }
        let named = self.weights.iter().filter(|(_, weight)| weight.abs() > ROUNDING * self.area);
        let (held, free): (Vec<Weight>, Vec<Weight>) =
            named.partition(|(node, _)| is_held(node & !MASTER));
        let is_master = |(node, _): &&Weight| node & MASTER != 0;
        if !held.iter().any(|entry| is_master(&entry)) {
            return Moves::Wholly;
        }
        let part = free.iter().filter(is_master).map(|(_, weight)| weight / self.area).sum();
        if free.is_empty() { Moves::Nothing } else { Moves::InPart(part) }
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

/// The pair of a slave node and its row, in the planes of symmetry on which the node stands. The gap is that between the
/// points of both sides, and 0 without masters.
pub(super) fn pair_of_row(
    [slave, master]: [&Side<'_>; 2],
    planes: &OnPlanes,
    (node, row): (usize, Row),
    normal: Vector3,
) -> SurfacePair {
    let (area, moving) = (row.area, 1.0 - row.held / row.area);
    let normal = planes.turned(node, normal);
    let (nodes, slave_count) = row.into_nodes();
    let point = slave.point(&nodes[..slave_count]);
    let gap = match &nodes[slave_count..] {
        [] => 0.0,
        masters => {
            let opposite = master.point(masters);
            let size = normal.abs().dot(&(opposite.abs() + point.abs()));
            without_rounding(normal.dot(&(opposite - point)), size)
        }
    };
    SurfacePair {
        slave: node,
        nodes,
        slave_count,
        turns: Vec::new(),
        point: point.into(),
        normal: normal.into(),
        // They follow once all normals are known.
        tangents: Default::default(),
        gap,
        measured_gap: gap,
        area,
        moving,
    }
}

/// The pairs of rows; slave nodes without a row are unpaired. The number of slave faces and the covered area are added to
/// the report.
///
/// # Errors
/// Those of `pair`, which makes a pair of a node and its row; what stops the pairing.
pub(super) fn pairs_of_rows(
    slave: &Side<'_>,
    rows: BTreeMap<usize, Row>,
    mut report: SurfaceReport,
    pair: impl Fn(usize, Row) -> Result<SurfacePair, Error>,
) -> Result<SurfacePairs, Error> {
    let kept = |(node, row)| {
        slave.progress.goes_on()?;
        pair(node, row)
    };
    let pairs: Vec<SurfacePair> = rows.into_iter().map(kept).collect::<Result<_, Error>>()?;
    report.slave_faces = slave.count();
    report.covered_area = pairs.iter().map(|pair| pair.area).sum();
    let mut unpaired = slave.all_nodes();
    slave.progress.goes_on()?;
    let mut next = pairs.iter().peekable();
    unpaired.retain(|node| next.next_if(|pair| pair.slave == *node).is_none());
    Ok(SurfacePairs { dim: slave.dim, pairs, unpaired, report, ..SurfacePairs::default() })
}

/// The slave's part of the rows all of whose slave nodes meet something, as if every face were covered wholly. The area of
/// the host's faces is added to the report.
///
/// # Errors
/// What stops the pairing.
pub(super) fn whole_rows(
    meets: impl Fn(usize) -> bool,
    side: &Side<'_>,
    report: &mut SurfaceReport,
) -> Result<BTreeMap<usize, Row>, Error> {
    let mut edges = Edges::default();
    for face in side.each_face() {
        let (_, face) = face?;
        edges.add(face.kind, face.nodes, !face.is_at_axis());
    }
    let mut rows: BTreeMap<usize, Row> = BTreeMap::new();
    for face in side.each_face() {
        let (at, face) = face?;
        let basis = edges.basis(face.kind, face.nodes, true);
        let (on, integrals) = ((face.nodes, &basis), ([face.integrals(); 2], Default::default()));
        report.slave_area += side.own_area(at, integrals.0[0]);
        add_face(&mut rows, on, integrals, std::iter::empty(), Default::default());
    }
    rows.retain(|_, row| row.slaves().all(|(node, _)| meets(node)));
    Ok(rows)
}
