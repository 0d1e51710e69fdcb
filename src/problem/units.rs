//! Units in which a problem has ordinary numbers.
//!
//! Methods multiply forces by forces and stiffnesses by displacements. Doubles hold such products where the
//! numbers are not too far from 1. A problem in other units is copied to units that differ by powers of two: its
//! numbers keep all their digits, and so do those of its solution on the way back.

use std::borrow::Cow;

use super::contact::ContactProblem;
use super::dependent_rows::DependentRows;
use super::flexibility::Flexibility;
use super::flexibility_form::FlexibilityForm;
use super::law_table::Parameter;
use super::relation::{Redundant, Relation, Stiffness};
use crate::linalg::matrix::Matrix;
use crate::linalg::power_of_two::{exponent, times_power_of_two};
use crate::linalg::vector::{largest_of, norm_inf};

/// Powers of two, of a stiffness, a length and a force, up to which methods take a problem as it is: products of
/// four forces and of the squares of a condition number of 1e16 stay far from the ends of doubles, 2^±1022.
const ORDINARY: i32 = 128;

/// A power of two that turns the host's numbers into ordinary ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit(i32);

impl Unit {
    /// The host's numbers in this unit; `None` where one is beyond doubles.
    pub fn all(self, values: &[f64]) -> Option<Vec<f64>> {
        all(values, self.0)
    }

    /// A number of this unit in that of the host, rounded where it is among the smallest doubles; the largest double
    /// where it is beyond.
    pub fn host(self, value: f64) -> f64 {
        times_power_of_two(value, -self.0).clamp(-f64::MAX, f64::MAX)
    }

    /// Returns `true` if numbers of this unit keep all digits in that of the host.
    pub fn keeps(self, values: &[f64]) -> bool {
        all(values, -self.0).is_some()
    }
}

/// The units of lengths and of forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Units {
    pub length: Unit,
    pub force: Unit,
}

impl Units {
    /// Units in which the stiffnesses of a problem, the displacements that its data ask for and the forces that go
    /// with them are ordinary; `None` where they are as they stand.
    ///
    /// The powers of a stiffness are even, so that its square root has the same digits.
    pub fn of<R: Relation>(problem: &ContactProblem<'_, R>) -> Option<Self> {
        let (mut least, mut most, mut asked) = (i32::MAX, i32::MIN, None);
        for (i, &load) in problem.relation().load().iter().enumerate() {
            let Some(stiffness) = power(problem.unit(i)) else { continue };
            (least, most) = (least.min(stiffness), most.max(stiffness));
            asked = asked.max(power(load).map(|force| force - stiffness));
        }
        if least > most {
            return None;
        }
        let stiffness = least.midpoint(most) & !1;
        let gaps = (0..problem.pairs()).map(|pair| problem.gap(pair)).filter(|gap| gap.is_finite());
        let interference = power(largest_of(gaps.clone().map(|gap| gap.min(0.0))));
        let moved = power(problem.reference_slips().map_or(0.0, norm_inf));
        let driven = [asked, interference, moved].into_iter().max().flatten();
        let length = driven.or_else(|| power(largest_of(gaps))).unwrap_or(0) & !1;
        let is_far =
            [stiffness, length, stiffness + length].iter().any(|power| power.abs() > ORDINARY);
        is_far.then_some(Units { length: Unit(-length), force: Unit(-length - stiffness) })
    }

    fn stiffness(self) -> i32 {
        self.force.0 - self.length.0
    }
}

