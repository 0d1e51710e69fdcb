//! From relative displacements and contact forces back to the host.

use super::Model;
use super::arguments::check_vector;
use super::cases::BLOCK;
use crate::error::{Argument, Error, entry};
use crate::linalg::vector::first_not_finite;
use crate::reduce::SolvedCase;

impl Model {
    /// Displacements of the host from the relative ones; without `load` and `prescribed` those of
    /// a motion, such as that of [`crate::Status::NoEquilibrium`].
    ///
    /// # Errors
    /// Arrays of the wrong length or not finite; numbers so large that the displacements overflow.
    pub fn recover(
        &self,
        load: Option<&[f64]>,
        prescribed: Option<&[f64]>,
        d: &[f64],
    ) -> Result<Vec<f64>, Error> {
        self.check_solved(&SolvedCase { load, prescribed, d })?;
        not_overflown(Argument::Start, "u", self.reduction.recover(load, prescribed, d)?)
    }

    /// Displacements of the host of several load cases, each as by [`Self::recover`], in blocks of 32.
    ///
    /// # Errors
    /// As of [`Self::recover`], with the number of the case if there are several.
    pub fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        for (k, case) in cases.iter().enumerate() {
            self.check_case(case, k, cases.len())?;
        }
        let mut found = Vec::with_capacity(cases.len());
        for block in cases.chunks(BLOCK) {
            found.extend(self.recover_block(block, found.len(), cases.len())?);
        }
        Ok(found)
    }

    /// As [`Self::recover_cases`], of checked cases from `first` on, of `all`.
    pub(crate) fn recover_block(
        &self,
        block: &[SolvedCase<'_>],
        first: usize,
        all: usize,
    ) -> Result<Vec<Vec<f64>>, Error> {
        let recovered = self.reduction.recover_cases(block)?;
        let checked = (first..).zip(recovered).map(|(k, u)| {
            not_overflown(Argument::Start, "u", u).map_err(|error| of_case(error, k, all))
        });
        checked.collect()
    }

    /// Refuses the arrays of case `k` of `all` if they are of the wrong length or not finite.
    pub(crate) fn check_case(
        &self,
        case: &SolvedCase<'_>,
        k: usize,
        all: usize,
    ) -> Result<(), Error> {
        self.check_solved(case).map_err(|error| of_case(error, k, all))
    }

    /// Refuses arrays of the wrong length or not finite.
    fn check_solved(&self, case: &SolvedCase<'_>) -> Result<(), Error> {
        self.check_loads(case.load, case.prescribed)?;
        check_vector(Argument::Start, "d", case.d, self.dim * self.pairs)
    }

    /// Contact forces as a nodal force vector of the host.
    ///
    /// # Errors
    /// A force of the wrong length or not finite, or so large that nodal forces overflow.
    pub fn nodal_forces(&self, force: &[f64]) -> Result<Vec<f64>, Error> {
        check_vector(Argument::Load, "F", force, self.dim * self.pairs)?;
        not_overflown(Argument::Load, "nodal", self.reduction.nodal_forces(force))
    }
}

/// An error of case `k` of `all`: of several it names the number.
fn of_case(error: Error, k: usize, all: usize) -> Error {
    if all == 1 { error } else { error.in_case(k) }
}

/// The values, if they are finite: they were made of finite numbers.
fn not_overflown(argument: Argument, name: &str, values: Vec<f64>) -> Result<Vec<f64>, Error> {
    let Some(i) = first_not_finite(&values) else { return Ok(values) };
    let place = entry(name, [i]);
    let message = format!(
        "{place} overflows: what it is made of is too large for a double; choose larger units"
    );
    Err(Error::invalid(argument, message))
}
