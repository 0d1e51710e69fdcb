//! Certificates and proofs of displacements from any origin, on a load case of a model.

use super::arguments::check_vector;
use super::{LoadCase, Model};
use crate::certificate::{Certificate, Proof, certify, certify_in_units, prove};
use crate::error::{Argument, Error};
use crate::law::State;
use crate::solve::certify_matrix_free;

impl Model {
    /// Measures relative displacements `d` of any origin on a load case.
    ///
    /// # Errors
    /// As [`Self::solve`] for the load case; a `d` of the wrong length or not finite
    /// ([`Argument::Start`]); pairs that depend on each other ([`Argument::Matrix`]), as `d` alone does not
    /// tell their forces.
    pub fn certify(&self, case: &LoadCase<'_>, d: &[f64]) -> Result<Certificate, Error> {
        check_vector(("d", Argument::Start), d, self.dim * self.pairs)?;
        if let Some(bodies) = self.reduction.bodies() {
            return self
                .on_bodies(bodies, case, |bodies, case| certify_matrix_free(bodies, case, d));
        }
        self.reduced((case, None), |problem| Ok(certify(problem, d)))
    }

    /// Measures relative displacements `d` and contact forces of any origin on a load case, where displacements do
    /// not determine forces: in flexibility form, and where pairs depend on each other.
    ///
    /// # Errors
    /// As [`Self::certify`]; forces of the wrong length or not finite ([`Argument::Force`]).
    pub fn certify_forces(
        &self,
        case: &LoadCase<'_>,
        d: &[f64],
        force: &[f64],
    ) -> Result<Certificate, Error> {
        check_vector(("d", Argument::Start), d, self.dim * self.pairs)?;
        check_vector(("F", Argument::Force), force, self.dim * self.pairs)?;
        if let Some(dependence) = self.reduction.dependence() {
            return self.on_dependent_rows(dependence, (case, None), |problem| {
                Ok(certify_in_units(problem, d, force))
            });
        }
        match self.reduction.flexibility() {
            None => self.certify(case, d),
            Some(form) => Ok(certify_in_units(&self.on_flexibility(form, case)?, d, force)),
        }
    }

    /// True if displacements determine contact forces: neither is the model in flexibility form, nor do pairs depend
    /// on each other.
    pub(crate) fn is_determined_by_displacements(&self) -> bool {
        !self.starts_from_forces() && self.reduction.dependence().is_none()
    }

    /// Tries to prove that a load case has a solution next to relative displacements `d` of any origin, with the
    /// states `states` (`None`: those of `d`); `None` if it is not proved. The data are those of the condensed
    /// problem, in doubles as they were made.
    ///
    /// # Errors
    /// As [`Self::certify`]; a model in full space, of an operator or in flexibility form.
    pub fn prove(
        &self,
        case: &LoadCase<'_>,
        d: &[f64],
        states: Option<&[State]>,
    ) -> Result<Option<Proof>, Error> {
        check_vector(("d", Argument::Start), d, self.dim * self.pairs)?;
        self.reduced((case, None), |problem| {
            let own = || certify(problem, d).states;
            Ok(prove(problem, d, &states.map_or_else(own, <[State]>::to_vec)))
        })
    }
}
