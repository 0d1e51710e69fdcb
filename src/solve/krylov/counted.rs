//! Bodies whose solutions and factorisations are counted.

use crate::error::Error;
use crate::problem::{Bodies, GoesOn, Restriction};

/// What was asked of bodies.
#[derive(Clone, Copy, Default)]
pub struct Counts {
    pub solutions: u64,
    pub factorisations: u64,
}

/// Bodies with counts.
pub struct Counted<'b> {
    bodies: &'b mut dyn Bodies,
    pub counts: Counts,
    /// What is held: the same again costs nothing.
    held: Option<Restriction>,
}

impl<'b> Counted<'b> {
    pub fn new(bodies: &'b mut dyn Bodies) -> Self {
        Counted { bodies, counts: Counts::default(), held: None }
    }
}

impl Bodies for Counted<'_> {
    fn inner(&self) -> usize {
        self.bodies.inner()
    }

    fn units(&self) -> &[f64] {
        self.bodies.units()
    }

    fn coupling(&self, i: usize, j: usize) -> f64 {
        self.bodies.coupling(i, j)
    }

    fn product(&mut self, x: &[f64]) -> Result<Vec<f64>, Error> {
        self.bodies.product(x)
    }

    fn residual(&mut self, x: &[f64], low: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
        self.bodies.residual(x, low, load)
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        self.bodies.magnitude(size)
    }

    fn has_cheap_products(&self) -> bool {
        self.bodies.has_cheap_products()
    }

    fn can_hold(&self) -> bool {
        self.bodies.can_hold()
    }

    fn has_springs(&self) -> bool {
        self.bodies.has_springs()
    }

    fn hold(&mut self, restriction: &Restriction, goes_on: GoesOn<'_>) -> Result<bool, Error> {
        if self.held.as_ref() == Some(restriction) {
            return Ok(true);
        }
        self.held = None;
        self.counts.factorisations += 1;
        let held = self.bodies.hold(restriction, goes_on)?;
        self.held = held.then(|| restriction.clone());
        Ok(held)
    }

    fn solve(&mut self, forces: &[f64]) -> Result<Vec<f64>, Error> {
        self.counts.solutions += 1;
        self.bodies.solve(forces)
    }
}
