//! The contact problem in relative displacements: the only thing that a contact solver sees.
//!
//! For `n` pairs in dimension `D`, ordered pair by pair as (n, t) or (n, t1, t2):
//!
//! ```text
//! K d = f + F
//! d_n <= gap,  F_n <= 0,  (d_n - gap) F_n = 0                            (paper, 5 and 8)
//! |F_t| <= mu |F_n|,  d_t = slip0 inside the cone,
//!                     d_t - slip0 = -lambda F_t, lambda >= 0, on it        (paper, 6 and 9)
//! ```
//!
//! Other laws: [`FrictionLaw`]. `K` is symmetric and positive semi-definite: bodies that only contact
//! supports are allowed. What the data mean for the forces is in the room [`crate::law`].

use super::arguments::{OF_MATRIX, check_gaps, check_length, checked_dim, dense, unknowns, vector};
use super::contact_data::ContactData;
use super::friction_law::FrictionLaw;
use super::relation::{Relation, Stiffness};
use super::remembered::Remembered;
use super::symmetric_matrix;
use crate::error::{Argument, Error, entry};
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::{CONDENSATION, FREE};
use crate::linalg::vector::{largest_eigenvalue, sizes};

/// A checked contact problem, a view of the caller's arrays. `R` is the form of the relation between
/// displacements and contact forces.
#[derive(Clone, Copy, Debug)]
pub struct ContactProblem<'a, R = Stiffness<'a>> {
    relation: R,
    dim: usize,
    gap: &'a [f64],
    law: FrictionLaw<'a>,
    reference_slip: Option<&'a [f64]>,
    /// Which pairs of the host's problem these are, and how many that has; `None`: all of them.
    host: Option<(&'a [usize], usize)>,
}

impl<'a> ContactProblem<'a> {
    /// Checks the data.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first entry that is not finite, not symmetric beyond rounding
    /// (1e-9 of the diagonal), negative on the diagonal or zero there in a row that is not zero by more than
    /// a condensation leaves, 9e-12 of the pair's, or out of range. Small entries on the diagonal are taken as they
    /// are; a [`crate::Model`] tells them from rounding.
    pub fn new(data: ContactData<'a>) -> Result<Self, Error> {
        let problem = Self::on_checked_matrix(data)?;
        symmetric_matrix::check(&problem.relation.matrix, data.dim, ("K", Argument::Matrix))?;
        Ok(problem)
    }

    /// The problem of a test with the stiffness and the loads of valid data; gaps, law and reference slips as there.
    #[cfg(test)]
    pub(crate) fn of_test(
        dim: usize,
        (stiffness, load): (&'a [f64], &'a [f64]),
        (gap, law, reference_slip): (&'a [f64], FrictionLaw<'a>, Option<&'a [f64]>),
    ) -> Self {
        let (pairs, ld) = (gap.len(), load.len());
        let data = ContactData { dim, pairs, stiffness, ld, load, gap, law, reference_slip };
        Self::new(data).expect("valid data")
    }

    /// A problem in 3D whose `K` need not be symmetric, as where a host's material or load follows the
    /// motion: `x . K x > 0` for all `x` is all that [`crate::Method::Path`] asks for. It is not checked.
    /// [`crate::Method::Newton`], `Path` and `Auto` solve it; nothing is proved about it.
    ///
    /// # Errors
    /// As [`Self::new`], but for the symmetry; [`Error::Invalid`] too if the dimension is 2.
    pub fn unsymmetric(data: ContactData<'a>) -> Result<Self, Error> {
        let mut problem = Self::on_checked_matrix(data)?;
        if problem.dim == 2 {
            let wrong = "dim is 2: a matrix that is not symmetric is for dim 3";
            return Argument::Dimension.refuse(wrong);
        }
        symmetric_matrix::check_diagonal(&problem.relation.matrix, ("K", Argument::Matrix))?;
        let matrix = problem.relation.matrix;
        if let Some(i) = (0..matrix.size()).find(|&i| matrix.at(i, i) == 0.0) {
            let place = entry("K", [i, i]);
            return Argument::Matrix.refuse(format!("{place} is 0, it must be positive"));
        }
        problem.relation.symmetric = false;
        Ok(problem)
    }

    /// Returns `true` if `K` is symmetric.
    pub(crate) fn is_symmetric(&self) -> bool {
        self.relation.symmetric
    }

    /// Checks everything but the entries of the matrix, which a model has checked once.
    pub(crate) fn on_checked_matrix(data: ContactData<'a>) -> Result<Self, Error> {
        let size = unknowns(checked_dim(data.dim)?, data.pairs)?;
        let matrix = dense("K", (data.stiffness, data.ld), size, OF_MATRIX)?;
        let load = vector(("f", Argument::Load), data.load, size)?;
        Self::with_relation(
            Stiffness::new(matrix, load, data.dim),
            data.dim,
            data.gap,
            data.law,
            data.reference_slip,
        )
    }

    /// Tells the problem that a host has condensed its matrix: an energy of the size of that rounding counts as
    /// no resistance.
    pub(crate) fn condensed_by_host(mut self) -> Self {
        self.relation.rounding = FREE * CONDENSATION;
        self
    }

    /// Makes the problem one of several with this matrix. It uses the factors that earlier problems have left, and
    /// leaves its own.
    pub(crate) fn remembering(mut self, remembered: Option<&'a Remembered>) -> Self {
        self.relation.remembered = remembered;
        self
    }

    /// The factors that earlier problems with this matrix have left; `None`: this problem stands alone.
    pub(crate) fn remembered(&self) -> Option<&'a Remembered> {
        self.relation.remembered
    }

