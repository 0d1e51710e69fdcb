//! The flexibility form, as codes of rigid and multibody dynamics have it: a matrix that turns contact forces
//! into displacements,
//!
//! ```text
//! d = W F + q
//! ```
//!
//! `W` is symmetric and positive semi-definite. It may be singular: where pairs are redundant, as four feet
//! of a rigid table, some forces move nothing and `d` does not determine `F`. `q` are the free displacements:
//! those of the bodies without contact forces, relative to each other.
//!
//! Forces are compared with displacements by one unit of force per length for the normal of a pair, `1 / W_nn`,
//! and one for its tangents, one over the largest eigenvalue of its tangential block.

use std::iter::{once, repeat_n};

use super::arguments::{OF_MATRIX, dense, vector};
use super::contact::{ContactProblem, checked_dim, unknowns};
use super::friction_law::FrictionLaw;
use super::relation::{Redundant, Relation};
use super::symmetric_matrix;
use crate::error::{Argument, Error};
use crate::linalg::double_double::two_sum;
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector::{largest_eigenvalue, largest_of, norm, sizes};

/// Why a matrix of zeros is refused.
pub(super) const ZERO: &str =
    "W is zero: no contact force moves anything; hand over the flexibility of the bodies";

/// The caller's arrays of a problem in flexibility form, not yet checked. Forces and displacements are in the
/// caller's units; velocities and impulses may take their places.
#[derive(Clone, Copy, Debug)]
pub struct FlexibilityData<'a> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of contact pairs, 0 allowed.
    pub pairs: usize,
    /// `W`, `dim * pairs` columns of the same number of rows, column-major; length per force.
    pub flexibility: &'a [f64],
    /// Entries from the beginning of one column of `flexibility` to that of the next.
    pub ld: usize,
    /// `q`, the relative displacements without contact forces, `dim * pairs`; length.
    pub free: &'a [f64],
    /// Initial gaps, `pairs`; negative: interference, `+inf`: the pair never touches.
    pub gap: &'a [f64],
    /// The friction law.
    pub law: FrictionLaw<'a>,
    /// Reference slip, as in [`super::ContactData::reference_slip`].
    pub reference_slip: Option<&'a [f64]>,
}

/// The matrix `W`, as much as the relation needs of it.
pub trait FlexibilityMatrix {
    /// `W F`.
    fn times(&self, force: &[f64]) -> Vec<f64>;

    /// `W F - d`, in twice the precision and rounded once.
    fn times_less(&self, force: &[f64], d: &[f64]) -> Vec<f64>;
}

impl FlexibilityMatrix for Matrix<'_> {
    fn times(&self, force: &[f64]) -> Vec<f64> {
        self.product(force)
    }

    fn times_less(&self, force: &[f64], d: &[f64]) -> Vec<f64> {
        self.residual(force, &[], d, &self.magnitude(&sizes(force)))
    }
}

/// The relation `d = W F + q`: a view of the host's arrays. `W` is dense, or of another form that multiplies.
#[derive(Clone, Debug)]
pub struct Flexibility<'a, M = Matrix<'a>> {
    matrix: M,
    free: &'a [f64],
    /// Positive units of force per length, one for each component, the same for all tangents of a pair.
    units: Vec<f64>,
    /// Forces of the size that would undo the free displacements, pair by pair.
    load: Vec<f64>,
}

/// A contact problem in flexibility form.
pub type FlexibilityProblem<'a> = ContactProblem<'a, Flexibility<'a>>;

impl<'a> FlexibilityProblem<'a> {
    /// Checks the data.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first entry that is not finite, not symmetric beyond rounding (1e-9 of the
    /// diagonal), larger than its diagonal allows, negative on the diagonal or zero there in a row that is not
    /// zero, or out of range; a `W` of zeros. Rows of zeros are allowed: nothing moves these components.
    pub fn from_flexibility(data: FlexibilityData<'a>) -> Result<Self, Error> {
        let size = unknowns(checked_dim(data.dim)?, data.pairs)?;
        let matrix = Flexibility::checked_matrix(size, data.flexibility, data.ld)?;
        let free = vector(Argument::Load, "q", data.free, size)?;
        let relation = Flexibility::new(matrix, free, units(data.dim, &matrix));
        ContactProblem::with_relation(relation, data.dim, data.gap, data.law, data.reference_slip)
    }
}

impl<'a> Flexibility<'a> {
    /// A dense `W` of so many rows.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_flexibility`] of the matrix.
    pub(crate) fn checked_matrix(
        size: usize,
        w: &'a [f64],
        ld: usize,
    ) -> Result<Matrix<'a>, Error> {
        let matrix = dense("W", (w, ld), size, OF_MATRIX)?;
        symmetric_matrix::check_semi_definite(&matrix, "W", Argument::Matrix)?;
        if size > 0 && matrix.largest_diagonal() == 0.0 {
            return Err(Error::invalid(Argument::Matrix, ZERO));
        }
        Ok(matrix)
    }

    /// `W`.
    pub(crate) fn matrix(&self) -> Matrix<'a> {
        self.matrix
    }
}

