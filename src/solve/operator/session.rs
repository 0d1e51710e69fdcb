//! A stiffness operator in use: what its factor holds, and how often it was asked.

use std::rc::Rc;

use crate::error::Error;
use crate::monitor::Monitor;
use crate::problem::{HeldSet, StiffnessOperator};
use crate::solve::result::Ending;

/// An operator with its last factor and its counts.
pub struct Session<'b> {
    pub operator: &'b mut dyn StiffnessOperator,
    /// The components that the factor holds; `None`: there is no factor.
    held: Option<Rc<HeldSet>>,
    pub solutions: u64,
    pub factorisations: u64,
}

impl<'b> Session<'b> {
    pub fn new(operator: &'b mut dyn StiffnessOperator) -> Self {
        let held = operator.held_set().map(|held_set| Rc::new(held_set.clone()));
        Session { operator, held, solutions: 0, factorisations: 0 }
    }

    /// The components that the factor holds; `None`: solutions are those of an inverse.
    pub fn held(&self) -> Option<Rc<HeldSet>> {
        self.held.clone()
    }

    /// Holds all components of pairs that have `dim` of them, if the operator can hold any.
    pub fn hold_all(&mut self, dim: usize, monitor: &mut Monitor<'_>) -> Result<(), Ending> {
        let components = self.operator.units().len() - self.operator.inner();
        self.hold_under(&HeldSet::all(dim, components / dim), monitor)
    }

    /// Holds components until the next call, if the operator can hold any. The factor of the last call serves again where it
    /// holds the same components.
    pub fn hold_under(
        &mut self,
        held_set: &HeldSet,
        monitor: &mut Monitor<'_>,
    ) -> Result<(), Ending> {
        if !self.operator.can_hold() || self.held.as_deref() == Some(held_set) {
            return Ok(());
        }
        self.held = None;
        self.factorisations += 1;
        let mut stop = None;
        let is_held = self.operator.hold(held_set, &mut || {
            stop = monitor.goes_on().err();
            stop.is_none()
        })?;
        self.held = is_held.then(|| Rc::new(held_set.clone()));
        Ok(stop.map_or(Ok(()), Err)?)
    }

    /// A solution with the held components at zero, or with the inverse.
    pub fn solve(&mut self, forces: &[f64]) -> Result<Vec<f64>, Error> {
        self.solutions += 1;
        self.operator.solve(forces)
    }

    /// True where each product is dear: residuals follow from those of the point before.
    pub fn follows_residuals(&self) -> bool {
        !self.operator.is_sparse()
    }
}