    /// `K`.
    pub(crate) fn stiffness(&self) -> Matrix<'a> {
        self.relation.matrix
    }

    /// The problem of some of the pairs, with the block of `K` and the data that are theirs.
    pub(crate) fn on_part<'b>(
        &self,
        matrix: Matrix<'b>,
        load: &'b [f64],
        (gap, law, slip): (&'b [f64], FrictionLaw<'b>, &'b [f64]),
    ) -> ContactProblem<'b> {
        let Stiffness { symmetric, rounding, largest, .. } = self.relation;
        let mut relation =
            Stiffness { symmetric, rounding, ..Stiffness::new(matrix, load, self.dim) };
        // The rest may hold a part that has no stiffness of its own.
        if relation.largest == 0.0 {
            relation.largest = largest;
        }
        let (dim, reference_slip) = (self.dim, Some(slip));
        ContactProblem { relation, dim, gap, law, reference_slip, host: None }
    }

    /// Tells the problem which of the `count` pairs of the host's problem its pairs are, for words.
    pub(crate) fn of_host(mut self, pairs: &'a [usize], count: usize) -> Self {
        self.host = Some((pairs, count));
        self
    }

    /// Copies the problem with other gaps, one for each pair.
    pub(crate) fn with_gaps<'b>(&self, gap: &'b [f64]) -> ContactProblem<'b>
    where
        'a: 'b,
    {
        ContactProblem { gap, ..*self }
    }

    /// Column `j` of `K`.
    pub fn column(&self, j: usize) -> &'a [f64] {
        self.relation.matrix.column(j)
    }

    /// The units beside which a host's condensation has rounded `K`.
    pub(crate) fn units_of_condensation(&self) -> Vec<f64> {
        self.relation.matrix.units_of_condensation(self.dim)
    }

    /// `f`.
    pub fn load(&self) -> &'a [f64] {
        self.relation.load
    }

    /// Contact force that equilibrium at `d` needs: `K d - f`.
    pub fn force(&self, d: &[f64]) -> Vec<f64> {
        self.relation.matrix.product_less(d, self.relation.load)
    }

    /// Internal force `K d`, in twice the precision and rounded once.
    pub fn internal_force(&self, d: &[f64]) -> Vec<f64> {
        let terms = self.relation.matrix.magnitude(&sizes(d));
        self.relation.matrix.residual(d, &[], &vec![0.0; d.len()], &terms)
    }

    /// `K (d + low) - f`, in twice the precision and rounded once; `low` is what rounding to doubles has
    /// left out of `d`.
    pub(crate) fn force_of_parts(&self, d: &[f64], low: &[f64]) -> Vec<f64> {
        let terms = self.relation.matrix.magnitude(&sizes(d));
        self.relation.matrix.residual(d, low, self.relation.load, &terms)
    }
}

