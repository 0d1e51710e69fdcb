//! The relation between the relative displacements `d` and the contact forces `F` of a problem.
//!
//! | form | relation | when |
//! |---|---|---|
//! | stiffness ([`Stiffness`]) | `K d = f + F` | rows of independent pairs |
//! | dependent rows | `d = C z + o`, `K z = f + Cᵀ F` | rows that depend on each other |
//! | flexibility | `d = W F + q` | a matrix of flexibility, which may be singular |
//!
//! The certificate measures a pair `(d, F)` on any form. In the stiffness form `d` determines `F`; in
//! others it does not, so that a candidate carries both.

use super::remembered::Remembered;
use crate::linalg::matrix::{Matrix, Residual};
use crate::linalg::vector::norm;

/// A linear relation between `d` and `F`, from the host's data alone. Components are ordered pair by
/// pair, `D` for each.
pub trait Relation {
    /// Number of components of `d`, and of `F`.
    fn size(&self) -> usize {
        self.load().len()
    }

    /// Entry of the symmetric positive definite `D x D` block, a force per length, that turns
    /// displacements of a pair into forces of the size that the relation has: `K` itself, or another
    /// one that is diagonal. `i` and `j` are components of one pair.
    fn block(&self, i: usize, j: usize) -> f64;

    /// The loads, in the unit of force: what drives the problem, and the size of forces.
    fn load(&self) -> &[f64];

    /// The contact force that `d + low` determines, with [`Self::magnitude`] of `|d|`; `None` if it determines none. `low`
    /// is empty, or what rounding to doubles has left out of `d`.
    fn force(&self, _d: &[f64], _low: &[f64]) -> Option<Residual> {
        None
    }

    /// How far `(d, F)` is from equilibrium, a force for each component: zero if the relation holds.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64>;

    /// Bound on the sums of the relation in which each component of `d` has at most the given size:
    /// `|K| size`.
    fn magnitude(&self, size: &[f64]) -> Vec<f64>;

    /// The size of forces, with which other forces are compared: their norm, or the norm of the part that moves
    /// anything, if that is less.
    fn size_of_force(&self, force: &[f64]) -> f64 {
        norm(force)
    }
}

/// A relation in which some forces may move nothing: they balance each other.
pub(crate) trait Redundant: Relation {
    /// Displacements to which forces add what they cause: `p . d = p . offset` for all forces `p` that balance
    /// each other.
    fn offset(&self) -> &[f64];

    /// Returns `true` if forces balance each other, up to rounding or the part `within` of their terms.
    fn balance_each_other(&self, force: &[f64], within: f64) -> bool;
}

/// The stiffness form `K d = f + F`, with `K` dense, symmetric and positive semi-definite, or positive
/// definite alone: a view of the host's arrays.
#[derive(Clone, Copy, Debug)]
pub struct Stiffness<'a> {
    pub(super) matrix: Matrix<'a>,
    pub(super) load: &'a [f64],
    pub(super) symmetric: bool,
    /// Components of a pair.
    pub(super) dim: usize,
    /// Largest diagonal entry.
    pub(crate) largest: f64,
    /// Energy of a motion that rounding of the entries explains, of `|d| . |K| |d|`.
    pub(crate) rounding: f64,
    /// A basis of the motions that nothing resists, where it is known better than the rounding of `K` tells; `None`: not.
    pub(crate) free_motions: Option<&'a [Vec<f64>]>,
    /// The rounding of the sums that give the loads, in the norm; 0 of loads that are given.
    pub(crate) rounding_of_load: f64,
    /// The factors that earlier problems with this matrix have left.
    pub(super) remembered: Option<&'a Remembered>,
}

/// [`Stiffness::rounding`] of a matrix that a host gives without a word on its origin, where its components
/// are few. Rounding each entry once explains half of it; a definite matrix of condition 1e15 resists with
/// 4.5 times as much or more. A host that sums many terms to an entry hands over a model.
/// So it is an epsilon for so many components, and grows with their number: entries that a host has condensed from
/// a mesh took as many operations (6 times as much on 66 components, measured).
const COMPONENTS_A_UNIT: f64 = 8.0;

impl<'a> Stiffness<'a> {
    /// The relation of pairs of `dim` components, with a symmetric matrix.
    pub(crate) fn new(matrix: Matrix<'a>, load: &'a [f64], dim: usize) -> Self {
        Stiffness {
            matrix,
            load,
            symmetric: true,
            dim,
            largest: matrix.largest_diagonal(),
            rounding: f64::EPSILON * (matrix.size() as f64 / COMPONENTS_A_UNIT).max(1.0),
            free_motions: None,
            rounding_of_load: 0.0,
            remembered: None,
        }
    }

    /// The unit of force per length of component `i`, positive: `K[i, i]`, or one of the pair, or of the
    /// whole, where nothing resists the component.
    pub(super) fn unit(&self, i: usize) -> f64 {
        self.matrix.unit(i, self.dim, self.largest)
    }

    /// Adds to the terms of displacements those of components that nothing resists: such a one counts with its unit. What
    /// it was condensed from has such stiffnesses, whose sums are zero.
    fn add_unresisted(&self, d: &[f64], terms: &mut [f64]) {
        for (j, terms) in terms.iter_mut().enumerate() {
            if self.matrix.at(j, j) == 0.0 {
                *terms += self.unit(j) * d[j].abs();
            }
        }
    }
}

impl Relation for Stiffness<'_> {
    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.unit(i) } else { self.matrix.at(i, j) }
    }

    fn load(&self) -> &[f64] {
        self.load
    }

    /// `K (d + low) - f`, in twice the precision and rounded once.
    fn force(&self, d: &[f64], low: &[f64]) -> Option<Residual> {
        let mut force = self.matrix.residual_and_terms(d, low, self.load);
        self.add_unresisted(d, &mut force.terms);
        Some(force)
    }

    /// `K d - f - F`.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let mut residual: Vec<f64> =
            self.load.iter().zip(force).map(|(f, force)| -f - force).collect();
        self.matrix.add_product(d, &mut residual);
        residual
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        let mut sum = self.matrix.magnitude(size);
        self.add_unresisted(size, &mut sum);
        sum
    }
}
