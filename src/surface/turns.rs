//! Rows that keep rigid turns of the nodes at their places, as ties ask for.
//!
//! The points `Σ a x_s` and `Σ w x_m` of a pair of facets are apart by `r`, so that a rigid turn `u = θ × x` of both bodies moves
//! `d = Σ a u_s - Σ w u_m` by `θ × r`, and strains what is tied. A row that keeps turns takes the master's own part of that off,
//! `d - ω × r`. `ω` is the turn of the master nodes of the row by least squares: `ω = J⁺ Σ y × u`, `J = Σ (|y|² - y yᵀ)`, `y` from their
//! mean to each. Moments of its forces then balance as forces do, however far the points are apart.
//!
//! One node tells no turn, and nodes on a line in space tell none about it, as where the nodes of both sides are opposite each
//! other. There all nodes of the master faces at these have a part in `ω`, and those that the row does not have the weight 0 in it.

use std::collections::BTreeMap;

use super::mesh::Side;
use super::pairs::SurfacePair;
use super::rims::beside;
use crate::error::Error;
use crate::linalg::tolerances::{ROUNDING_OF_SUM, SINGULAR};
use crate::linalg::vector3::{Matrix3, Vector3};

/// Makes the rows of pairs keep turns.
///
/// # Errors
/// What stops the pairing.
pub(super) fn keep_turns(pairs: &mut [SurfacePair], sides: [&Side<'_>; 2]) -> Result<(), Error> {
    let master = sides[1];
    let mut untold: Vec<&mut SurfacePair> = Vec::new();
    for pair in pairs {
        master.progress.goes_on()?;
        let apart = apart(pair, sides);
        if apart == Vector3::zeros() {
            continue;
        }
        let (places, inertia) = inertia(pair, master);
        // Nodes within a tenth of their length of a line would tell turns about it by small differences.
        let narrow = 0.01 * inertia.trace();
        if inertia.rank(narrow) < master.dim {
            untold.push(pair);
        } else {
            pair.take_off(apart, &places, &inertia);
        }
    }
    let named = untold.iter().flat_map(|pair| pair.masters()).map(|(node, _)| *node);
    let beside = beside((master, &[]), named, 1)?;
    for pair in untold {
        let apart = apart(pair, sides);
        let mut nodes: BTreeMap<usize, f64> = pair.masters().iter().copied().collect();
        for (node, _) in pair.masters() {
            beside[node].iter().for_each(|other| _ = nodes.entry(*other).or_default());
        }
        pair.nodes.truncate(pair.slave_count);
        pair.nodes.extend(nodes);
        let (places, inertia) = inertia(pair, master);
        pair.take_off(apart, &places, &inertia);
    }
    Ok(())
}

/// How far the points of a pair are apart; zero but for rounding is zero.
fn apart(pair: &SurfacePair, [slave, master]: [&Side<'_>; 2]) -> Vector3 {
    let apart = slave.point(pair.slaves()) - master.point(pair.masters());
    let sizes = pair.masters().iter().map(|(node, _)| master.point(&[(*node, 1.0)]).norm());
    let is_rounding = apart.norm() <= ROUNDING_OF_SUM * sizes.fold(0.0, f64::max);
    if is_rounding { Vector3::zeros() } else { apart }
}

/// The places of the masters from their mean, and `J`.
fn inertia(pair: &SurfacePair, master: &Side<'_>) -> (Vec<Vector3>, Matrix3) {
    let masters = pair.masters().iter();
    let mut places: Vec<Vector3> = masters.map(|(node, _)| master.point(&[(*node, 1.0)])).collect();
    let mean = places.iter().sum::<Vector3>() / places.len() as f64;
    places.iter_mut().for_each(|place| *place -= mean);
    let inertia =
        places.iter().map(|y| y.norm_squared() * Matrix3::identity() - y * y.transpose()).sum();
    (places, inertia)
}

impl SurfacePair {
    /// Takes `ω × r` off, with `r` by which the points are `apart`.
    fn take_off(&mut self, apart: Vector3, places: &[Vector3], inertia: &Matrix3) {
        // In the plane nothing turns about a line in it.
        let inverse = inertia.pseudo_inverse(SINGULAR * inertia.trace()).unwrap_or_default();
        let of_turn = apart.cross_matrix() * inverse;
        self.turns = places.iter().map(|y| (of_turn * y.cross_matrix()).into()).collect();
    }
}
