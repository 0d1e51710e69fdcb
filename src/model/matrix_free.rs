//! Models that have no stiffness in relative displacements: what they are asked in its place, and what they
//! refuse.

use super::{LoadCase, Model};
use crate::error::{Argument, Error, index};
use crate::problem::{StiffnessOperator, check_count, checked_dim, unknowns};
use crate::reduce::{HostOperator, OperatorReduction};
use crate::solve::MatrixFreeCase;

impl Model {
    /// A structure of which the host gives products and solutions in relative displacements alone. Loads and
    /// displacements of the host are those of the pairs, `dim * pairs`. `units` are positive, of the size of the
    /// diagonal of `K_rel`, force per length; `None`: one for each direction, from products.
    ///
    /// # Errors
    /// A dimension that is not 2 or 3; units of the wrong length; what [`OperatorReduction::new`] finds wrong with
    /// the operator.
    pub fn operator(
        dim: usize,
        pairs: usize,
        operator: Box<dyn HostOperator>,
        units: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        check_count(("units", Argument::Matrix), units.map_or(size, <[f64]>::len), size)?;
        let reduction = Box::new(OperatorReduction::new(operator, (dim, pairs), units)?);
        Ok(Model { dim, pairs, reduction })
    }

    /// A structure of which the host gives exact products on all of its unknowns, and a preconditioner. Loads and
    /// displacements of the host are those of its unknowns. `units` are positive, of the size of the
    /// diagonal of its matrix, one for each unknown; `components` are the unknowns that are the relative displacements of
    /// the pairs, `dim` for each pair. A load case is solved by Newton's method with FGMRES.
    ///
    /// # Errors
    /// A dimension that is not 2 or 3; components that are not `dim` for each pair; what
    /// [`OperatorReduction::preconditioned`] finds wrong.
    pub fn preconditioned(
        dim: usize,
        operator: Box<dyn HostOperator>,
        units: &[f64],
        components: &[usize],
    ) -> Result<Self, Error> {
        let pairs = components.len() / checked_dim(dim)?;
        if dim * pairs != components.len() {
            let given = components.len();
            let wrong = format!("place has {given} entries, not {dim} for each pair");
            return Argument::Matrix.refuse(wrong);
        }
        let reduction =
            Box::new(OperatorReduction::preconditioned(operator, dim, units, components)?);
        Ok(Model { dim, pairs, reduction })
    }

    /// Hands over bodies whose stiffness is not formed with a load case.
    pub(super) fn on_bodies<T>(
        &self,
        mut bodies: Box<dyn StiffnessOperator + '_>,
        case: &LoadCase<'_>,
        to: impl FnOnce(&mut dyn StiffnessOperator, &MatrixFreeCase<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        self.check_loads(Some(case.load), case.prescribed)?;
        let slip = self.allowed_slip(case)?;
        let load = self.reduction.all_loads(case.load, case.prescribed);
        let case = MatrixFreeCase {
            dim: self.dim,
            load: &load,
            gap: case.gap,
            law: case.law,
            reference_slip: slip.as_deref(),
        };
        to(&mut *bodies, &case)
    }

    /// Returns `true` if the model forms no stiffness in relative displacements: it is in full space.
    pub fn is_matrix_free(&self) -> bool {
        self.reduction.inner_unknowns().is_some()
    }

    /// Refuses what needs the entries of a stiffness that is not formed.
    pub(crate) fn check_formed(&self) -> Result<(), Error> {
        self.check_stiffness_form()?;
        if !self.is_matrix_free() {
            return Ok(());
        }
        Argument::Matrix.refuse(
            "the model forms no condensed matrix: it is in full space, or an operator; solve, certify and recover \
             load cases by the model",
        )
    }

    /// Refuses what is asked of a stiffness, in flexibility form.
    pub(super) fn check_stiffness_form(&self) -> Result<(), Error> {
        if self.reduction.flexibility().is_none() {
            return Ok(());
        }
        Argument::Matrix.refuse(
            "the model is in flexibility form: it has no stiffness; solve load cases by the model, and certify d with F",
        )
    }

    /// Refuses what needs a stiffness in relative displacements, if there is none.
    pub(crate) fn check_independent(&self) -> Result<(), Error> {
        let pairs = self.dependent_pairs();
        let Some(first) = pairs.first() else { return Ok(()) };
        let others = match pairs.len() {
            1 => String::new(),
            more => format!(" and of {} more", more - 1),
        };
        Argument::Matrix.refuse(format!(
            "the rows of pair {}{others} follow from those of other pairs or from supports: no stiffness in \
             relative displacements exists; solve load cases by the model",
            index(first)
        ))
    }
}
