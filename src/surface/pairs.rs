//! Contact pairs from surfaces: what the caller gets.

use std::collections::BTreeMap;

use super::images::Images;
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector3::{self, Vector3, without};

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
}

/// A slave node with little cover whose row is in those of others.
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
    /// Slave faces that look away from an obstacle that is a shape.
    pub looking_away: usize,
    /// Slave faces whose pairs overlap the other side in the mean, and those of them on which gaps differ by more than that:
    /// the facets are larger than the interference.
    pub overlapping_and_rough: [usize; 2],
}

/// Degrees of freedom of the host's nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeDofs {
    /// `per_node * node + axis`: 6 a node for shells, of which the first `dim` are displacements.
    PerNode(usize),
    /// `dim` for each node of the host, in the order of the axes.
    Listed(Vec<usize>),
}

impl NodeDofs {
    /// Those of a node, `dim` of them.
    pub fn of(&self, node: usize, dim: usize) -> impl Iterator<Item = usize> {
        (0..dim).map(move |axis| self.along(axis, node, dim))
    }

    fn along(&self, axis: usize, node: usize, dim: usize) -> usize {
        match self {
            NodeDofs::PerNode(per_node) => per_node * node + axis,
            NodeDofs::Listed(dofs) => dofs[dim * node + axis],
        }
    }
}

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

/// Arrays of pairs in degrees of freedom `dim * node + axis`: what [`crate::reduce::ContactPairs`] takes, with
/// the gaps and areas that belong to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairArrays {
    /// Space dimension.
    pub dim: usize,
    /// Number of pairs.
    pub count: usize,
    /// Degrees of freedom of the slaves, `dim` for each pair; empty in general rows.
    pub slaves: Vec<usize>,
    /// Start of each pair's masters, in general rows of all its nodes; `count + 1` entries.
    pub master_start: Vec<usize>,
    /// Degrees of freedom of the masters, in general rows of all nodes, `dim` for each; one for each of [`Self::vectors`].
    pub masters: Vec<usize>,
    /// Weights of the masters, in general rows of all nodes with their signs; empty with [`Self::vectors`].
    pub weights: Vec<f64>,
    /// General rows by degree of freedom, of a sector, of planes of symmetry that are across no axis and where rows reach across
    /// a plane: `dim` numbers for each of `masters`. Otherwise empty.
    pub vectors: Vec<f64>,
    /// Normals, `dim` for each pair.
    pub normals: Vec<f64>,
    /// First tangents, `dim` for each pair.
    pub tangents: Vec<f64>,
    /// Initial gaps.
    pub gaps: Vec<f64>,
    /// Areas: the pressure is the normal force over it.
    pub areas: Vec<f64>,
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

    /// Gives the row other nodes: `true` of masters, and the node, with its weight. Weights that are zero but for rounding are
    /// left out.
    pub(super) fn set_nodes(&mut self, mut weights: BTreeMap<(bool, usize), f64>) {
        weights.retain(|_, weight| weight.abs() > ROUNDING);
        self.slave_count = weights.keys().filter(|(is_master, _)| !is_master).count();
        self.nodes = weights.into_iter().map(|((_, node), weight)| (node, weight)).collect();
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
        self
    }
}

/// `true` if one of orthonormal directions is along an axis.
fn is_along(directions: &[Vector3], axis: usize) -> bool {
    directions.iter().any(|along| along.abs() == vector3::axis(axis))
}

/// A gap of coordinates of this size: zero if it is their rounding, so that surfaces that touch do not overlap.
pub(super) fn without_rounding(distance: f64, size: f64) -> f64 {
    if distance.abs() <= ROUNDING * size { 0.0 } else { distance }
}

impl PairArrays {
    /// Adds a pair with its masters, or with all its nodes. Along an axis across a plane of symmetry all of them
    /// have the degree of freedom of the pair's slave, from which the weights cancel: an equation `0 = d`.
    fn push(
        &mut self,
        (pair, held): (&SurfacePair, &[Vector3]),
        (nodes, dofs): (impl Iterator<Item = Weight>, &NodeDofs),
        (gap, area): (f64, f64),
    ) {
        let dim = self.dim;
        for (node, weight) in nodes {
            for axis in 0..dim {
                let of_row = if is_along(held, axis) { pair.slave } else { node };
                self.masters.push(dofs.along(axis, of_row, dim));
            }
            self.weights.push(weight);
        }
        self.master_start.push(self.weights.len());
        self.end(pair, gap, area);
    }

    /// Adds a pair as a row by degree of freedom: of images those of their nodes, turned; nothing along what is held.
    fn push_vectors(
        &mut self,
        (pair, held): (&SurfacePair, &[Vector3]),
        nodes: impl Iterator<Item = Weight>,
        (images, dofs): (&Images, &NodeDofs),
    ) {
        let dim = self.dim;
        for (node, weight) in nodes {
            let (node, turn) = images.of(node);
            for axis in 0..dim {
                let moved = turn * vector3::axis(axis);
                // The rest of a direction that is held is rounding, which is not to pass for a motion.
                let free = without(moved, held).map(|part| without_rounding(part, 1.0));
                let vector = weight * free;
                self.masters.push(dofs.along(axis, node, dim));
                self.vectors.extend(&vector.as_slice()[..dim]);
            }
        }
        self.master_start.push(self.masters.len());
        self.end(pair, pair.gap, pair.area);
    }

