//! Candidate elimination: pairs that are surely open leave the equations by one Cholesky factorisation.
//!
//! After the sweeps the set of open pairs is nearly final. With `O` the pairs that are far from contact
//! and `C` the candidates, `K_OO d_O + K_OC d_C = f_O` holds as long as `O` stays open, so that the
//! contact problem on `C` alone has the matrix `S = K_CC - K_CO K_OO⁻¹ K_OC`. It is solved with all
//! states allowed. If a pair of `O` then penetrates, it joins `C`, and the problem is solved again: this
//! ends, as each pass adds pairs. The result is measured and refined on the whole problem.

use std::borrow::Cow;

use super::iteration::{self, Ended};
use crate::certificate::{eta_of, measure};
use crate::law::{Contact, Vector};
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::part::{MARGIN, ReducedProblem, closed_with_margin};
use crate::solve::pieces::{Equations, Point, REFINEMENTS, System};
use crate::solve::result::{Candidate, Effort, Ending};

/// Why there is no start.
pub(super) const OVERFLOW: Ending = Ending::Stalled("the forces are beyond the largest number");

/// A solver of equations from given coordinates to a tolerance.
pub type Core<'c> = dyn FnMut(&Equations<'_>, Vec<Vector>, &mut Monitor<'_>) -> Ended + 'c;

/// Solves a whole problem from the coordinates `y`.
pub(super) fn solve(
    (contact, whole): (&Contact<'_>, &Equations<'_>),
    settings: &Settings,
    y: Vec<Vector>,
    monitor: &mut Monitor<'_>,
    core: &mut Core<'_>,
) -> Candidate {
    if !y.iter().flatten().all(|y| y.is_finite()) {
        return Candidate::without_displacements(contact, OVERFLOW);
    }
    let mut found = search(whole, y, settings.tolerance, monitor, core);
    if let Some((reduced, point)) = found.parted.take() {
        let parts = (&mut found.d, &mut found.force);
        let systems = refine(&reduced, contact, settings, parts, point, monitor);
        found.systems += systems;
    }
    found.into_candidate()
}

/// Where a search has ended.
pub(super) struct Found<'w> {
    /// Displacements, the force that they need, and their coordinates.
    pub(super) d: Vec<f64>,
    pub(super) force: Vec<f64>,
    pub(super) y: Vec<Vector>,
    /// How it ended; its systems, and the orientation of the last one.
    pub(super) ending: Ending,
    pub(super) systems: u64,
    pub(super) orientation: i8,
    /// Where it is done and `eta` is above the tolerance: what was eliminated, and the point on the rest.
    parted: Option<(ReducedProblem<'w>, Point)>,
}

impl Found<'_> {
    /// The end at a point of the whole problem, after so many systems, with the orientation of the last one.
    pub(super) fn at(point: Point, ending: Ending, (systems, orientation): (u64, i8)) -> Self {
        let Point { y, d, force, .. } = point;
        Found { d, force, y, ending, systems, orientation, parted: None }
    }

    /// The candidate of equations that are a whole problem's.
    pub(super) fn into_candidate(self) -> Candidate {
        let effort = Effort::of_systems(self.systems);
        let mut candidate = Candidate::new(self.d, self.force, self.ending, effort);
        candidate.orientation = self.orientation;
        candidate
    }
}

/// Solves the equations from the coordinates `y`: by `core` on the candidates there, and on more of them
/// as long as others close.
pub(super) fn search<'w>(
    whole: &'w Equations<'w>,
    mut y: Vec<Vector>,
    tolerance: f64,
    monitor: &mut Monitor<'_>,
    core: &mut Core<'_>,
) -> Found<'w> {
    let mut kept = closed_with_margin(&whole.laws, &y, MARGIN);
    let (mut systems, mut orientation) = (0, 0);
    loop {
        let reduced = match ReducedProblem::of_candidates(whole, &kept, monitor) {
            Ok(Some(reduced)) => reduced,
            Ok(None) => {
                let Ended { point, ending, systems: last, orientation } = core(whole, y, monitor);
                return Found::at(point, ending, (systems + last, orientation));
            }
            Err(stop) => {
                let point = Point::new(whole, y);
                return Found::at(point, Ending::Stopped(stop), (systems, orientation));
            }
        };
        let ended = core(&reduced.equations(), reduced.of_kept(&y), monitor);
        systems += ended.systems;
        if ended.orientation != 0 {
            orientation = ended.orientation;
        }
        let Ended { point, ending, .. } = ended;
        let (d, force);
        (d, force, y) = reduced.whole_from(&point.d, &point.y);
        let done = ending == Ending::Done;
        let solved = done && whole.eta(&d, &force) <= tolerance;
        let closing = if solved { Vec::new() } else { reduced.closing(&y) };
        if !done || closing.is_empty() {
            let parted = (done && !solved).then_some((reduced, point));
            return Found { d, force, y, ending, systems, orientation, parted };
        }
        kept.extend(closing);
        kept.sort_unstable();
    }
}

/// Iterative refinement of a solution on the candidates by the residual of the whole problem, as long as there
/// is time. Returns the number of systems.
pub(super) fn refine(
    reduced: &ReducedProblem<'_>,
    contact: &Contact<'_>,
    settings: &Settings,
    (d, force): (&mut Vec<f64>, &mut Vec<f64>),
    mut point: Point,
    monitor: &mut Monitor<'_>,
) -> u64 {
    let elimination = reduced.elimination();
    let (dropped, kept) = (elimination.dropped(), elimination.kept());
    let mut systems = 0;
    let mut best = eta_of(contact, d, force);
    for _ in 0..REFINEMENTS {
        // The certificate also allows for the rounding of prescribed displacements.
        if measure(contact, d, force).holds(settings.tolerance) {
            break;
        }
        let mut next = d.clone();
        let mut lack: Vec<f64> = dropped.iter().map(|&i| force[i]).collect();
        elimination.solve(&mut lack);
        dropped.iter().zip(&lack).for_each(|(&i, lack)| next[i] -= lack);
        // A load under which the force of the candidates is that of the whole problem.
        let whole = reduced.whole().force(&next);
        let mut equations = reduced.equations();
        let mut load = equations.matrix.product(&point.d);
        load.iter_mut().zip(kept).for_each(|(load, &i)| *load -= whole[i]);
        equations.load = Cow::Owned(load);
        if monitor
            .affords(System::work(&equations, &equations.linearised(&point.pieces, &point.y)))
            .is_err()
        {
            break;
        }
        let Some(better) = iteration::step(&equations, &point) else { break };
        systems += 1;
        let moved: Vec<f64> = better.d.iter().zip(&point.d).map(|(b, a)| b - a).collect();
        let followed = elimination.follow(&vec![0.0; dropped.len()], &moved);
        kept.iter().zip(&better.d).for_each(|(&i, x)| next[i] = *x);
        dropped.iter().zip(&followed).for_each(|(&i, x)| next[i] += x);
        let residual = reduced.whole().force(&next);
        let eta = eta_of(contact, &next, &residual);
        if !(eta < best) {
            break;
        }
        (best, *d, *force, point) = (eta, next, residual, better);
    }
    systems
}
