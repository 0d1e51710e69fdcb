//! Slave nodes moved onto the other side, once, before a host assembles its matrix: what ties of curved sides need.
//!
//! A row `Σ a u_s - Σ w u_m` of facets does not keep a rigid turn, as `g = Σ a x_s - Σ w x_m` is not zero: the points of
//! the two sides do not meet. Nodes are moved by `S dx = -g`, `S` the slave's weights of all rows, and of all solutions by the
//! least: `dx = Sᵀ (S Sᵀ)⁻¹ (-g)`. As the rows of the moved nodes differ in second order alone, once is enough in the mean;
//! a second time, with new pairs, leaves a tenth to the largest of quadratic faces.

use std::collections::{BTreeSet, HashSet};

use super::pairing_progress::PairingProgress;
use super::pairs::{SurfacePair, SurfacePairs, Weight, without_rounding};
use crate::error::{Argument, Error, index};
use crate::linalg::conjugate_gradients::conjugate_gradients;
use crate::linalg::sparse_matrix::{Csc, from_entries, times, transpose_times};
use crate::linalg::vector::norm_inf;
use crate::linalg::vector3::{self, Vector3, vector, without};
use crate::monitor::Monitor;

/// The motions of nodes, as rows see them.
struct Motions<'p> {
    found: &'p SurfacePairs,
    pairs: Vec<&'p SurfacePair>,
    /// The slave nodes of the pairs, ascending; of images those that they are images of.
    nodes: Vec<usize>,
}

impl<'p> Motions<'p> {
    fn new(found: &'p SurfacePairs, pairs: Vec<&'p SurfacePair>) -> Self {
        let slaves = pairs.iter().flat_map(|pair| pair.slaves());
        let nodes: BTreeSet<usize> = slaves.map(|(node, _)| found.images.home(*node).0).collect();
        Motions { found, pairs, nodes: nodes.into_iter().collect() }
    }

    /// `Sᵀ`: `dim` columns for each pair, `dim` rows for each node.
    fn slave_weights(&self) -> Result<Csc, Error> {
        let SurfacePairs { dim, ref images, .. } = *self.found;
        let mut entries = Vec::new();
        for (k, pair) in self.pairs.iter().enumerate() {
            let of_pair = self.found.held(pair.slave);
            for &(node, weight) in pair.slaves() {
                let (node, motion) = images.home(node);
                let place = self.nodes.partition_point(|other| *other < node);
                let held = self.found.held(node);
                for axis in 0..dim {
                    let moved = motion.turn * without(vector3::axis(axis), &held);
                    let seen = weight * without(moved, &of_pair);
                    let seen = seen.iter().take(dim).enumerate().filter(|(_, part)| **part != 0.0);
                    entries.extend(seen.map(|(c, part)| (dim * place + axis, dim * k + c, *part)));
                }
            }
        }
        from_entries((dim * self.nodes.len(), dim * self.pairs.len()), entries.into_iter())
            .map_err(|_| Error::OutOfMemory("the rows of the pairs"))
    }
}

/// Where a master moves too, as in zones that are joined in a row, its slave misses it.
fn masters_stay(motions: &Motions<'_>, moves: &[f64]) -> Result<(), Error> {
    let most = norm_inf(moves);
    let is_seen = |moved: &[f64]| moved.iter().any(|moved| without_rounding(*moved, most) != 0.0);
    let of_nodes = motions.nodes.iter().zip(moves.chunks_exact(motions.found.dim));
    let moving: HashSet<usize> =
        of_nodes.filter(|(_, moved)| is_seen(moved)).map(|(node, _)| *node).collect();
    let masters = motions.pairs.iter().flat_map(|pair| pair.masters());
    let homes = masters.map(|(node, _)| motions.found.images.home(*node).0);
    match homes.into_iter().find(|node| moving.contains(node)) {
        None => Ok(()),
        Some(node) => {
            let message = format!(
                "node {} would move, and slave nodes onto it: adjust zone by zone, and pair again between them",
                index(node)
            );
            Err(Error::invalid(Argument::Coordinates, message))
        }
    }
}

impl SurfacePairs {
    /// Moves slave nodes so that the two points of each pair meet, of pairs whose points are no further apart than
    /// `within`: along a plane of symmetry alone if they stand on one; towards an obstacle by the measured gap. `coordinates` are
    /// those of all nodes that were paired. Assemble the matrix with the moved nodes, and pair again.
    ///
    /// # Errors
    /// [`Argument::Settings`]: `within` is negative; [`Argument::Coordinates`]: too few, or those of a node that moves and that
    /// another one moves to; [`Error::Stopped`]: as in the pairing.
    pub fn adjust(
        &self,
        within: f64,
        coordinates: &mut [f64],
        monitor: &mut Monitor<'_>,
    ) -> Result<(), Error> {
        let dim = self.dim;
        // Written so that NaN is refused.
        if !(within >= 0.0) {
            let message = format!("within is {within}, it must not be negative");
            return Err(Error::invalid(Argument::Settings, message));
        }
        let images = &self.images;
        let named =
            self.pairs.iter().flat_map(|pair| &pair.nodes).map(|(node, _)| images.of(*node).0);
        let named = named.chain(images.on_second().keys().copied());
        let least = named.map(|node| dim * (node + 1)).max().unwrap_or(0);
        if coordinates.len() < least {
            let message =
                format!("there are {} coordinates, the pairs have {least}", coordinates.len());
            return Err(Error::invalid(Argument::Coordinates, message));
        }
        let progress = PairingProgress::new(monitor);
        let all = self.pairs.iter().map(|pair| (pair, self.apart(pair, coordinates)));
        let (pairs, apart): (Vec<&SurfacePair>, Vec<Vector3>) =
            all.filter(|(_, apart)| apart.norm() <= within).unzip();
        let motions = Motions::new(self, pairs);
        let weights = motions.slave_weights()?;
        let wanted = motions.pairs.iter().zip(&apart).flat_map(|(pair, apart)| {
            let free = -without(*apart, &self.held(pair.slave));
            free.as_slice()[..dim].to_vec()
        });
        let squared = |y: &[f64]| transpose_times(&weights, &times(&weights, y));
        let shares =
            conjugate_gradients(squared, &wanted.collect::<Vec<_>>(), || progress.goes_on())?;
        let moves = times(&weights, &shares);
        masters_stay(&motions, &moves)?;
        let mut move_by = |node: &usize, by: &[f64]| {
            coordinates[dim * node..].iter_mut().zip(by).for_each(|(x, by)| *x += by);
        };
        for (node, moved) in motions.nodes.iter().zip(moves.chunks_exact(dim)) {
            move_by(node, moved);
        }
        for (second, (first, motion)) in images.on_second() {
            if let Ok(place) = motions.nodes.binary_search(first) {
                let moved = motion.turn * vector(&moves[dim * place..][..dim]);
                move_by(second, &moved.as_slice()[..dim]);
            }
        }
        Ok(())
    }
    /// How far the slave's point of a pair is from the other side's.
    fn apart(&self, pair: &SurfacePair, coordinates: &[f64]) -> Vector3 {
        if pair.masters().is_empty() {
            return -pair.measured_gap * Vector3::from(pair.normal);
        }
        let place = |&(node, weight): &Weight| {
            let (node, motion) = self.images.home(node);
            let x = vector(&coordinates[self.dim * node..][..self.dim]);
            weight * motion.of(x)
        };
        let [slave, master] =
            [pair.slaves(), pair.masters()].map(|nodes| nodes.iter().map(place).sum::<Vector3>());
        slave - master
    }
}
