//! From relative displacements and contact forces back to the host.

use super::Model;
use super::arguments::check_vector;
use crate::error::{Argument, Error};
use crate::reduce::SolvedCase;

impl Model {
    /// Displacements of the host from the relative ones; without `load` and `prescribed` those of
    /// a motion, such as that of [`crate::Status::NoEquilibrium`].
    ///
    /// # Errors
    /// Arrays of the wrong length or not finite.
    pub fn recover(
        &self,
        load: Option<&[f64]>,
        prescribed: Option<&[f64]>,
        d: &[f64],
    ) -> Result<Vec<f64>, Error> {
        self.check_solved(&SolvedCase { load, prescribed, d })?;
        self.reduction.recover(load, prescribed, d)
    }

    /// Refuses arrays of the wrong length or not finite.
    pub(crate) fn check_solved(&self, case: &SolvedCase<'_>) -> Result<(), Error> {
        self.check_loads(case.load, case.prescribed)?;
        check_vector(Argument::Start, "d", case.d, self.dim * self.pairs)
    }

    /// Contact forces as a nodal force vector of the host.
    ///
    /// # Errors
    /// A force of the wrong length or not finite.
    pub fn nodal_forces(&self, force: &[f64]) -> Result<Vec<f64>, Error> {
        check_vector(Argument::Load, "F", force, self.dim * self.pairs)?;
        Ok(self.reduction.nodal_forces(force))
    }
}
