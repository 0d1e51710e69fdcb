//! Slave nodes moved onto the other side, once, before a host assembles its matrix: what ties of curved sides need.
//!
//! A row `Σ a u_s - Σ w u_m` of facets does not keep a rigid turn, as `g = Σ a x_s - Σ w x_m` is not zero: the points of
//! the two sides do not meet. Nodes are moved by `S dx = -g`, `S` the slave's weights of all rows, and of all solutions by the
//! least: `dx = Sᵀ (S Sᵀ)⁻¹ (-g)`. As the rows of the moved nodes differ in second order alone, once is enough in the mean;
//! a second time, with new pairs, leaves a tenth to the largest of quadratic faces.

use std::collections::{BTreeSet, HashSet};

use super::pairs::{SurfacePair, SurfacePairs, Weight, without_rounding};
use super::watch::Watch;
use crate::error::{Argument, Error, index};
use crate::linalg::conjugate_gradients::conjugate_gradients;
use crate::linalg::sparse_matrix::{Csc, from_entries, times, transpose_times};
use crate::linalg::vector3::{Vector3, vector};
use crate::monitor::Monitor;

/// `Sᵀ` along an axis: a column for each pair, a row for each of some nodes, those that are held apart.
fn slave_weights(pairs: &[&SurfacePair], nodes: &[usize], axis: usize) -> Result<Csc, Error> {
    let is_held = |pair: &&&SurfacePair| pair.held[axis];
    let held: HashSet<usize> = pairs.iter().filter(is_held).map(|pair| pair.slave).collect();
    let moves = |(node, _): &&Weight| !held.contains(node);
    let free = pairs.iter().enumerate().filter(|(_, pair)| !pair.held[axis]);
    let entries = free.flat_map(|(k, pair)| {
        let weights = pair.slaves().iter().filter(moves);
        weights.map(move |&(node, weight)| (nodes.partition_point(|n| *n < node), k, weight))
    });
    from_entries((nodes.len(), pairs.len()), entries)
        .map_err(|_| Error::OutOfMemory("the rows of the pairs"))
}

/// Where a master moves too, as in zones that are joined in a row, its slave misses it.
fn masters_stay(pairs: &[&SurfacePair], dim: usize, moves: &[(usize, f64)]) -> Result<(), Error> {
    let most = moves.iter().map(|(_, moved)| moved.abs()).fold(0.0, f64::max);
    let seen = moves.iter().filter(|(_, moved)| without_rounding(*moved, most) != 0.0);
    let moving: HashSet<usize> = seen.map(|(entry, _)| entry / dim).collect();
    let masters = pairs.iter().flat_map(|pair| pair.masters());
    match masters.map(|(node, _)| *node).find(|node| moving.contains(node)) {
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
        let named = self.pairs.iter().flat_map(|pair| &pair.nodes);
        let least = named.map(|(node, _)| dim * (node + 1)).max().unwrap_or(0);
        if coordinates.len() < least {
            let message =
                format!("there are {} coordinates, the pairs have {least}", coordinates.len());
            return Err(Error::invalid(Argument::Coordinates, message));
        }
        let watch = &mut Watch::new(monitor);
        let place = |&(node, weight): &Weight| weight * vector(&coordinates[dim * node..][..dim]);
        let apart = |pair: &SurfacePair| -> Vector3 {
            if pair.masters().is_empty() {
                return -pair.measured_gap * Vector3::from(pair.normal);
            }
            let [slave, master] = [pair.slaves(), pair.masters()]
                .map(|nodes| nodes.iter().map(place).sum::<Vector3>());
            slave - master
        };
        let all = self.pairs.iter().map(|pair| (pair, apart(pair)));
        let (pairs, apart): (Vec<&SurfacePair>, Vec<Vector3>) =
            all.filter(|(_, apart)| apart.norm() <= within).unzip();
        let mut moves: Vec<(usize, f64)> = Vec::new();
        let slaves = pairs.iter().flat_map(|pair| pair.slaves());
        let nodes: BTreeSet<usize> = slaves.map(|(node, _)| *node).collect();
        let nodes: Vec<usize> = nodes.into_iter().collect();
        for axis in 0..dim {
            let weights = slave_weights(&pairs, &nodes, axis)?;
            let free = |(pair, apart): (&&SurfacePair, &Vector3)| {
                if pair.held[axis] { 0.0 } else { -apart[axis] }
            };
            let wanted: Vec<f64> = pairs.iter().zip(&apart).map(free).collect();
            let squared = |y: &[f64]| transpose_times(&weights, &times(&weights, y));
            let shares = conjugate_gradients(squared, &wanted, || watch.goes_on())?;
            let places = nodes.iter().map(|node| dim * node + axis);
            moves.extend(places.zip(times(&weights, &shares)));
        }
        masters_stay(&pairs, dim, &moves)?;
        moves.into_iter().for_each(|(entry, moved)| coordinates[entry] += moved);
        Ok(())
    }
}
