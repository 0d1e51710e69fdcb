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

use std::borrow::Cow;
use std::ops::Range;

use super::arguments::{OF_MATRIX, checked_dim, dense, unknowns, vector};
use super::contact::ContactProblem;
use super::flexibility_form::FlexibilityForm;
use super::friction_law::FrictionLaw;
use super::relation::{Redundant, Relation};
use super::sparse_flexibility::ZERO;
use super::symmetric_matrix;
use crate::error::{Argument, Error};
use crate::linalg::double_double::two_sum;
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector::{largest_of, norm, norm_of, opposite, sizes};

/// The caller's arrays of a problem in flexibility form, not yet checked. Forces and displacements are in the
/// caller's units; velocities and impulses may take their places. A dense matrix is given column-major, with the entries
/// from the beginning of one column to that of the next; a sparse one as a [`crate::reduce::SparseMatrix`], of which rows of
/// zeros need not be stored.
#[derive(Clone, Copy, Debug)]
pub struct FlexibilityData<'a, W = (&'a [f64], usize)> {
    /// Space dimension, 2 or 3.
    pub dim: usize,
    /// Number of contact pairs, 0 allowed.
    pub pairs: usize,
    /// `W`, `dim * pairs` columns of the same number of rows; length per force.
    pub flexibility: W,
    /// `q`, the relative displacements without contact forces, `dim * pairs`; length.
    pub free: &'a [f64],
    /// Initial gaps, `pairs`; negative: interference, `+inf`: the pair never touches.
    pub gap: &'a [f64],
    /// The friction law.
    pub law: FrictionLaw<'a>,
    /// Reference slip, as in [`super::ContactData::reference_slip`].
    pub reference_slip: Option<&'a [f64]>,
}

/// The relation `d = W F + q`: a view of the host's arrays.
#[derive(Clone, Debug)]
pub struct Flexibility<'a> {
    pub(crate) form: FlexibilityForm<'a>,
    /// `q`.
    pub(crate) free: &'a [f64],
    /// Positive units of force per length, one for each component, the same for all tangents of a pair.
    units: Cow<'a, [f64]>,
    /// Forces of the size that would undo the free displacements, pair by pair.
    load: Cow<'a, [f64]>,
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
        let matrix = Flexibility::checked_matrix(size, data.flexibility)?;
        let form = FlexibilityForm::Dense(matrix);
        Self::with_form(form, data.dim, data.free, (data.gap, data.law, data.reference_slip))
    }

    /// A problem with a checked `W`, of pairs of `dim` components; gaps, law and reference slip as in
    /// [`FlexibilityData`].
    ///
    /// # Errors
    /// [`Error::Invalid`]: the first entry of an array that is out of range.
    pub(crate) fn with_form(
        form: FlexibilityForm<'a>,
        dim: usize,
        free: &'a [f64],
        (gap, law, reference_slip): (&'a [f64], FrictionLaw<'a>, Option<&'a [f64]>),
    ) -> Result<Self, Error> {
        let units = form.units(dim);
        let free = vector(("q", Argument::Load), free, units.len())?;
        let relation = Flexibility::new(form, free, units);
        ContactProblem::with_relation(relation, dim, gap, law, reference_slip)
    }
}

impl<'a> Flexibility<'a> {
    /// A dense `W` of so many rows.
    ///
    /// # Errors
    /// As [`FlexibilityProblem::from_flexibility`] of the matrix.
    pub(crate) fn checked_matrix(size: usize, w: (&'a [f64], usize)) -> Result<Matrix<'a>, Error> {
        let matrix = dense("W", w, size, OF_MATRIX)?;
        let root = matrix.diagonal_roots();
        symmetric_matrix::check_beside(&matrix, &root, ("W", Argument::Matrix))?;
        if size > 0 && matrix.largest_diagonal() == 0.0 {
            return Argument::Matrix.refuse(ZERO);
        }
        Ok(matrix)
    }

    /// A dense `W`, as that of an island is.
    pub(crate) fn matrix(&self) -> Matrix<'a> {
        match self.form {
            FlexibilityForm::Dense(matrix) => matrix,
            FlexibilityForm::Sparse(_) => unreachable!("islands are dense"),
        }
    }

    /// The relation with a checked matrix, free displacements and units of force per length, which must be those
    /// of the components of the matrix, or of a larger one that this is a part of.
    pub(crate) fn new(form: FlexibilityForm<'a>, free: &'a [f64], units: Vec<f64>) -> Self {
        let load = units.iter().zip(free).map(|(unit, free)| unit * free).collect();
        Flexibility { form, free, units: Cow::Owned(units), load: Cow::Owned(load) }
    }

    /// The relation of the components `part` of one whose components have this one's in another order, with their `W`.
    pub(crate) fn on_part(&'a self, matrix: Matrix<'a>, part: Range<usize>) -> Self {
        Flexibility {
            form: FlexibilityForm::Dense(matrix),
            free: &self.free[part.clone()],
            units: Cow::Borrowed(&self.units[part.clone()]),
            load: Cow::Borrowed(&self.load[part]),
        }
    }

    /// Units of force per length, one for each component.
    pub(crate) fn units(&self) -> &[f64] {
        &self.units
    }

    /// `W F + q`, in twice the precision and rounded once.
    pub(crate) fn relative(&self, force: &[f64]) -> Vec<f64> {
        self.form.times_less(force, &opposite(self.free))
    }
}

impl Relation for Flexibility<'_> {
    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.units[i] } else { 0.0 }
    }

    fn load(&self) -> &[f64] {
        &self.load
    }

    /// The units times `d - q - W F`, in twice the precision and rounded once.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let (caused, lost): (Vec<f64>, Vec<f64>) =
            d.iter().zip(self.free).map(|(d, free)| two_sum(*d, -free)).unzip();
        let beyond = self.form.times_less(force, &caused);
        let of = |((beyond, lost), unit): ((f64, f64), &f64)| unit * (lost - beyond);
        beyond.into_iter().zip(lost).zip(self.units()).map(of).collect()
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        size.iter().zip(self.units()).map(|(size, unit)| unit * size).collect()
    }

    /// Forces that move nothing may be of any size, and would hide what is left of all others. So at most
    /// the units times `W F`.
    fn size_of_force(&self, force: &[f64]) -> f64 {
        let caused = self.form.times(force);
        let felt = norm_of(caused.iter().zip(self.units()).map(|(d, unit)| unit * d));
        norm(force).min(felt)
    }
}

impl Redundant for Flexibility<'_> {
    fn offset(&self) -> &[f64] {
        self.free
    }

    /// `W F = 0`.
    fn balance_each_other(&self, force: &[f64], within: f64) -> bool {
        let scaled = |values: Vec<f64>| {
            largest_of(values.iter().zip(self.units()).map(|(value, unit)| (unit * value).abs()))
        };
        let terms = scaled(self.matrix().magnitude(&sizes(force)));
        scaled(self.form.times(force)) <= within.max(ROUNDING_OF_SUM) * terms
    }
}
