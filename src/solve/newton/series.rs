//! One of several problems with the same matrix: the elimination of one serves the next.
//!
//! The eliminated pairs depend on the matrix and on which pairs are open, not on the loads. Where the pairs that
//! an earlier problem has eliminated are open in this one too, the contact problem on its candidates is at hand:
//! sweeps are sweeps on them, and the search on candidates ([`super::candidates`]) is one on a part of the
//! pairs. If pairs outside close, the candidates of both problems are the next ones, so that a series in which
//! the contact rocks soon has candidates for all of it. What is found is measured on the whole problem, and is
//! solved as a problem that stands alone if that fails.

use std::sync::Arc;

use super::candidates::{self, Core, Found, refine, search};
use super::start::swept;
use crate::law::{Contact, Vector};
use crate::linalg::elimination::{Elimination, Remembered};
use crate::monitor::{Monitor, Stop};
use crate::settings::Settings;
use crate::solve::part::{ReducedProblem, closed_with_margin};
use crate::solve::pieces::{Equations, Point};
use crate::solve::result::{Candidate, Ending};

/// Candidates beside the pairs that are closed: more than one problem by itself has, since loads differ.
const MARGIN: f64 = 0.25;

/// Candidates are too many, which costs more than a new elimination, above so many times those that a
/// problem needs.
const TOO_MANY: f64 = 1.6;

/// Part of the candidates that may close outside of them: where it is more the problem is another one.
const FEW_CLOSING: f64 = 0.3;

/// Solves a problem from the displacements `start` (zero if `None`): sweeps, then `core` on the
/// candidates.
pub fn solve(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
    core: &mut Core<'_>,
) -> Candidate {
    let whole = Equations::of(contact);
    let mut alone = ColdStart::default();
    if let Some(remembered) = contact.problem().remembered() {
        let series = SharedElimination { contact, settings, whole: &whole, remembered };
        alone = match series.solve(start, monitor, core) {
            Ok(candidate) => return candidate,
            Err(alone) => alone,
        }
    }
    let y = alone.y.unwrap_or_else(|| swept(&whole, start, monitor));
    let mut candidate = candidates::solve((contact, &whole), settings, y, monitor, core);
    candidate.effort.factorisations += alone.systems;
    candidate
}

/// A problem, and what those before it have left.
struct SharedElimination<'w> {
    contact: &'w Contact<'w>,
    settings: &'w Settings,
    whole: &'w Equations<'w>,
    remembered: &'w Remembered,
}

/// Reasons to solve a problem alone, as far as they are known.
#[derive(Default)]
struct ColdStart {
    /// Systems that were spent.
    systems: u64,
    /// The coordinates after sweeps, if there were any on the whole problem and nothing else.
    y: Option<Vec<Vector>>,
}

impl<'w> SharedElimination<'w> {
    /// Solves from the displacements `start`.
    fn solve(
        &self,
        start: Option<&[f64]>,
        monitor: &mut Monitor<'_>,
        core: &mut Core<'_>,
    ) -> Result<Candidate, ColdStart> {
        // Nothing is kept while others may need the memory, and nothing of a problem that is not solved.
        let before = self.remembered.get();
        self.remembered.keep(None);
        let begun = before.and_then(|before| self.begun(before, start, monitor));
        let (mut reduced, mut y) = match begun {
            Some(begun) => begun,
            None => self.begin(start, monitor)?,
        };
        let mut systems = 0;
        loop {
            let equations = reduced.equations();
            let mut found = search(&equations, y, self.settings.tolerance, monitor, core);
            systems += found.systems;
            let done = found.ending == Ending::Done;
            if !done && !matches!(found.ending, Ending::Stopped(_)) {
                return Err(ColdStart { systems, y: None });
            }
            let of_all = reduced.whole_from(&found.d, &found.y);
            let solved = done && self.whole.eta(&of_all.0, &of_all.1) <= self.settings.tolerance;
            let closing = if solved || !done { Vec::new() } else { reduced.closing(&of_all.2) };
            let (mut d, mut force);
            (d, force, y) = of_all;
            if closing.is_empty() {
                if done && !solved {
                    let point = Point::new(&equations, found.y);
                    let (contact, settings) = (self.contact, self.settings);
                    let parts = (&mut d, &mut force);
                    systems += refine(&reduced, contact, settings, parts, point, monitor);
                }
                self.remembered.keep(Some(Arc::clone(reduced.elimination())));
                (found.d, found.force, found.y, found.systems) = (d, force, y, systems);
                return Ok(found.into_candidate());
            }
            let orientation = found.orientation;
            drop(found);
            drop(equations);
            reduced = match self.wider(reduced, &closing, &y, monitor) {
                Ok(wider) => wider.ok_or(ColdStart { systems, y: None })?,
                Err(stop) => {
                    let point = Point::new(self.whole, y);
                    let found = Found::at(point, Ending::Stopped(stop), (systems, orientation));
                    return Ok(found.into_candidate());
                }
            };
            y = reduced.of_kept(&y);
        }
    }

