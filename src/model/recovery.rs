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
        Ok(self.recover_cases(&[SolvedCase { load, prescribed, d }])?.concat())
    }

    /// Displacements of the host of several load cases, each as by [`Self::recover`], in blocks of 32.
    ///
    /// # Errors
    /// As of [`Self::recover`], with the number of the case if there are several.
    pub fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        let mut found = Vec::with_capacity(cases.len());
        self.recover_each(cases.len(), |k| cases[k], |_, u| found.push(u))?;
        Ok(found)
    }

    /// As [`Self::recover_cases`] of so many cases, each handed over with its number. None is if the arrays of one are wrong,
    /// and none of a block in which one overflows.
    pub(crate) fn recover_each<'c>(
        &self,
        count: usize,
        case: impl Fn(usize) -> SolvedCase<'c>,
        mut take: impl FnMut(usize, Vec<f64>),
    ) -> Result<(), Error> {
        // The message names the number of one of several.
        let of_case = |error: Error, k| if count == 1 { error } else { error.in_case(k) };
        for k in 0..count {
            self.check_solved(&case(k)).map_err(|error| of_case(error, k))?;
        }
        for begin in (0..count).step_by(BLOCK) {
            let block: Vec<_> = (begin..count.min(begin + BLOCK)).map(&case).collect();
            let recovered = (begin..).zip(self.reduction.recover_cases(&block)?);
            let checked = recovered.map(|(k, u)| {
                let u =
                    not_overflown(Argument::Start, "u", u).map_err(|error| of_case(error, k))?;
                Ok((k, u))
            });
            let checked: Vec<_> = checked.collect::<Result<_, Error>>()?;
            checked.into_iter().for_each(|(k, u)| take(k, u));
        }
        Ok(())
    }

    /// Refuses arrays of the wrong length or not finite.
    fn check_solved(&self, case: &SolvedCase<'_>) -> Result<(), Error> {
        self.check_loads(case.load, case.prescribed)?;
        check_vector(("d", Argument::Start), case.d, self.dim * self.pairs)
    }

    /// Contact forces as a nodal force vector of the host.
    ///
    /// # Errors
    /// A force of the wrong length or not finite, or so large that nodal forces overflow.
    pub fn nodal_forces(&self, force: &[f64]) -> Result<Vec<f64>, Error> {
        check_vector(("F", Argument::Load), force, self.dim * self.pairs)?;
        not_overflown(Argument::Load, "nodal", self.reduction.nodal_forces(force))
    }
}

/// The values, if they are finite: they were made of finite numbers.
fn not_overflown(argument: Argument, name: &str, values: Vec<f64>) -> Result<Vec<f64>, Error> {
    let Some(i) = first_not_finite(&values) else { return Ok(values) };
    let place = entry(name, [i]);
    argument.refuse(format!(
        "{place} overflows: what it is made of is too large for a double; choose larger units"
    ))
}
