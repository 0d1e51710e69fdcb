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

use super::relation::Relation;
use crate::error::Error;
use crate::linalg::ball::UNIT;
use crate::linalg::vector::{norm, opposite, sizes};
pub use crate::linalg::watched::GoesOn;

/// Which components of `d` are held at zero, and springs along the tangents of pairs.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldSet {
    /// One for each component of `d`.
    pub held: Vec<bool>,
    /// One for each pair, a symmetric, positive semi-definite matrix along its two tangents, of which the first entry alone
    /// counts in the plane; force per length; those of held components do not count.
    pub springs: Vec<[[f64; 2]; 2]>,
}

impl HeldSet {
    /// All components of `pairs` pairs of `dim` components held.
    pub fn all(dim: usize, pairs: usize) -> Self {
        HeldSet { held: vec![true; dim * pairs], springs: vec![[[0.0; 2]; 2]; pairs] }
    }

    /// No component of these pairs held.
    pub fn none(dim: usize, pairs: usize) -> Self {
        HeldSet { held: vec![false; dim * pairs], ..HeldSet::all(dim, pairs) }
    }

    /// Sets what is held to zero in a vector of all unknowns.
    pub fn clear(&self, x: &mut [f64]) {
        let inner = x.len() - self.held.len();
        let held = x[inner..].iter_mut().zip(&self.held).filter(|(_, held)| **held);
        held.for_each(|(x, _)| *x = 0.0);
    }
}

/// The result of [`StiffnessOperator::solve`].
pub type Solved = Result<Option<Vec<f64>>, Error>;

/// Sums of `|A| size` beside the units, where no entry is known.
const NEIGHBOURS: f64 = 8.0;

/// The questions that a solver asks of bodies. Vectors have an entry for each unknown, the inner ones first.
pub trait StiffnessOperator {
    /// Number of inner unknowns.
    fn inner(&self) -> usize;

    /// The unit of force per length of each unknown, positive: of the size of the diagonal of `A`.
    fn units(&self) -> &[f64];

    /// Entry `A[i, j]` between components `i` and `j` of `d` that belong to one pair, `i` not equal to `j`; 0 if
    /// it is not known.
    fn coupling(&self, _i: usize, _j: usize) -> f64 {
        0.0
    }

    /// `A x`.
    ///
    /// # Errors
    /// A failure in the host, told by a sentence on the matrix.
    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error>;

    /// `A (x + low) - b`, as exactly as it can be had; `low` is what rounding to doubles has left out of the inner
    /// unknowns, for bodies whose products are more exact than doubles.
    ///
    /// # Errors
    /// As [`Self::product`].
    fn residual(&self, x: &[f64], _low: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
        let mut residual = opposite(load);
        if x.iter().any(|x| *x != 0.0) {
            let product = self.product(x)?;
            residual.iter_mut().zip(product).for_each(|(sum, product)| *sum += product);
        }
        Ok(residual)
    }

    /// Bound on the sums of `A x` in which each entry of `x` has at most the given size: `|A| size`; without entries of `A`
    /// that of neighbours, and of the far field of a half space, beside the units.
    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        size.iter().zip(self.units()).map(|(size, unit)| NEIGHBOURS * size * unit).collect()
    }

    /// Returns `true` if [`Self::solve`] solves but for rounding, or has an inverse of which that is asked; otherwise it is
    /// a preconditioner, of which no accuracy is known.
    fn is_exact(&self) -> bool {
        true
    }

    /// Returns `true` if `A` is a sparse matrix: a product costs next to nothing beside a solution, and what is held
    /// has the springs of the held set too.
    fn is_sparse(&self) -> bool;

    /// Returns `true` if components can be held: whether [`Self::hold`] may be called.
    fn can_hold(&self) -> bool {
        true
    }

    /// The components that a factor holds which is there already.
    fn held_set(&self) -> Option<&HeldSet> {
        None
    }

    /// Makes what [`Self::solve`] needs to solve with these components held. `goes_on` is asked now and then while that
    /// lasts; `false`: it has ended it, or rounding leaves no factor, and nothing can be solved before another call.
    ///
    /// # Errors
    /// No memory, or what has failed in the host.
    fn hold(&mut self, _held: &HeldSet, _goes_on: GoesOn<'_>) -> Result<bool, Error> {
        Ok(true)
    }

    /// All unknowns `x` of a load case that ends: they may be asked for next.
    fn remember(&mut self, _load: &[f64], _x: &[f64]) {}

    /// An approximate solution `x` of `A x = forces`: with the components of the last [`Self::hold`], which `held` tells
    /// again, at zero, where forces on them do not count; without one with nothing held. `None` where `goes_on`, which is asked now and then, says no.
    ///
    /// # Errors
    /// As [`Self::product`].
    fn solve(&mut self, held: Option<&HeldSet>, forces: &[f64], goes_on: GoesOn<'_>) -> Solved;
}

