//! Pairs from surfaces as arrays in the host's degrees of freedom.

use std::collections::HashSet;

use super::images::Images;
use super::pairs::{SurfacePair, SurfacePairs, Weight, without_rounding};
use crate::linalg::vector3::{self, Vector3, without};

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

    /// Of so many nodes those with an axis whose degree of freedom is fixed, for each such axis.
    pub fn held(&self, fixed: &[usize], (nodes, dim): (usize, usize)) -> Vec<(usize, usize)> {
        let fixed: HashSet<&usize> = fixed.iter().collect();
        let places = (0..nodes).flat_map(|node| (0..dim).map(move |axis| (node, axis)));
        places.filter(|(node, axis)| fixed.contains(&self.along(*axis, *node, dim))).collect()
    }

    fn along(&self, axis: usize, node: usize, dim: usize) -> usize {
        match self {
            NodeDofs::PerNode(per_node) => per_node * node + axis,
            NodeDofs::Listed(dofs) => dofs[dim * node + axis],
        }
    }
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
    /// General rows by degree of freedom, of a sector, of planes of symmetry that are across no axis, where rows reach across
    /// a plane, and where they keep rigid turns: `dim` numbers for each of `masters`. Otherwise empty.
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

/// `true` if one of orthonormal directions is along an axis.
fn is_along(directions: &[Vector3], axis: usize) -> bool {
    directions.iter().any(|along| along.abs() == vector3::axis(axis))
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
        (images, dofs): (&Images, &NodeDofs),
    ) {
        let dim = self.dim;
        // The rest of a direction that is held is rounding, which is not to pass for a motion.
        let free = |moved| without(moved, held).map(|part| without_rounding(part, 1.0));
        for ((is_master, node), (weight, of_turn)) in pair.entries() {
            let (node, turn) = images.of(node);
            let weight = if is_master { -weight } else { weight };
            for axis in 0..dim {
                let moved = turn * vector3::axis(axis);
                let vector = weight * free(moved) + free(of_turn * moved);
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
            let of_pair = (pair, &self.held(pair.slave)[..]);
            if by_dof {
                arrays.push_vectors(of_pair, (&self.images, dofs));
                continue;
            }
            let masters = pair.masters().iter().map(|&(node, weight)| (node, -weight));
            let nodes = pair.slaves().iter().copied().chain(masters);
            arrays.push(of_pair, (nodes, dofs), (pair.gap, pair.area));
        }
        arrays
    }

    /// `true` if rows of nodes, with one weight for all axes, do not say it.
    fn are_by_dof(&self) -> bool {
        let is_skewed = |pair: &SurfacePair| {
            let held = self.held(pair.slave);
            (0..self.dim).filter(|&axis| is_along(&held, axis)).count() < held.len()
        };
        let is_by_dof = |pair: &SurfacePair| {
            !pair.turns.is_empty() || is_skewed(pair) || pair.has_image(&self.images)
        };
        self.images.are_of_sector() || self.pairs.iter().any(is_by_dof)
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
}
