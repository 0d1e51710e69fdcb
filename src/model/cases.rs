//! Many load cases of a model: the factor of the reduction is read once for a block of them.

use super::{LoadCase, Model};
use crate::error::{Error, Limit};
use crate::monitor::{Monitor, ProgressFn, Stop, Watch};
use crate::problem::Remembered;
use crate::settings::Settings;
use crate::solve::{CasePast, Solution, Status};

/// Load cases of a block. A solve with one column waits for memory; from this number on it computes, and a
/// block takes little memory beside the factor.
pub(crate) const BLOCK: usize = 32;

/// Where the solution of each load case starts.
#[derive(Clone, Copy, Debug)]
pub enum Starts<'a> {
    /// At nothing.
    Cold,
    /// At these relative displacements, `dim * pairs` for each case.
    Given(&'a [f64]),
    /// At the solution of the last case of the series that was solved; the first cases, before there is one, here
    /// (`None`: at nothing).
    Previous(Option<&'a [f64]>),
}

/// Load cases of a model, one after the other. What the solution of one has worked out of the model's
/// stiffness, whatever the loads, serves the next ones: the last factor, and with friction the elimination of pairs that
/// stay open, in the plane where they start at nothing. Each result is certified by itself. Its last digits depend on the cases before it in the series,
/// and so may the choice among several solutions; the same cases in the same order give the same bits.
pub struct Series<'m> {
    model: &'m Model,
    /// The results that further cases may use.
    pub(crate) past: Past,
}

/// The results that the cases of a series leave for the next ones.
#[derive(Default)]
pub(crate) struct Past {
    /// Factors of the stiffness; `None`: they are not kept for other cases.
    remembered: Option<Remembered>,
    /// Solutions in full space.
    spread: CasePast,
    /// The last solution.
    before: Option<Vec<f64>>,
}

impl Past {
    /// The past of a series that begins: no case has been solved.
    pub(crate) fn of_none() -> Self {
        Past { remembered: Some(Remembered::default()), ..Past::default() }
    }
}

impl<'m> Series<'m> {
    /// A series that goes on after `past`.
    pub(crate) fn after(model: &'m Model, past: Past) -> Self {
        Series { model, past }
    }

    /// A series of so many cases; one stands alone.
    pub(crate) fn of(model: &'m Model, cases: usize) -> Self {
        Self::after(model, if cases > 1 { Past::of_none() } else { Past::default() })
    }

    /// Solves the next load cases, each with budgets of its own. Their loads are condensed in blocks of 32, so that
    /// a case costs less than by [`Model::solve`]. A case that is wrong or not solved does not stop the others; a callback
    /// that cancels does.
    ///
    /// # Errors
    /// For each case as [`Model::solve`]; [`Error::Stopped`] for those that had not begun when the callback cancelled.
    pub fn solve_cases(
        &mut self,
        cases: &[LoadCase<'_>],
        settings: &Settings,
        starts: Starts<'_>,
        mut progress: Option<&mut ProgressFn<'_>>,
    ) -> Vec<Result<Solution, Error>> {
        let n = self.model.dim * self.model.pairs;
        let mut solved = Vec::with_capacity(cases.len());
        let Past { remembered, spread, before } = &mut self.past;
        let mut is_cancelled = false;
        for block in cases.chunks(BLOCK) {
            let told = progress.as_deref_mut().map(|tell| tell as &mut ProgressFn<'_>);
            // The limits of time are those of each case.
            let limits = Settings { time_limit: 0.0, ..*settings };
            let monitor = &mut Monitor::new(&limits, told);
            let loads = match is_cancelled {
                true => block.iter().map(|_| Err(not_begun())).collect(),
                false => self.model.condensed_loads(block, monitor),
            };
            is_cancelled |= monitor.shared().stop().is_some();
            for (case, load) in block.iter().zip(loads) {
                let k = solved.len();
                let start = match starts {
                    Starts::Cold => None,
                    // Where the array is too short, the empty start is refused for its length.
                    Starts::Given(all) => Some(all.get(n * k..n * (k + 1)).unwrap_or_default()),
                    Starts::Previous(first) => before.as_deref().or(first),
                };
                let told = progress.as_deref_mut().map(|tell| tell as &mut ProgressFn<'_>);
                let monitor = &mut Monitor::new(settings, told);
                let load = if is_cancelled { Err(not_begun()) } else { load };
                let solution = load.and_then(|load| {
                    let past = (remembered.as_ref(), &mut *spread);
                    self.model.solve_condensed((case, load), past, (settings, start), monitor)
                });
                if let Ok(found) = &solution
                    && found.status == Status::Solved
                {
                    let forces = self.model.starts_from_forces();
                    *before =
                        Some(if forces { &found.certificate.force } else { &found.d }.clone());
                }
                is_cancelled |= monitor.shared().stop() == Some(Stop::Cancelled);
                solved.push(solution);
            }
        }
        solved
    }
}

impl Model {
    /// The beginning of a series of load cases.
    pub fn series(&self) -> Series<'_> {
        Series::after(self, Past::of_none())
    }

    /// Solves load cases as a [`Series`]. One case stands alone.
    ///
    /// # Errors
    /// For each case as [`Self::solve`].
    pub fn solve_cases(
        &self,
        cases: &[LoadCase<'_>],
        settings: &Settings,
        starts: Starts<'_>,
        progress: Option<&mut ProgressFn<'_>>,
    ) -> Vec<Result<Solution, Error>> {
        Series::of(self, cases.len()).solve_cases(cases, settings, starts, progress)
    }

    /// The condensed loads of each case of a block; `None` where nothing is condensed. A wrong case is left out
    /// of what is worked out together.
    fn condensed_loads(
        &self,
        block: &[LoadCase<'_>],
        monitor: &dyn Watch,
    ) -> Vec<Result<Option<Vec<f64>>, Error>> {
        if self.is_matrix_free() {
            return block.iter().map(|_| Ok(None)).collect();
        }
        let checked: Vec<_> =
            block.iter().map(|case| self.check_loads(Some(case.load), case.prescribed)).collect();
        let sound: Vec<_> = (block.iter().zip(&checked))
            .filter(|(_, checked)| checked.is_ok())
            .map(|(case, _)| (case.load, case.prescribed))
            .collect();
        let condensed = self.reduction.condense_cases(&sound, &mut monitor.asking());
        let mut loads = match condensed.and_then(|loads| loads.ok_or_else(not_begun)) {
            Ok(loads) => loads.into_iter(),
            Err(error) => return block.iter().map(|_| Err(error.clone())).collect(),
        };
        checked.into_iter().map(|checked| checked.map(|()| loads.next())).collect()
    }
}

/// The error of a case that the callback did not let begin.
fn not_begun() -> Error {
    let message =
        "the callback has cancelled the call before this load case began: nothing is written";
    Error::stopped(Limit::Cancelled, message)
}
