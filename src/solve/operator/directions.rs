//! Directions in which GMRES has moved the bodies, kept for the next system: its rows differ on the pairs whose
//! states have changed only, and what a direction costs, a solution with a factor, is spent (M. L. Parks,
//! E. de Sturler, G. Mackey, D. D. Johnson and S. Maiti, *Recycling Krylov subspaces for sequences of linear
//! systems*, SIAM J. Sci. Comput. 28 (2006) 1651-1674).

/// Most new directions of one system.
pub const MOST_DIRECTIONS: usize = 100;

/// Most bytes of the directions that are kept: with a million pairs taking them out of each new one costs more than the
/// products that they save.
const MOST_BYTES: usize = 1 << 29;

/// Vectors of all unknowns that a direction takes: itself, its product, and its image.
pub const VECTORS: usize = 3;

/// Most directions that are kept of so many unknowns, the latest ones: half of those of one system.
pub fn most_kept(unknowns: usize) -> usize {
    (MOST_DIRECTIONS / 2).min(MOST_BYTES / (VECTORS * size_of::<f64>() * unknowns.max(1)))
}

/// Where less than this part of an image is left when the others are taken out of it, its direction is left out: the
/// shares of such directions are large, and their sum loses these digits.
pub const LEAST_OF_IMAGE: f64 = 1e-4;

/// A change of all unknowns, and the forces that it asks for, of `A` times it: those on the pairs where the inner unknowns
/// are in equilibrium, all of them otherwise. It is one whatever is held.
pub struct Moved {
    pub z: Vec<f64>,
    pub forces: Vec<f64>,
}

/// Forgets the oldest directions.
pub fn forget(directions: &mut Vec<Moved>) {
    let most = directions.first().map_or(0, |moved| most_kept(moved.z.len()));
    directions.drain(..directions.len().saturating_sub(most));
}

/// Adds a share of each direction to a change of all unknowns.
pub fn add_shares(directions: &[Moved], shares: &[f64], sum: &mut Moved) {
    for (share, moved) in shares.iter().zip(directions).filter(|(share, _)| **share != 0.0) {
        sum.z.iter_mut().zip(&moved.z).for_each(|(sum, part)| *sum += share * part);
        sum.forces.iter_mut().zip(&moved.forces).for_each(|(sum, part)| *sum += share * part);
    }
}