impl<'a, R: Relation> ContactProblem<'a, R> {
    /// The contact problem of pairs in dimension `dim` on any relation of `dim * pairs` components;
    /// other arguments as in [`ContactData`].
    ///
    /// # Errors
    /// [`Error::Invalid`] names the array of a wrong length, or the first entry out of range.
    pub fn with_relation(
        relation: R,
        dim: usize,
        gap: &'a [f64],
        law: FrictionLaw<'a>,
        reference_slip: Option<&'a [f64]>,
    ) -> Result<Self, Error> {
        checked_dim(dim)?;
        let pairs = relation.size() / dim;
        if dim * pairs != relation.size() {
            let components = relation.size();
            return Argument::Size.refuse(format!("{components} components are no pairs of {dim}"));
        }
        check_length(("gap", Argument::Gap), gap.len(), pairs)?;
        let parameters = law.parameters() * pairs;
        check_length(("friction", Argument::Law), law.values().len(), parameters)?;
        let slips = (dim - 1) * pairs;
        let reference_slip = reference_slip
            .map(|slip| vector(("slip0", Argument::ReferenceSlip), slip, slips))
            .transpose()?;
        let (gap, law) = (&gap[..pairs], law.with_values(&law.values()[..parameters]));
        check_gaps(gap)?;
        law.check(dim)?;
        Ok(ContactProblem { relation, dim, gap, law, reference_slip, host: None })
    }

    /// Copies the problem with another law, whose parameters fit its pairs.
    pub(crate) fn with_law(&self, law: FrictionLaw<'a>) -> Self
    where
        R: Clone,
    {
        ContactProblem { relation: self.relation.clone(), law, ..*self }
    }

    /// The relation between displacements and contact forces.
    pub fn relation(&self) -> &R {
        &self.relation
    }

    /// Components of a pair: the space dimension `D`, 2 or 3.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// Number of contact pairs.
    pub fn pairs(&self) -> usize {
        self.gap.len()
    }

    /// Which pair of the host's problem a pair is.
    pub(crate) fn host_pair(&self, pair: usize) -> usize {
        self.host.map_or(pair, |(pairs, _)| pairs[pair])
    }

    /// Number of pairs of the host's problem.
    pub(crate) fn host_pairs(&self) -> usize {
        self.host.map_or(self.pairs(), |(_, count)| count)
    }

    /// Number of unknowns, `D` for each pair.
    pub fn unknowns(&self) -> usize {
        self.dim * self.gap.len()
    }

    /// The unit of force per length of component `i`, positive: `K[i, i]`; where nothing resists the
    /// component, the largest diagonal entry of its pair, or of the whole.
    pub fn unit(&self, i: usize) -> f64 {
        self.relation.block(i, i)
    }

    /// Square roots of the units of all components.
    pub fn unit_roots(&self) -> Vec<f64> {
        (0..self.unknowns()).map(|i| self.unit(i).sqrt()).collect()
    }

    /// Force per length of the tangential components of a pair: the largest eigenvalue of their block.
    pub fn tangential_stiffness(&self, pair: usize) -> f64 {
        let [first, mixed, second] = self.tangential_block(pair);
        if self.dim == 2 { first } else { largest_eigenvalue(first, mixed, second) }
    }

    /// The block of the tangential components of a pair, `[[a, b], [b, c]]` as `[a, b, c]`; in the plane `[a, 0, 0]`.
    pub fn tangential_block(&self, pair: usize) -> [f64; 3] {
        let first = self.dim * pair + 1;
        let entry = |i: usize, j: usize| self.relation.block(first + i, first + j);
        match self.dim {
            2 => [entry(0, 0), 0.0, 0.0],
            _ => [entry(0, 0), entry(1, 0), entry(1, 1)],
        }
    }

    /// Copies the problem with another symmetric matrix, loads and reference slips, of the same sizes.
    pub(crate) fn with_numbers<'b>(
        &self,
        matrix: Matrix<'b>,
        load: &'b [f64],
        reference_slip: Option<&'b [f64]>,
    ) -> ContactProblem<'b>
    where
        'a: 'b,
    {
        let (dim, gap, law, host) = (self.dim, self.gap, self.law, self.host);
        let relation = Stiffness::new(matrix, load, dim);
        ContactProblem { relation, dim, gap, law, reference_slip, host }
    }

    /// Gap of a pair, `+inf` if it never touches.
    pub fn gap(&self, pair: usize) -> f64 {
        self.gap[pair]
    }

    /// The friction law.
    pub fn law(&self) -> FrictionLaw<'a> {
        self.law
    }

    /// Returns `true` if a pair is tied.
    pub fn is_tied(&self, pair: usize) -> bool {
        self.law.is_tied(pair, self.gap[pair])
    }

    /// All reference slips, pair by pair; `None` if they are zero.
    pub(crate) fn reference_slips(&self) -> Option<&'a [f64]> {
        self.reference_slip
    }

    /// Reference slip of a pair; `component` counts from 0 to `D - 2`.
    pub fn reference_slip(&self, pair: usize, component: usize) -> f64 {
        self.reference_slip.map_or(0.0, |slip| slip[(self.dim - 1) * pair + component])
    }
}