    /// The problem parted as an earlier one, and coordinates of the candidates after sweeps on them; `None` if the
    /// candidates do not fit.
    fn begun(
        &self,
        before: Arc<Elimination>,
        start: Option<&[f64]>,
        monitor: &Monitor<'_>,
    ) -> Option<(ReducedProblem<'w>, Vec<Vector>)> {
        let dim = self.whole.dim;
        let mut components = before.dropped().iter();
        if !components.all(|i| self.whole.laws[i / dim].is_free_when_open()) {
            return None;
        }
        let start: Option<Vec<f64>> =
            start.map(|start| before.kept().iter().map(|&i| start[i]).collect());
        let reduced = ReducedProblem::by_elimination(self.whole, before);
        let equations = reduced.equations();
        let y = swept(&equations, start.as_deref(), monitor);
        let needed = closed_with_margin(&equations.laws, &y, MARGIN).len();
        let fits = is_finite(&y) && y.len() as f64 <= TOO_MANY * needed as f64;
        drop(equations);
        fits.then_some((reduced, y))
    }

    /// Begins with a problem that follows none.
    fn begin(
        &self,
        start: Option<&[f64]>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(ReducedProblem<'w>, Vec<Vector>), ColdStart> {
        let y = swept(self.whole, start, monitor);
        let kept = is_finite(&y).then(|| closed_with_margin(&self.whole.laws, &y, MARGIN));
        // Without time for it the problem alone has none either, and ends there.
        let reduced = kept.and_then(|kept| {
            ReducedProblem::of_candidates(self.whole, &kept, monitor).ok().flatten()
        });
        let Some(reduced) = reduced else { return Err(ColdStart { systems: 0, y: Some(y) }) };
        let on_kept = reduced.of_kept(&y);
        Ok((reduced, on_kept))
    }

    /// The problem parted anew after some pairs outside of the candidates have closed at the coordinates `y`.
    /// `Err`: there is no time for it.
    fn wider(
        &self,
        reduced: ReducedProblem<'w>,
        closing: &[usize],
        y: &[Vector],
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<ReducedProblem<'w>>, Stop> {
        let mut kept: Vec<usize> = reduced.kept().collect();
        if closing.len() as f64 > FEW_CLOSING * kept.len() as f64 {
            return Ok(None);
        }
        drop(reduced);
        let needed = closed_with_margin(&self.whole.laws, y, MARGIN);
        kept.extend(&needed);
        kept.sort_unstable();
        kept.dedup();
        let too_many = kept.len() as f64 > TOO_MANY * needed.len() as f64;
        ReducedProblem::of_candidates(self.whole, if too_many { &needed } else { &kept }, monitor)
    }
}

fn is_finite(y: &[Vector]) -> bool {
    y.iter().flatten().all(|y| y.is_finite())
}