impl<'a, M: FlexibilityMatrix> Flexibility<'a, M> {
    /// The relation with a checked matrix, free displacements and units of force per length, which must be those
    /// of the components of the matrix, or of a larger one that this is a part of.
    pub(crate) fn new(matrix: M, free: &'a [f64], units: Vec<f64>) -> Self {
        let load = units.iter().zip(free).map(|(unit, free)| unit * free).collect();
        Flexibility { matrix, free, units, load }
    }

    /// `W`, of any form.
    pub(crate) fn form(&self) -> &M {
        &self.matrix
    }

    /// `q`.
    pub(crate) fn free(&self) -> &'a [f64] {
        self.free
    }

    /// Units of force per length, one for each component.
    pub(crate) fn units(&self) -> &[f64] {
        &self.units
    }

    /// `W F + q`, in twice the precision and rounded once.
    pub(crate) fn relative(&self, force: &[f64]) -> Vec<f64> {
        let opposite: Vec<f64> = self.free.iter().map(|free| -free).collect();
        self.matrix.times_less(force, &opposite)
    }
}

fn units(dim: usize, matrix: &Matrix<'_>) -> Vec<f64> {
    let otherwise = matrix.largest_diagonal();
    let firsts = (0..matrix.size()).step_by(dim);
    let blocks = firsts.map(|first| matrix.block(first, dim));
    units_of_pairs(dim, blocks.map(|block| units_of_pair(&block, otherwise)))
}

/// The units of all components, from those of the normal and of the tangents of each pair.
pub(super) fn units_of_pairs(dim: usize, each: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
    each.flat_map(|[normal, tangent]| once(normal).chain(repeat_n(tangent, dim - 1))).collect()
}

/// The units of the normal and of the tangents of a pair with this block of `W`: `1 / W_nn`, and one over the
/// largest eigenvalue of the tangents. `otherwise` is the flexibility of a pair that nothing moves.
pub(super) fn units_of_pair(block: &Matrix<'_>, otherwise: f64) -> [f64; 2] {
    let (dim, t) = (block.size(), 1);
    let last = dim - 1;
    let largest = largest_eigenvalue(block.at(t, t), block.at(last, t), block.at(last, last));
    let largest = if dim == 2 { block.at(t, t) } else { largest };
    // A pair that only its normal force moves: its tangents have the unit of the normal.
    let softest = largest.max(block.unit(t, dim, otherwise));
    [1.0 / block.unit(0, dim, otherwise), 1.0 / softest]
}

impl<M: FlexibilityMatrix> Relation for Flexibility<'_, M> {
    fn size(&self) -> usize {
        self.units.len()
    }

    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.units[i] } else { 0.0 }
    }

    fn load(&self) -> &[f64] {
        &self.load
    }

    fn force(&self, _: &[f64], _: &[f64], _: &[f64]) -> Option<Vec<f64>> {
        None
    }

    /// The units times `d - q - W F`, in twice the precision and rounded once.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let (caused, lost): (Vec<f64>, Vec<f64>) =
            d.iter().zip(self.free).map(|(d, free)| two_sum(*d, -free)).unzip();
        let beyond = self.matrix.times_less(force, &caused);
        let of = |((beyond, lost), unit): ((f64, f64), &f64)| unit * (lost - beyond);
        beyond.into_iter().zip(lost).zip(&self.units).map(of).collect()
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        size.iter().zip(&self.units).map(|(size, unit)| unit * size).collect()
    }

    /// Forces that move nothing may be of any size, and would hide what is left of all others. So at most
    /// the units times `W F`.
    fn size_of_force(&self, force: &[f64]) -> f64 {
        let caused = self.matrix.times(force);
        let felt: Vec<f64> = caused.iter().zip(&self.units).map(|(d, unit)| unit * d).collect();
        norm(force).min(norm(&felt))
    }
}

impl Redundant for Flexibility<'_> {
    fn offset(&self) -> &[f64] {
        self.free
    }

    /// `W F = 0`.
    fn balance_each_other(&self, force: &[f64], within: f64) -> bool {
        let scaled = |values: Vec<f64>| {
            largest_of(values.iter().zip(&self.units).map(|(value, unit)| (unit * value).abs()))
        };
        let terms = scaled(self.matrix.magnitude(&sizes(force)));
        scaled(self.matrix.product(force)) <= within.max(ROUNDING_OF_SUM) * terms
    }
}
