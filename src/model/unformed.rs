//! Models that have no stiffness in relative displacements: what they are asked in its place, and what they
//! refuse.

use super::arguments::check_fixed_gaps;
use super::{LoadCase, Model};
use crate::error::{Argument, Error, index};
use crate::problem::Bodies;
use crate::reduce::UnformedReduction;
use crate::solve::UnformedCase;

impl Model {
    /// Hands over bodies whose stiffness is not formed, with a load case.
    pub(super) fn on_bodies<T>(
        &self,
        unformed: &dyn UnformedReduction,
        case: &LoadCase<'_>,
        to: impl FnOnce(&mut dyn Bodies, &UnformedCase<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.check_loads(Some(case.load), case.prescribed)?;
        check_fixed_gaps(self.reduction.fixed_components(), self.dim, case.gap)?;
        let slip = case.reference_slip.map(|slip| self.allowed_slip(slip));
        let load = unformed.all_loads(case.load, case.prescribed);
        let case = UnformedCase {
            dim: self.dim,
            load: &load,
            gap: case.gap,
            law: case.law,
            reference_slip: slip.as_deref(),
        };
        to(&mut *unformed.bodies(), &case)
    }

    /// Whether the model forms no stiffness in relative displacements: it is in full space.
    pub fn is_unformed(&self) -> bool {
        self.reduction.unformed().is_some()
    }

    /// Refuses what needs the entries of a stiffness that is not formed.
    pub(crate) fn check_formed(&self) -> Result<(), Error> {
        if !self.is_unformed() {
            return Ok(());
        }
        let message = "the model is in full space: no condensed matrix is formed; solve, certify and recover \
                       load cases by the model";
        Err(Error::invalid(Argument::Matrix, message))
    }

    /// Refuses what needs a stiffness in relative displacements, if there is none.
    pub(crate) fn check_independent(&self) -> Result<(), Error> {
        let pairs = self.dependent_pairs();
        let Some(first) = pairs.first() else { return Ok(()) };
        let others = match pairs.len() {
            1 => String::new(),
            more => format!(" and of {} more", more - 1),
        };
        let message = format!(
            "the rows of pair {}{others} follow from those of other pairs or from supports: no stiffness in \
             relative displacements exists; solve load cases by the model",
            index(first)
        );
        Err(Error::invalid(Argument::Matrix, message))
    }
}
