//! Contact pairs from surfaces: what the caller gets, and their frames.

use std::collections::BTreeMap;

use super::images::Images;
use super::plane;
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::{ERROR_OF_DIRECTION, Matrix3, Vector3, most_across, unit};

/// A node's share in a row, and its weight.
pub type Weight = (usize, f64);

/// A contact pair as a row over nodes: `d = Σ a_i u_i - Σ w_k u_k` over the slave's nodes and the
/// master's, in the host's axes, with `Σ a_i = 1`, and `Σ w_k = 1` unless the pair faces an obstacle.
///
/// Vectors have their third component zero in the plane.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePair {
    /// The slave node that the row belongs to. No other pair belongs to it.
    pub slave: usize,
    /// The nodes of the row, slaves by node, then masters by node: one list is given back in half the time of two. In a sector
    /// and at planes of symmetry some may be images, as [`SurfacePairs::images`] counts them.
    pub nodes: Vec<Weight>,
    /// Number of slaves among them.
    pub slave_count: usize,
    /// The matrix of each master, by columns, that takes the turn of the masters off `d`, if the row keeps rigid turns: it is added
    /// to `-w`. Otherwise empty.
    pub turns: Vec<[[f64; 3]; 3]>,
    /// Where the force of the pair acts on the slave's body: the slave nodes' places by their weights.
    pub point: [f64; 3],
    /// Unit normal, outward from the slave's body.
    pub normal: [f64; 3],
    /// Unit tangents, in the plane one (the normal turned by +90 degrees) and zero; in space the first as
    /// [`SurfaceSettings::tangent`](super::SurfaceSettings::tangent) says, the second is the normal times it.
    pub tangents: [[f64; 3]; 2],
    /// Initial gap: positive if open, negative if the surfaces overlap.
    pub gap: f64,
    /// It as measured, before `close_within` and `clearance`.
    pub measured_gap: f64,
    /// The area that the pair carries: the pressure is the normal force of the row over it.
    pub area: f64,
    /// The part of it that is not from nodes which supports hold on both sides.
    pub moving: f64,
}

/// A slave node with little cover, or one that supports hold, whose row is in those of others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fold {
    /// The node.
    pub node: usize,
    /// The nearest of the nodes of its own faces whose pairs have taken it in: none has more of it.
    pub into: usize,
    /// The distance between them.
    pub distance: f64,
}

/// A report on the faces and nodes that have no pair of their own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceReport {
    /// The largest open distance that was looked at; infinite against an obstacle if none was given.
    pub search_distance: f64,
    /// The largest depth of an overlap that was looked at.
    pub overlap_distance: f64,
    /// Number of slave faces.
    pub slave_faces: usize,
    /// Area of the slave faces.
    pub slave_area: f64,
    /// The part of it that lies over the other side: the areas of all pairs.
    pub covered_area: f64,
    /// Slave faces that lie over nothing.
    pub uncovered_faces: Vec<usize>,
    /// Slave faces of which a part lies over the other side, and those over faces that are much smaller: their pairs do not hold
    /// all that is over them.
    pub held_in_part: Vec<usize>,
    /// Slave faces that lie over nothing within the search distance, but point at a master beyond it, or overlap one by more:
    /// each with how far that is away, negative if they overlap. Contact there is not seen.
    pub beyond: Vec<(usize, f64)>,
    /// Nodes with little cover.
    pub folded: Vec<Fold>,
    /// Master faces near a slave face whose normals do not oppose its own. If no pair was found and
    /// there are many of them, one side is turned over.
    pub not_opposed: usize,
    /// Boxes that the search looked at: its cost.
    pub boxes_searched: usize,
    /// Planes of symmetry that no slave node stands on.
    pub idle_planes: Vec<usize>,
    /// Planes of symmetry beside which a slave node stands, and not on it: each with the nearest of these nodes and its distance.
    pub beside_planes: Vec<(usize, usize, f64)>,
    /// Slave faces that look away from an obstacle that is a shape.
    pub looking_away: usize,
    /// Number of pairs at which facets of curved sides change a gap by more than a tenth of it, and the most by which they
    /// change it. `None`: there are none, or few.
    pub large_facets: Option<(usize, f64)>,
    /// How far the true surfaces of both sides stand off their facets, outward, in the mean at each slave node with a pair, while
    /// pairs are made.
    pub(super) stand_off: Vec<(usize, [f64; 2])>,
}

/// An entry of a row: `true` of a master, the node, its weight, and what keeps turns.
pub(super) type Entry = ((bool, usize), (f64, Matrix3));

/// Contact pairs from two surfaces, or from a surface and an obstacle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfacePairs {
    /// Space dimension.
    pub dim: usize,
    /// The pairs, by slave node.
    pub pairs: Vec<SurfacePair>,
    /// `true`: areas are those of rings about the axis `x = 0`, and forces those on whole rings.
    pub axisymmetric: bool,
    /// Slave nodes without a pair: nothing lies over them, or they have little cover and were folded.
    pub unpaired: Vec<usize>,
    /// Nodes of both sides that stand on planes of symmetry, with orthonormal directions across these. Along them a pair of such
    /// a slave node neither moves nor carries a force, and the rows that are handed out say so.
    pub held: BTreeMap<usize, Vec<[f64; 3]>>,
    /// The images of nodes in the neighbours of a sector and beyond planes of symmetry.
    pub images: Images,
    /// The unit vector that first tangents point towards in space.
    pub towards: [f64; 3],
    /// The report on the pairing.
    pub report: SurfaceReport,
}

