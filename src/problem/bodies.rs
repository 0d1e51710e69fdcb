//! Bodies whose stiffness in relative displacements, `K_rel`, is never formed.
//!
//! Their unknowns `x` are inner ones, on which no contact force acts, followed by the relative displacements
//! `d` of the pairs, and equilibrium is
//!
//! ```text
//! A x = b + (0, F),        A symmetric, positive semi-definite.
//! ```
//!
//! `A` is a sparse matrix, or, without inner unknowns, an operator of the host: `A = K_rel`. A solver asks for
//! products, and for solutions with some components of `d` held, or for those of an approximate inverse.

use super::Relation;
use crate::error::Error;

/// A symmetric matrix along the two tangents of a pair; in the plane its first entry alone counts.
pub type Tangential = [[f64; 2]; 2];

/// Which components of `d` are held at zero, and springs along the tangents of pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct Restriction {
    /// One for each component of `d`.
    pub held: Vec<bool>,
    /// One for each pair, positive semi-definite, force per length; those of held components do not count.
    pub springs: Vec<Tangential>,
}

impl Restriction {
    /// All components of `pairs` pairs of `dim` components held.
    pub fn all(dim: usize, pairs: usize) -> Self {
        Restriction { held: vec![true; dim * pairs], springs: vec![[[0.0; 2]; 2]; pairs] }
    }
}

/// Is asked whether a work goes on.
pub type GoesOn<'a> = &'a mut dyn FnMut() -> bool;

/// What a solver asks of bodies. Vectors have an entry for each unknown, the inner ones first.
pub trait Bodies {
    /// Number of inner unknowns.
    fn inner(&self) -> usize;

    /// The unit of force per length of each unknown, positive: of the size of the diagonal of `A`.
    fn units(&self) -> &[f64];

    /// Entry `A[i, j]` between components `i` and `j` of `d` that belong to one pair, `i` not equal to `j`; 0 if
    /// it is not known.
    fn coupling(&self, i: usize, j: usize) -> f64;

    /// `A x`.
    ///
    /// # Errors
    /// What has failed in the host, by a sentence on the matrix.
    fn product(&mut self, x: &[f64]) -> Result<Vec<f64>, Error>;

    /// `A (x + low) - b`, as exactly as it can be had; `low` is what rounding to doubles has left out of the inner
    /// unknowns.
    ///
    /// # Errors
    /// As [`Self::product`].
    fn residual(&mut self, x: &[f64], low: &[f64], load: &[f64]) -> Result<Vec<f64>, Error>;

    /// Bound on the sums of `A x` in which each entry of `x` has at most the given size: `|A| size`.
    fn magnitude(&self, size: &[f64]) -> Vec<f64>;

    /// Whether a product costs next to nothing beside a solution.
    fn has_cheap_products(&self) -> bool;

    /// Whether components can be held: whether [`Self::hold`] may be called.
    fn can_hold(&self) -> bool;

    /// Whether what is held has the springs of the restriction too.
    fn has_springs(&self) -> bool;

    /// From now on [`Self::solve`] solves with these components held. `goes_on` is asked now and then while that
    /// lasts; `false`: it has ended it, and nothing can be solved before another call.
    ///
    /// # Errors
    /// No memory, or what has failed in the host.
    fn hold(&mut self, restriction: &Restriction, goes_on: GoesOn<'_>) -> Result<bool, Error>;

    /// An approximate solution `x` of `A x = forces`: with the held components zero, where forces on them do not
    /// count; without [`Self::hold`] with nothing held.
    ///
    /// # Errors
    /// As [`Self::product`].
    fn solve(&mut self, forces: &[f64]) -> Result<Vec<f64>, Error>;
}

/// The relation of such bodies, as far as it is known without their inner unknowns: the size of forces. What
/// needs more than that finds nothing certified by it.
#[derive(Clone, Debug)]
pub struct Unformed<'a> {
    units: Vec<f64>,
    /// `A[i, j]` of the two tangents of each pair.
    couplings: Vec<f64>,
    dim: usize,
    load: &'a [f64],
}

impl<'a> Unformed<'a> {
    /// Of bodies with pairs of `dim` components and the relative load `load`.
    pub fn new(bodies: &dyn Bodies, dim: usize, load: &'a [f64]) -> Self {
        let units = bodies.units()[bodies.inner()..].to_vec();
        let couplings = match dim {
            2 => Vec::new(),
            _ => (0..load.len()).step_by(dim).map(|n| bodies.coupling(n + 1, n + 2)).collect(),
        };
        Unformed { units, couplings, dim, load }
    }
}

impl Relation for Unformed<'_> {
    fn size(&self) -> usize {
        self.units.len()
    }

    fn block(&self, i: usize, j: usize) -> f64 {
        let normal = i.is_multiple_of(self.dim) || j.is_multiple_of(self.dim);
        match i == j {
            true => self.units[i],
            false if normal => 0.0,
            false => self.couplings[i / self.dim],
        }
    }

    fn load(&self) -> &[f64] {
        self.load
    }

    fn force(&self, _: &[f64], _: &[f64], _: &[f64]) -> Option<Vec<f64>> {
        None
    }

    fn residual(&self, d: &[f64], _: &[f64]) -> Vec<f64> {
        vec![f64::INFINITY; d.len()]
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        vec![f64::INFINITY; size.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is not formed is not known: no force follows from displacements, and every bound is infinite, so that
    /// nothing is certified by it.
    #[test]
    fn a_relation_that_is_not_formed_certifies_nothing() {
        let (units, couplings) = (vec![2.0, 3.0, 3.0], vec![0.5]);
        let unformed = Unformed { units, couplings, dim: 3, load: &[1.0, 0.0, 0.0] };
        let d = [0.1, 0.2, 0.3];
        assert_eq!(unformed.force(&d, &[], &d), None);
        assert_eq!(unformed.residual(&d, &d), [f64::INFINITY; 3]);
        assert_eq!(unformed.magnitude(&d), [f64::INFINITY; 3]);
        assert_eq!(
            (unformed.block(0, 0), unformed.block(0, 1), unformed.block(1, 2)),
            (2.0, 0.0, 0.5)
        );
    }
}
