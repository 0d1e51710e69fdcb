//! Slave nodes moved onto the other side, once, before a host assembles its matrix: what ties of curved sides need.
//!
//! A row `Σ a u_s - Σ w u_m` of facets does not keep a rigid turn, as `g = Σ a x_s - Σ w x_m` is not zero: the points of
//! the two sides do not meet. Nodes are moved by `S dx = -g`, `S` the slave's weights of all rows, and of all solutions by the
//! least: `dx = Sᵀ (S Sᵀ)⁻¹ (-g)`. As the rows of the moved nodes differ in second order alone, once is enough.

use std::collections::HashMap;

use super::pairs::{SurfacePair, SurfacePairs, Weight};
use super::watch::Watch;
use crate::error::{Argument, Error};
use crate::linalg::conjugate_gradients::conjugate_gradients;
use crate::linalg::vector3::{Vector3, vector};
use crate::monitor::Monitor;

/// The slave's weights of the rows along an axis, with columns counted anew.
struct Weights {
    rows: Vec<Vec<Weight>>,
    nodes: Vec<usize>,
}

impl Weights {
    fn new(pairs: &[&SurfacePair], axis: usize) -> Weights {
        let held: Vec<usize> =
            pairs.iter().filter(|pair| pair.held[axis]).map(|pair| pair.slave).collect();
        let (mut columns, mut nodes) = (HashMap::new(), Vec::new());
        let mut column = |node: usize| {
            *columns.entry(node).or_insert_with(|| {
                nodes.push(node);
                nodes.len() - 1
            })
        };
        let mut row = |pair: &&SurfacePair| -> Vec<Weight> {
            let moves = pair
                .slaves
                .iter()
                .filter(|(node, _)| !pair.held[axis] && held.binary_search(node).is_err());
            moves.map(|&(node, weight)| (column(node), weight)).collect()
        };
        let rows = pairs.iter().map(&mut row).collect();
        Weights { rows, nodes }
    }

    fn times(&self, x: &[f64]) -> Vec<f64> {
        let sum = |row: &Vec<Weight>| row.iter().map(|&(k, weight)| weight * x[k]).sum();
        self.rows.iter().map(sum).collect()
    }

    fn transpose_times(&self, y: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.nodes.len()];
        for (row, y) in self.rows.iter().zip(y) {
            row.iter().for_each(|&(k, weight)| x[k] += weight * y);
        }
        x
    }
}

impl SurfacePairs {
    /// Moves slave nodes so that the two points of each pair meet, of pairs whose points are no further apart than
    /// `within`: along a plane of symmetry alone if they stand on one; towards an obstacle by the gap. `coordinates` are
    /// those of all nodes that were paired. Assemble the matrix with the moved nodes, and pair again.
    ///
    /// # Errors
    /// [`Argument::Settings`]: `within` is negative; [`Argument::Coordinates`]: too few; [`Error::Stopped`]: as in the pairing.
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
        let named = self.pairs.iter().flat_map(|pair| pair.slaves.iter().chain(&pair.masters));
        let least = named.map(|(node, _)| dim * (node + 1)).max().unwrap_or(0);
        if coordinates.len() < least {
            let message =
                format!("there are {} coordinates, the pairs have {least}", coordinates.len());
            return Err(Error::invalid(Argument::Coordinates, message));
        }
        let watch = &mut Watch::new(monitor);
        let place = |&(node, weight): &Weight| weight * vector(&coordinates[dim * node..][..dim]);
        let apart = |pair: &SurfacePair| -> Vector3 {
            if pair.masters.is_empty() {
                return -pair.gap * Vector3::from(pair.normal);
            }
            let [slave, master] =
                [&pair.slaves, &pair.masters].map(|nodes| nodes.iter().map(place).sum::<Vector3>());
            slave - master
        };
        let all = self.pairs.iter().map(|pair| (pair, apart(pair)));
        let (pairs, apart): (Vec<&SurfacePair>, Vec<Vector3>) =
            all.filter(|(_, apart)| apart.norm() <= within).unzip();
        for axis in 0..dim {
            let weights = Weights::new(&pairs, axis);
            let free = |(pair, apart): (&&SurfacePair, &Vector3)| {
                if pair.held[axis] { 0.0 } else { -apart[axis] }
            };
            let wanted: Vec<f64> = pairs.iter().zip(&apart).map(free).collect();
            let times = |y: &[f64]| weights.times(&weights.transpose_times(y));
            let shares = conjugate_gradients(times, &wanted, || watch.goes_on())?;
            for (node, moved) in weights.nodes.iter().zip(weights.transpose_times(&shares)) {
                coordinates[dim * node + axis] += moved;
            }
        }
        Ok(())
    }
}