    fn end(&mut self, pair: &SurfacePair, gap: f64, area: f64) {
        let dim = self.dim;
        self.count += 1;
        self.normals.extend(&pair.normal[..dim]);
        self.tangents.extend(&pair.tangents[0][..dim]);
        self.gaps.push(gap);
        self.areas.push(area);
    }
}

impl SurfacePairs {
    /// The pairs as general rows: of any faces, with gaps and areas as they are.
    pub fn rows(&self) -> PairArrays {
        self.rows_on(&NodeDofs::PerNode(self.dim))
    }

    /// [`Self::rows`] with the host's own degrees of freedom.
    ///
    /// # Panics
    /// If a list of degrees of freedom ends before the last node of a pair.
    pub fn rows_on(&self, dofs: &NodeDofs) -> PairArrays {
        let (dim, count) = (self.dim, self.pairs.len());
        let entries: usize = self.pairs.iter().map(|pair| pair.nodes.len()).sum();
        let by_dof = self.are_by_dof();
        let mut arrays = PairArrays {
            dim,
            masters: Vec::with_capacity(dim * entries),
            weights: Vec::with_capacity(if by_dof { 0 } else { entries }),
            vectors: Vec::with_capacity(if by_dof { dim * dim * entries } else { 0 }),
            normals: Vec::with_capacity(dim * count),
            tangents: Vec::with_capacity(dim * count),
            master_start: vec![0],
            ..PairArrays::default()
        };
        for pair in &self.pairs {
            let masters = pair.masters().iter().map(|&(node, weight)| (node, -weight));
            let nodes = pair.slaves().iter().copied().chain(masters);
            let of_pair = (pair, &self.held(pair.slave)[..]);
            match by_dof {
                true => arrays.push_vectors(of_pair, nodes, (&self.images, dofs)),
                false => arrays.push(of_pair, (nodes, dofs), (pair.gap, pair.area)),
            }
        }
        arrays
    }

    /// `true` if rows of nodes, with one weight for all axes, do not say it.
    fn are_by_dof(&self) -> bool {
        let is_skewed = |pair: &SurfacePair| {
            let held = self.held(pair.slave);
            (0..self.dim).filter(|&axis| is_along(&held, axis)).count() < held.len()
        };
        let is_by_dof = |pair: &SurfacePair| is_skewed(pair) || pair.has_image(&self.images);
        self.images.are_of_sector() || self.pairs.iter().any(is_by_dof)
    }

    /// The directions across planes of symmetry on which a node stands.
    pub(super) fn held(&self, node: usize) -> Vec<Vector3> {
        self.held.get(&node).into_iter().flatten().copied().map(Vector3::from).collect()
    }

    /// The pairs in the form with one slave node, `u_slave - Σ w u`, to which a row is brought by a
    /// division by the weight `a` of its slave: gap and `d` become `1 / a` times what they were, force
    /// and area `a` times. `None` if a row has slave nodes to which other pairs belong: the mid nodes of
    /// quadratic faces, which [`Self::rows`] has too; or if rows are by degree of freedom.
    pub fn one_slave_each(&self) -> Option<PairArrays> {
        if self.are_by_dof() {
            return None;
        }
        let dim = self.dim;
        let mut arrays = PairArrays { dim, master_start: vec![0], ..PairArrays::default() };
        let belongs = |node| self.pairs.binary_search_by_key(&node, |pair| pair.slave).is_ok();
        for pair in &self.pairs {
            let own = pair.slaves().iter().find(|(node, _)| *node == pair.slave)?.1;
            let others = pair.slaves().iter().filter(|(node, _)| *node != pair.slave);
            let mut masters: Vec<Weight> = others.map(|(node, a)| (*node, -a / own)).collect();
            if masters.iter().any(|(node, _)| belongs(*node)) {
                return None;
            }
            masters.extend(pair.masters().iter().map(|(node, weight)| (*node, weight / own)));
            arrays.slaves.extend(dim * pair.slave..dim * (pair.slave + 1));
            let dofs = &NodeDofs::PerNode(dim);
            let held = self.held(pair.slave);
            let of_rest = (pair.gap / own, pair.area * own);
            arrays.push((pair, &held), (masters.into_iter(), dofs), of_rest);
        }
        Some(arrays)
    }

    /// The pairs whose slave node stands on a plane of symmetry.
    pub fn on_symmetry(&self) -> impl Iterator<Item = usize> {
        (0..self.pairs.len()).filter(|&pair| self.held.contains_key(&self.pairs[pair].slave))
    }
}