/// The relation of such bodies, as far as it is known without their inner unknowns: the size of forces. What
/// needs more than that finds nothing certified by it.
///
/// With `x0` the displacements under all loads where those of the pairs are zero, `b = A x0 + (0, f)`. So the relative
/// loads `f` are what sums with the terms `|A| |x0|` leave, and doubles know them to `u |A| |x0|` alone, `u` the unit of
/// rounding: where loads act far from the contact, or cancel there, `f` may be zero, or rounding, of which a condensation would
/// make loads as large. This is the least size of forces, of which `eta` is a part: with a tolerance of 1e-10 an imbalance of
/// 1e-26 of all loads is seen.
#[derive(Clone, Debug)]
pub struct MatrixFree<'a> {
    units: Vec<f64>,
    /// `A[i, j]` of the two tangents of each pair.
    couplings: Vec<f64>,
    dim: usize,
    load: &'a [f64],
    /// The displacements of all unknowns where those of the pairs are zero.
    pub(crate) at_zero: &'a [f64],
    /// The rounding of the sums that give the loads.
    pub(crate) rounding: f64,
}

impl<'a> MatrixFree<'a> {
    /// Takes bodies with pairs of `dim` components, the relative load, and the displacements of all unknowns where those of the
    /// pairs are zero.
    pub fn new(
        bodies: &dyn StiffnessOperator,
        dim: usize,
        load: &'a [f64],
        at_zero: &'a [f64],
    ) -> Self {
        let units = bodies.units()[bodies.inner()..].to_vec();
        let couplings = match dim {
            2 => Vec::new(),
            _ => (0..load.len()).step_by(dim).map(|n| bodies.coupling(n + 1, n + 2)).collect(),
        };
        let rounding = UNIT * norm(&bodies.magnitude(&sizes(at_zero)));
        MatrixFree { units, couplings, dim, load, at_zero, rounding }
    }
}

impl Relation for MatrixFree<'_> {
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

    fn residual(&self, d: &[f64], _: &[f64]) -> Vec<f64> {
        vec![f64::INFINITY; d.len()]
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        vec![f64::INFINITY; size.len()]
    }

    fn size_of_force(&self, force: &[f64]) -> f64 {
        norm(force).max(self.rounding)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix that is not formed has unknown entries: no force follows from displacements, and every bound is
    /// infinite, so that nothing is certified.
    #[test]
    fn a_relation_that_is_not_formed_certifies_nothing() {
        let (units, couplings) = (vec![2.0, 3.0, 3.0], vec![0.5]);
        let (load, at_zero) = (&[1.0, 0.0, 0.0], &[0.0; 3]);
        let matrix_free = MatrixFree { units, couplings, dim: 3, load, at_zero, rounding: 0.0 };
        let d = [0.1, 0.2, 0.3];
        assert!(matrix_free.force(&d, &[]).is_none());
        assert_eq!(matrix_free.residual(&d, &d), [f64::INFINITY; 3]);
        assert_eq!(matrix_free.magnitude(&d), [f64::INFINITY; 3]);
        assert_eq!(
            (matrix_free.block(0, 0), matrix_free.block(0, 1), matrix_free.block(1, 2)),
            (2.0, 0.0, 0.5)
        );
    }
}
