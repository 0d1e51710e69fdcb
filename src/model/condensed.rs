//! Models of matrices that a host has condensed.

use super::Model;
use crate::error::{Argument, Error};
use crate::monitor::{Monitor, Watch};
#[cfg(doc)]
use crate::problem::ContactProblem;
use crate::problem::{OF_MATRIX, checked_dim, dense, unknowns};
use crate::reduce::{CondensedReduction, TwoBodyReduction, memory};
use crate::settings::Settings;

impl Model {
    /// A body condensed by the host, on an obstacle: `d = u`.
    ///
    /// If a diagonal entry is at most 9e-12 of the largest one of its pair, and the component is coupled to others,
    /// motions of so little energy are the rounding of a condensation and become exactly free. All other matrices are
    /// taken as they are.
    ///
    /// # Errors
    /// As [`ContactProblem::new`] for the matrix; one that is then not positive semi-definite, with a component.
    pub fn condensed(dim: usize, pairs: usize, k: &[f64], ld: usize) -> Result<Self, Error> {
        Self::condensed_within(dim, pairs, (k, ld), &mut Monitor::new(&Settings::default(), None))
    }

    /// As [`Self::condensed`], within the limits of `monitor` on memory and time, with its callback.
    ///
    /// # Errors
    /// As [`Self::condensed`]; [`Error::Stopped`].
    pub fn condensed_within(
        dim: usize,
        pairs: usize,
        k: (&[f64], usize),
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        monitor.shared().reducing(0.0, memory(size))?;
        let matrix = dense("K", k, size, OF_MATRIX)?;
        let reduction =
            while_it_goes_on(monitor, |go_on| CondensedReduction::new(dim, &matrix, go_on))?;
        Ok(Model { dim, pairs, reduction: Box::new(reduction) })
    }

    /// Two condensed bodies on matching contact nodes, each in its own outward frame.
    ///
    /// # Errors
    /// Entries that are not finite or symmetric, negative diagonals, zeros there in rows that are not zero;
    /// a motion that neither body resists, named by its largest component.
    pub fn two_body(
        dim: usize,
        pairs: usize,
        first: (&[f64], usize),
        second: (&[f64], usize),
    ) -> Result<Self, Error> {
        let monitor = &mut Monitor::new(&Settings::default(), None);
        Self::two_body_within(dim, pairs, [first, second], monitor)
    }

    /// As [`Self::two_body`], within the limits of `monitor` on memory and time, with its callback.
    ///
    /// # Errors
    /// As [`Self::two_body`]; [`Error::Stopped`].
    pub fn two_body_within(
        dim: usize,
        pairs: usize,
        [first, second]: [(&[f64], usize); 2],
        monitor: &mut Monitor<'_>,
    ) -> Result<Self, Error> {
        let size = unknowns(checked_dim(dim)?, pairs)?;
        monitor.shared().reducing(0.0, memory(size))?;
        let first = dense("K_A", first, size, OF_MATRIX)?;
        let arguments = (Argument::SecondMatrix, Argument::SecondLeadingDimension);
        let second = dense("K_B", second, size, arguments)?;
        let reduction =
            while_it_goes_on(monitor, |go_on| TwoBodyReduction::new(dim, first, second, go_on))?;
        Model { dim, pairs, reduction: Box::new(reduction) }.checked()
    }
}

/// The result of a work that asks whether to go on, unless the monitor ends it.
fn while_it_goes_on<T>(
    monitor: &dyn Watch,
    work: impl FnOnce(&mut dyn FnMut() -> bool) -> Result<T, Error>,
) -> Result<T, Error> {
    let mut ended = None;
    let result = work(&mut || {
        ended = ended.take().or_else(|| monitor.reducing(0.0, 0).err());
        ended.is_none()
    });
    ended.map_or(result, Err)
}
