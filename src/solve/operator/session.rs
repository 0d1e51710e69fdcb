//! A stiffness operator in use: what its factor holds, and how often it was asked.

use std::rc::Rc;

use crate::error::Error;
use crate::linalg::vector::first_not_finite;
use crate::monitor::Watch;
use crate::problem::{GoesOn, HeldSet, StiffnessOperator, iterated};
use crate::solve::result::Ending;

/// An operator with its last factor and its counts.
pub struct Session<'b> {
    pub operator: &'b mut dyn StiffnessOperator,
    pub monitor: &'b dyn Watch,
    /// The components that the factor holds; `None`: there is no factor.
    held: Option<Rc<HeldSet>>,
    pub solutions: u64,
    pub factorisations: u64,
}

impl<'b> Session<'b> {
    pub fn new(operator: &'b mut dyn StiffnessOperator, monitor: &'b dyn Watch) -> Self {
        let held = operator.held_set().map(|held_set| Rc::new(held_set.clone()));
        Session { operator, monitor, held, solutions: 0, factorisations: 0 }
    }

    /// The components that the factor holds; `None`: solutions are those of an inverse.
    pub fn held(&self) -> Option<Rc<HeldSet>> {
        self.held.clone()
    }

    /// Holds all components of pairs that have `dim` of them, if the operator can hold any.
    pub fn hold_all(&mut self, dim: usize) -> Result<(), Ending> {
        let components = self.operator.units().len() - self.operator.inner();
        self.hold_under(&HeldSet::all(dim, components / dim))
    }

    /// Holds components until the next call, if the operator can hold any. The factor of the last call serves again where it
    /// holds the same components.
    pub fn hold_under(&mut self, held_set: &HeldSet) -> Result<(), Ending> {
        if !self.operator.can_hold() || self.held.as_deref() == Some(held_set) {
            return Ok(());
        }
        self.held = None;
        self.factorisations += 1;
        let is_held = asked(self.monitor, |goes_on| self.operator.hold(held_set, goes_on))?;
        if !is_held {
            return Err(Ending::Stalled(
                "the bodies cannot be told from bodies that fall apart: no factor exists with springs on the pairs",
            ));
        }
        self.held = Some(Rc::new(held_set.clone()));
        Ok(())
    }

    /// True if there is a factor, and unknowns that it does not hold.
    pub fn has_free_unknowns(&self) -> bool {
        let has_inner = self.operator.inner() > 0;
        self.held.as_ref().is_some_and(|held_set| has_inner || held_set.held.contains(&false))
    }

    /// `A x`. A host is not asked with numbers that are not finite: the product is none then.
    ///
    /// # Errors
    /// A failure in the host.
    pub fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        match first_not_finite(x) {
            Some(_) => Ok(vec![f64::NAN; x.len()]),
            None => self.operator.product(x),
        }
    }

    /// `A (x + low) - b`, as [`Self::product`].
    ///
    /// # Errors
    /// A failure in the host.
    pub fn residual(&self, x: &[f64], low: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
        match first_not_finite(x) {
            Some(_) => Ok(vec![f64::NAN; x.len()]),
            None => self.operator.residual(x, low, load),
        }
    }

    /// A solution with the held components at zero, or with the inverse, or what the preconditioner makes of the forces.
    /// The host is not asked with numbers that are not finite: a singular operator leads there.
    pub fn solve(&mut self, forces: &[f64]) -> Result<Vec<f64>, Ending> {
        self.monitor.goes_on()?;
        if first_not_finite(forces).is_some() {
            return Err(Ending::Stalled("the forces are beyond the largest number"));
        }
        self.solutions += 1;
        let (operator, held) = (&mut *self.operator, self.held.as_deref());
        let solution = asked(self.monitor, |goes_on| operator.solve(held, forces, goes_on))?;
        Ok(solution.unwrap_or_default())
    }

    /// A solution with the held components at zero and no springs; where there is a preconditioner alone it leaves this
    /// part of the forces.
    pub fn solve_to(&mut self, (forces, left): (&[f64], f64)) -> Result<Vec<f64>, Ending> {
        let Some(held_set) = self.held().filter(|_| !self.operator.is_exact()) else {
            return self.solve(forces);
        };
        let solution = asked(self.monitor, |goes_on| {
            iterated(&mut *self.operator, &held_set, (forces, left), goes_on)
        })?;
        let (solution, count) = solution.unwrap_or_default();
        self.solutions += count;
        Ok(solution)
    }

    /// True where each product is dear: residuals follow from those of the point before.
    pub fn follows_residuals(&self) -> bool {
        !self.operator.is_sparse()
    }
}

/// The result of a work of the operator, unless the monitor has ended it.
fn asked<T>(
    monitor: &dyn Watch,
    work: impl FnOnce(GoesOn<'_>) -> Result<T, Error>,
) -> Result<T, Ending> {
    let mut stop = None;
    let result = work(&mut || {
        stop = stop.or_else(|| monitor.goes_on().err());
        stop.is_none()
    })?;
    Ok(stop.map_or(Ok(result), Err)?)
}
