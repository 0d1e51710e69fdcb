//! Units in which a problem has ordinary numbers.
//!
//! Methods multiply forces by forces and stiffnesses by displacements. Doubles hold such products where the
//! numbers are not too far from 1. A problem in other units is copied to units that differ by powers of two: its
//! numbers keep all their digits, and so do those of its solution on the way back.

use super::contact::ContactProblem;
use super::dependent_rows::{Dependence, DependentRows};
use super::flexibility::{Flexibility, FlexibilityMatrix};
use super::friction_law::{Law, Parameter};
use super::relation::{Redundant, Relation, Stiffness};
use super::sparse_flexibility::SparseW;
use crate::linalg::matrix::Matrix;
use crate::linalg::power_of_two::{exponent, times_power_of_two};

/// Powers of two, of a stiffness, a length and a force, up to which methods take a problem as it is: products of
/// four forces and of the squares of a condition number of 1e16 stay far from the ends of doubles, 2^±1022.
const ORDINARY: i32 = 128;

/// Powers of two that turn the host's numbers into ordinary ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Units {
    length: i32,
    force: i32,
}

/// The numbers of a problem in other units; `N` are those of its relation.
pub struct InUnits<N> {
    units: Units,
    gap: Vec<f64>,
    law: (Law, Vec<f64>),
    reference_slip: Vec<f64>,
    relation: N,
}

impl Units {
    /// Units in which the stiffnesses of a problem, the displacements that its data ask for and the forces that go
    /// with them are ordinary; `None` where they are as they stand.
    ///
    /// The powers of a stiffness are even, so that its square root has the same digits.
    pub fn of<R: Relation>(problem: &ContactProblem<'_, R>) -> Option<Self> {
        let relation = problem.relation();
        let units = (0..problem.unknowns()).map(|i| power(relation.block(i, i)));
        let (least, most) = range(units)?;
        let stiffness = least.midpoint(most) & !1;
        let asked = |i: usize| {
            let load = relation.load()[i];
            Some(power(load)? - power(relation.block(i, i))?)
        };
        let by_loads = (0..problem.unknowns()).map(asked);
        let gaps = (0..problem.pairs()).map(|pair| problem.gap(pair));
        let interferences = gaps.clone().filter(|gap| *gap < 0.0).map(power);
        let slips = problem.reference_slips().iter().map(|slip| power(*slip));
        let driven = range(by_loads.chain(interferences).chain(slips));
        let length = match driven.or_else(|| range(gaps.filter(|gap| gap.is_finite()).map(power))) {
            Some((_, most)) => most & !1,
            None => 0,
        };
        let is_far =
            [stiffness, length, stiffness + length].iter().any(|power| power.abs() > ORDINARY);
        is_far.then_some(Units { length: -length, force: -length - stiffness })
    }

    /// Lengths in these units; `None` where one is beyond doubles.
    pub fn lengths(self, values: &[f64]) -> Option<Vec<f64>> {
        all(values, self.length)
    }

    /// Forces in these units; `None` where one is beyond doubles.
    pub fn forces(self, values: &[f64]) -> Option<Vec<f64>> {
        all(values, self.force)
    }

    /// A length of these units in those of the host, rounded where it is among the smallest doubles; the largest
    /// double where it is beyond.
    pub fn host_length(self, value: f64) -> f64 {
        times_power_of_two(value, -self.length).clamp(-f64::MAX, f64::MAX)
    }

    /// A force of these units in those of the host, as [`Units::host_length`] a length.
    pub fn host_force(self, value: f64) -> f64 {
        times_power_of_two(value, -self.force).clamp(-f64::MAX, f64::MAX)
    }

    /// Returns `true` if lengths of these units keep all digits in those of the host.
    pub fn keeps_lengths(self, values: &[f64]) -> bool {
        all(values, -self.length).is_some()
    }

    /// Returns `true` if forces of these units keep all digits in those of the host.
    pub fn keeps_forces(self, values: &[f64]) -> bool {
        all(values, -self.force).is_some()
    }

    fn stiffness(self) -> i32 {
        self.force - self.length
    }
}

impl<N> InUnits<N> {
    /// The numbers of a problem in units in which they are ordinary; `None` where they are as they stand, or where
    /// one is beyond doubles there. A gap that is becomes `+inf`: nothing reaches it.
    pub fn of<R: ChangesUnits<Numbers = N>>(problem: &ContactProblem<'_, R>) -> Option<Self> {
        let units = Units::of(problem)?;
        let gap = |pair| {
            let gap = problem.gap(pair);
            let far = (gap > 0.0 && units.length > 0).then_some(f64::INFINITY);
            exactly(gap, units.length).or(far)
        };
        let law = problem.law();
        let meanings = law.law().parameters().iter().cycle();
        let parameters = law.values().iter().zip(meanings);
        let parameters = parameters.map(|(&value, (_, meaning))| match meaning {
            Parameter::Force => exactly(value, units.force),
            _ => Some(value),
        });
        Some(InUnits {
            units,
            gap: (0..problem.pairs()).map(gap).collect::<Option<_>>()?,
            law: (law.law(), parameters.collect::<Option<_>>()?),
            reference_slip: units.lengths(problem.reference_slips())?,
            relation: problem.relation().numbers(units)?,
        })
    }

    /// The units.
    pub fn units(&self) -> Units {
        self.units
    }