/// Does work on a copy of a problem in units in which its numbers are ordinary; `None` where they are as they stand,
/// or where one is beyond doubles there. A gap that is becomes `+inf`: nothing reaches it.
pub fn in_units<R: ChangesUnits, T>(
    problem: &ContactProblem<'_, R>,
    work: impl FnOnce(Units, &ContactProblem<'_, R::On<'_>>) -> T,
) -> Option<T> {
    let units = Units::of(problem)?;
    let gap = |pair| {
        let gap = problem.gap(pair);
        let is_far = gap > 0.0 && units.length.0 > 0 && !problem.is_tied(pair);
        let far = is_far.then_some(f64::INFINITY);
        exactly(gap, units.length.0).or(far)
    };
    let gap: Vec<f64> = (0..problem.pairs()).map(gap).collect::<Option<_>>()?;
    let law = problem.law();
    let parameters = law.each().map(|(meaning, value)| match meaning {
        Parameter::Force => exactly(value, units.force.0),
        _ => Some(value),
    });
    let parameters: Vec<f64> = parameters.collect::<Option<_>>()?;
    let slip = match problem.reference_slips() {
        Some(slip) => Some(units.length.all(slip)?),
        None => None,
    };
    problem.relation().in_units(units, |relation| {
        let (law, slip) = (law.law().with(&parameters), slip.as_deref());
        let problem = ContactProblem::with_relation(relation, problem.dim(), &gap, law, slip);
        work(units, &problem.expect("powers of two change no sign and no quotient"))
    })
}

/// A relation whose numbers can be copied to other units.
pub trait ChangesUnits: Relation {
    /// The relation on such numbers.
    type On<'b>: Relation;

    /// Does work on the relation in these units; `None` where a number is beyond doubles.
    fn in_units<T>(&self, units: Units, work: impl FnOnce(Self::On<'_>) -> T) -> Option<T>;
}

impl ChangesUnits for Stiffness<'_> {
    type On<'b> = Stiffness<'b>;

    fn in_units<T>(&self, units: Units, work: impl FnOnce(Stiffness<'_>) -> T) -> Option<T> {
        let matrix = all(self.matrix.to_vec(), units.stiffness())?;
        let load = units.force.all(self.load)?;
        let matrix = Matrix::contiguous(self.size(), &matrix);
        let Stiffness { symmetric, rounding, .. } = *self;
        let scaled = Stiffness::new(matrix, &load, self.dim);
        Some(work(Stiffness { symmetric, rounding, ..scaled }))
    }
}

impl ChangesUnits for Flexibility<'_> {
    type On<'b> = Flexibility<'b>;

    fn in_units<T>(&self, units: Units, work: impl FnOnce(Flexibility<'_>) -> T) -> Option<T> {
        let entries;
        let form = match &self.form {
            FlexibilityForm::Dense(matrix) => {
                entries = all(matrix.to_vec(), -units.stiffness())?;
                FlexibilityForm::Dense(Matrix::contiguous(matrix.size(), &entries))
            }
            FlexibilityForm::Sparse(matrix) => {
                let value = |value| exactly(value, -units.stiffness());
                FlexibilityForm::Sparse(Cow::Owned(matrix.with_values(value)?))
            }
        };
        let (free, of_components) =
            (units.length.all(self.free)?, all(self.units(), units.stiffness())?);
        Some(work(Flexibility::new(form, &free, of_components)))
    }
}

impl ChangesUnits for DependentRows<'_> {
    type On<'b> = DependentRows<'b>;

    fn in_units<T>(&self, units: Units, work: impl FnOnce(DependentRows<'_>) -> T) -> Option<T> {
        let matrix = all(self.stiffness.to_vec(), units.stiffness())?;
        let (load, offset) = (units.force.all(self.load)?, units.length.all(self.offset())?);
        let of_rigid = exactly(self.of_rigid, units.stiffness())?;
        Some(work(DependentRows::new(self.dependence, (&matrix, &load), &offset, of_rigid)))
    }
}

/// The power of two of a number; `None` of zero, and of what is not finite.
fn power(value: f64) -> Option<i32> {
    (value != 0.0 && value.is_finite()).then(|| exponent(value))
}

/// A number times a power of two; `None` where that is beyond doubles. Infinity stays.
fn exactly(value: f64, power: i32) -> Option<f64> {
    let product = times_power_of_two(value, power);
    (times_power_of_two(product, -power) == value).then_some(product)
}

/// All numbers times a power of two; `None` where one is beyond doubles.
fn all(values: impl Into<Vec<f64>>, power: i32) -> Option<Vec<f64>> {
    let mut values = values.into();
    for value in &mut values {
        *value = exactly(*value, power)?;
    }
    Some(values)
}
