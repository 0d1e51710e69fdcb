//! Newton's systems of one point after another. Where the law is linear on each piece, one factor serves the pieces near
//! by.

use super::amended::Amended;
use super::before::Before;
use super::equations::{Equations, Step};
use super::system::System;
use crate::law::Linearised;
use crate::linalg::tolerances::SINGULAR;
use crate::linalg::vector::{first_not_finite, norm_inf, opposite};
use crate::linalg::watched::GoesOn;
use crate::monitor::Watch;
use crate::problem::Remembered;
use crate::solve::result::Ending;

/// Below so many unknowns a new factorisation is cheaper than changes of an old one: measured on the bar on the
/// plane.
pub const SMALL: usize = 64;

/// Steps of iterative refinement: each gains about as many digits as the factor has right, so that three suffice
/// whenever any do.
pub const REFINEMENTS: usize = 3;

/// Displacements are those of the solution before up to this part of the largest: polishing changes less.
const SAME: f64 = 1e-6;

/// The end of a solution, for the next problem with the same matrix.
struct Left {
    system: Amended,
    solution: Before,
}

/// Systems of the same equations.
pub struct Systems<'e> {
    equations: &'e Equations<'e>,
    monitor: &'e dyn Watch,
    /// The last system. In space it is one of a point, and serves others near by as long as steps with it converge.
    last: Option<Amended>,
    /// The solution before, if the last system is what it has left.
    before: Option<Before>,
    /// Factorisations so far.
    pub factorisations: u64,
}

impl<'e> Systems<'e> {
    /// None yet, or the one that the problem before with the same matrix has left.
    pub fn of(equations: &'e Equations<'e>, monitor: &'e dyn Watch) -> Self {
        let left = equations.remembered.and_then(Remembered::take::<Left>);
        let left = left.filter(|left| left.system.base.fits(equations));
        let (last, before) = left.map(|Left { system, solution }| (system, solution)).unzip();
        Systems { equations, monitor, last, before, factorisations: 0 }
    }

    /// The solution before, if `start` has its displacements: in small steps of the loads most pairs stay on its pieces.
    pub fn before(&mut self, start: Option<&[f64]>) -> Option<Before> {
        let before = self.before.take()?;
        let most = SAME * norm_inf(&before.d);
        let is_near = |(d, start): (&f64, &f64)| (d - start).abs() <= most;
        start.filter(|start| before.d.iter().zip(*start).all(is_near)).map(|_| before)
    }

    /// Leaves the last system, and the solution, for the next problem with the same matrix.
    pub fn leave(self, solution: impl FnOnce() -> Before) {
        if let (Some(remembered), Some(system)) = (self.equations.remembered, self.last) {
            remembered.leave(Left { system, solution: solution() });
        }
    }

    /// Operations of a change from the last system that was factorised to that of `pairs`, if it is of pieces and that
    /// takes fewer than a new factorisation.
    fn change_work(&self, pairs: &[Linearised]) -> Option<f64> {
        let system =
            self.last.as_ref().filter(|last| self.are_of_pieces() && last.base.size() >= SMALL)?;
        let work = system.work(self.equations.dim, pairs);
        (work <= System::work(self.equations, pairs)).then_some(work)
    }

    /// Lets the next system be factorised anew: changes lose accuracy that a new factor has.
    pub fn forget(&mut self) {
        self.last = None;
    }

    /// Goes to the system of pairs on their pieces.
    ///
    /// # Errors
    /// It is singular, or there is no time for it.
    pub fn go_to(&mut self, pairs: Vec<Linearised>) -> Result<(), Ending> {
        let equations = self.equations;
        if self.are_of_pieces() && self.last.as_ref().is_some_and(|last| last.pairs() == pairs) {
            return Ok(());
        }
        let change = self.change_work(&pairs);
        self.monitor.affords(change.unwrap_or_else(|| System::work(equations, &pairs)))?;
        let goes_on = &mut self.monitor.asking();
        if change.is_some()
            && let Some(system) = &mut self.last
            && system.go_to(equations, pairs.clone(), goes_on).is_some()
        {
            return Ok(());
        }
        // Two factors never stand side by side.
        self.last = None;
        self.factorisations += 1;
        let system = System::new(equations, (pairs, 1.0), SINGULAR, goes_on);
        self.last = Some(Amended::of(equations, system.ok_or(Ending::Singular)?));
        Ok(())
    }

    /// The step of the last system for the lack `H`.
    ///
    /// # Errors
    /// It overflows.
    pub fn step(&mut self, lack: &[f64]) -> Result<Step, Ending> {
        let step = self.last.as_mut().map(|last| last.step(self.equations, &opposite(lack)));
        step.filter(|step| step.dy.iter().all(|dy| dy.is_finite())).ok_or(Ending::Singular)
    }

    /// The displacements of that step where the law is linear on each piece: `K` is not read for them.
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn motion(&self, lack: &[f64]) -> Result<Vec<f64>, Ending> {
        let dd = self.last.as_ref().map(|last| last.motion(self.equations, &opposite(lack)));
        dd.filter(|dd| first_not_finite(dd).is_none()).ok_or(Ending::Singular)
    }

    /// Sign of the determinant of the last system.
    pub fn orientation(&self) -> i8 {
        self.last.as_ref().map_or(0, Amended::sign)
    }

    /// As [`Amended::definite`] of the last system.
    pub fn definite(&self, goes_on: GoesOn<'_>) -> Vec<bool> {
        let root = &self.equations.root;
        self.last.as_ref().map_or_else(Vec::new, |last| last.definite(root, goes_on))
    }

    /// True if the last system is one of pieces, on which its solution is exact.
    pub fn are_of_pieces(&self) -> bool {
        self.last.is_some() && self.equations.are_linear()
    }
}