    /// The copy of `problem` in these units.
    pub fn problem<'b, R: ChangesUnits<Numbers = N>>(
        &'b self,
        problem: &'b ContactProblem<'_, R>,
    ) -> ContactProblem<'b, R::On<'b>> {
        let relation = R::on(&self.relation);
        let slip = Some(&*self.reference_slip).filter(|slip| !slip.is_empty());
        ContactProblem::with_relation(
            relation,
            problem.dim(),
            &self.gap,
            self.law.0.with(&self.law.1),
            slip,
        )
        .expect("powers of two change no sign and no quotient")
    }
}

/// A relation whose numbers can be copied to other units.
pub trait ChangesUnits: Relation {
    /// The numbers of the relation in other units, with what no unit changes.
    type Numbers;
    /// The relation on them.
    type On<'b>: Relation;

    /// The numbers in these units; `None` where one is beyond doubles.
    fn numbers(&self, units: Units) -> Option<Self::Numbers>;

    /// The relation on its numbers in other units.
    fn on(numbers: &Self::Numbers) -> Self::On<'_>;
}

impl<'a> ChangesUnits for Stiffness<'a> {
    /// `K` and `f`.
    type Numbers = (Stiffness<'a>, [Vec<f64>; 2]);
    type On<'b> = Stiffness<'b>;

    fn numbers(&self, units: Units) -> Option<Self::Numbers> {
        let numbers = [dense(&self.matrix, units.stiffness())?, units.forces(self.load)?];
        Some((*self, numbers))
    }

    fn on((host, [matrix, load]): &Self::Numbers) -> Stiffness<'_> {
        let size = host.size();
        let matrix = Matrix::new(size, matrix, size.max(1));
        let (symmetric, rounding) = (host.symmetric, host.rounding);
        Stiffness { symmetric, rounding, ..Stiffness::new(matrix, load, host.dim) }
    }
}

impl<M: FlexibilityInUnits> ChangesUnits for Flexibility<'_, M> {
    /// `W`, `q` and the units of the components.
    type Numbers = (M::Numbers, Vec<f64>, Vec<f64>);
    type On<'b> = Flexibility<'b, M::On<'b>>;

    fn numbers(&self, units: Units) -> Option<Self::Numbers> {
        let matrix = self.form().numbers(-units.stiffness())?;
        Some((matrix, units.lengths(self.free())?, all(self.units(), units.stiffness())?))
    }

    fn on((matrix, free, units): &Self::Numbers) -> Self::On<'_> {
        Flexibility::new(M::on(matrix), free, units.clone())
    }
}

/// A matrix of flexibility whose numbers can be copied to other units.
pub trait FlexibilityInUnits: FlexibilityMatrix {
    /// The numbers of the matrix in other units.
    type Numbers;
    /// The matrix on them.
    type On<'b>: FlexibilityMatrix;

    /// The numbers times a power of two; `None` where one is beyond doubles.
    fn numbers(&self, power: i32) -> Option<Self::Numbers>;

    /// The matrix on its numbers in other units.
    fn on(numbers: &Self::Numbers) -> Self::On<'_>;
}

impl FlexibilityInUnits for Matrix<'_> {
    type Numbers = (usize, Vec<f64>);
    type On<'b> = Matrix<'b>;

    fn numbers(&self, power: i32) -> Option<(usize, Vec<f64>)> {
        Some((self.size(), dense(self, power)?))
    }

    fn on((size, entries): &(usize, Vec<f64>)) -> Matrix<'_> {
        Matrix::new(*size, entries, (*size).max(1))
    }
}

impl FlexibilityInUnits for SparseW {
    type Numbers = SparseW;
    type On<'b> = SparseW;

    fn numbers(&self, power: i32) -> Option<SparseW> {
        self.with_values(|value| exactly(value, power))
    }

    fn on(numbers: &SparseW) -> SparseW {
        numbers.clone()
    }
}

impl<'a> ChangesUnits for DependentRows<'a> {
    /// `K`, `f` and `o`.
    type Numbers = (&'a Dependence, [Vec<f64>; 3]);
    type On<'b> = DependentRows<'b>;

    fn numbers(&self, units: Units) -> Option<Self::Numbers> {
        let matrix = dense(&self.stiffness(), units.stiffness())?;
        let (load, offset) = (self.variable_load(), self.offset());
        Some((self.dependence(), [matrix, units.forces(load)?, units.lengths(offset)?]))
    }

    fn on((dependence, [matrix, load, offset]): &Self::Numbers) -> DependentRows<'_> {
        DependentRows::new(dependence, (matrix, load), offset)
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

/// The least and the largest of the powers that there are.
fn range(powers: impl Iterator<Item = Option<i32>>) -> Option<(i32, i32)> {
    powers.flatten().fold(None, |range, power| {
        let (least, most) = range.unwrap_or((power, power));
        Some((power.min(least), power.max(most)))
    })
}

/// All numbers times a power of two; `None` where one is beyond doubles.
fn all(values: &[f64], power: i32) -> Option<Vec<f64>> {
    values.iter().map(|&value| exactly(value, power)).collect()
}

/// The entries of a matrix times a power of two, column-major.
fn dense(matrix: &Matrix<'_>, power: i32) -> Option<Vec<f64>> {
    let columns = (0..matrix.size()).flat_map(|j| matrix.column(j));
    columns.map(|&value| exactly(value, power)).collect()
}