impl SurfacePair {
    /// Slave nodes of the row with their weights, by node. One node of weight 1 on linear faces that
    /// are covered; a mid node of a quadratic face has its corners beside it, and a node that has taken
    /// in a neighbour with little cover has that neighbour.
    pub fn slaves(&self) -> &[Weight] {
        &self.nodes[..self.slave_count]
    }

    /// Master nodes with their weights, by node; none against an obstacle.
    pub fn masters(&self) -> &[Weight] {
        &self.nodes[self.slave_count..]
    }

    /// The entries of the row: `true` of masters, the node, its weight, and what keeps turns, zero without.
    pub(super) fn entries(&self) -> impl Iterator<Item = Entry> {
        let turn = |at: usize| {
            let at = at.checked_sub(self.slave_count)?;
            self.turns.get(at).copied().map(Matrix3::from)
        };
        self.nodes.iter().enumerate().map(move |(at, &(node, weight))| {
            ((at >= self.slave_count, node), (weight, turn(at).unwrap_or_default()))
        })
    }

    /// Gives the row other entries: the sums of those of one node. Those that are zero but for rounding are left out.
    pub(super) fn set_entries(&mut self, parts: impl IntoIterator<Item = Entry>) {
        // Slaves, then masters.
        let mut entries: BTreeMap<_, (f64, Matrix3)> = BTreeMap::new();
        for (key, (weight, turn)) in parts {
            let entry = entries.entry(key).or_default();
            entry.0 += weight;
            entry.1 += turn;
        }
        entries.retain(|_, (weight, turn)| weight.abs().max(turn.amax()) > ROUNDING);
        self.slave_count = entries.keys().filter(|(is_master, _)| !is_master).count();
        self.nodes = entries.iter().map(|((_, node), (weight, _))| (*node, *weight)).collect();
        let turns = entries.iter().skip(self.slave_count).map(|(_, (_, turn))| *turn);
        let keeps_turns = turns.clone().any(|turn| turn != Matrix3::zeros());
        self.turns = if keeps_turns { turns.map(Into::into).collect() } else { Vec::new() };
    }

    /// `true` if the row has an image of a node.
    pub(super) fn has_image(&self, images: &Images) -> bool {
        self.nodes.iter().any(|(node, _)| images.has(*node))
    }

    /// The pair with other numbers of the images, in their order.
    pub(super) fn renumbered(&self, images: &Images, numbers: &[usize]) -> SurfacePair {
        let mut pair = self.clone();
        let of_images = pair.nodes.iter_mut().filter(|(node, _)| images.has(*node));
        of_images.for_each(|(node, _)| *node = numbers[*node - images.numbers().start]);
        pair
    }

    /// The pair without its masters: against an obstacle.
    pub fn without_masters(mut self) -> SurfacePair {
        self.nodes.truncate(self.slave_count);
        self.turns.clear();
        self
    }
}

/// A gap of coordinates of this size: zero if it is their rounding, so that surfaces that touch do not overlap.
pub(super) fn without_rounding(distance: f64, size: f64) -> f64 {
    if distance.abs() <= ROUNDING * size { 0.0 } else { distance }
}

impl SurfacePairs {
    /// The directions across planes of symmetry on which a node stands.
    pub(super) fn held(&self, node: usize) -> Vec<Vector3> {
        self.held.get(&node).into_iter().flatten().copied().map(Vector3::from).collect()
    }

    /// The pairs whose slave node stands on a plane of symmetry.
    pub fn on_symmetry(&self) -> impl Iterator<Item = usize> {
        (0..self.pairs.len()).filter(|&pair| self.held.contains_key(&self.pairs[pair].slave))
    }

    /// Gives all pairs their tangents, the first towards a direction. Without one it is the axis most across all normals: an
    /// axis for each pair by itself would jump between pairs whose normals differ by little.
    pub(super) fn set_tangents(&mut self, towards: Option<[f64; 3]>) {
        let towards = towards.and_then(|towards| unit(towards.into()));
        let square = |normal: Vector3| normal.component_mul(&normal);
        let squares = self.pairs.iter().map(|pair| pair.area * square(pair.normal.into()));
        let towards = towards.unwrap_or_else(|| most_across(squares.sum()));
        for at in 0..self.pairs.len() {
            let pair = &self.pairs[at];
            let found = tangents(self.dim, pair.normal.into(), towards, &self.held(pair.slave));
            self.pairs[at].tangents = found.map(Into::into);
        }
        self.towards = towards.into();
    }
}

/// Tangents of a normal, in space the first towards a unit vector as nearly as may be.
pub(super) fn tangents(
    dim: usize,
    normal: Vector3,
    towards: Vector3,
    held: &[Vector3],
) -> [Vector3; 2] {
    let first = match held {
        _ if dim == 2 => None,
        // A frame has a tangent along a direction that is held.
        [across] => {
            let along = across.cross(&normal);
            let nearness = |tangent: Vector3| tangent.dot(&towards).abs();
            let is_nearer = nearness(along) >= nearness(*across) - ERROR_OF_DIRECTION;
            let nearer = if is_nearer { along } else { *across };
            Some(if nearer.dot(&towards) < 0.0 { -nearer } else { nearer })
        }
        _ => {
            let along = towards - normal.dot(&towards) * normal;
            unit(along).filter(|_| along.norm() > ERROR_OF_DIRECTION)
        }
    };
    first.map_or_else(|| plane::tangents(dim, normal), |first| [first, normal.cross(&first)])
}
