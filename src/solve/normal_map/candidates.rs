//! Candidate elimination: pairs that are surely open leave the equations by one Cholesky factorisation.
//!
//! After the sweeps the set of open pairs is nearly final. With `O` the pairs that are far from contact
//! and `C` the candidates, `K_OO d_O + K_OC d_C = f_O` holds as long as `O` stays open, so that the
//! contact problem on `C` alone has the matrix `S = K_CC - K_CO K_OO⁻¹ K_OC`. It is solved with all
//! states allowed. If a pair of `O` then penetrates, it joins `C`, and the problem is solved again: this
//! ends, as each pass adds pairs. The result is measured and refined on the whole problem.

use std::borrow::Cow;
use std::sync::Arc;

use super::equations::{Equations, Point};
use super::newton::Ended;
use super::system::System;
use crate::certificate::{eta_of, measure};
use crate::law::{Contact, Vector};
use crate::linalg::elimination::Elimination;
use crate::monitor::{Monitor, Stop};
use crate::settings::Settings;
use crate::solve::candidate::{Candidate, Effort, Ending};

/// Candidates beside the pairs that the sweeps have closed: a part of these, and a few.
const MARGIN: f64 = 0.15;
const FEW: usize = 2;

/// Fewer components are not worth their elimination.
const WORTHWHILE: usize = 24;

/// Why there is no start.
const OVERFLOW: &str = "the forces are beyond the largest number";

/// Steps of iterative refinement on the whole problem: each gains nearly all digits of a system.
const REFINEMENTS: usize = 3;

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
        return Candidate::without_displacements(contact, Ending::Stalled(OVERFLOW));
    }
    let mut found = search(whole, y, settings.tolerance, monitor, core);
    if let Some((split, point)) = found.parted.take() {
        let parts = (&mut found.d, &mut found.force);
        let systems = split.refine(contact, settings, parts, point, monitor);
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
    parted: Option<(Split<'w>, Point)>,
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
    let mut kept = closed_with_margin(whole, &y, MARGIN);
    let (mut systems, mut orientation) = (0, 0);
    loop {
        let split = match Split::new(whole, &kept, monitor) {
            Ok(Some(split)) => split,
            Ok(None) => {
                let Ended { point, ending, systems: last, orientation } = core(whole, y, monitor);
                return Found::at(point, ending, (systems + last, orientation));
            }
            Err(stop) => {
                let point = Point::new(whole, y);
                return Found::at(point, Ending::Stopped(stop), (systems, orientation));
            }
        };
        let ended = core(&split.equations(), split.of_kept(&y), monitor);
        systems += ended.systems;
        if ended.orientation != 0 {
            orientation = ended.orientation;
        }
        let Ended { point, ending, .. } = ended;
        let (d, force);
        (d, force, y) = split.whole_from(&point.d, &point.y);
        let done = ending == Ending::Done;
        let solved = done && whole.eta(&d, &force) <= tolerance;
        let closing = if solved { Vec::new() } else { split.closing(&y) };
        if !done || closing.is_empty() {
            let parted = (done && !solved).then_some((split, point));
            return Found { d, force, y, ending, systems, orientation, parted };
        }
        kept.extend(closing);
        kept.sort_unstable();
    }
}

/// The pairs that are closed, those next to closing, and those that carry forces when they are open.
pub(super) fn closed_with_margin(whole: &Equations<'_>, y: &[Vector], margin: f64) -> Vec<usize> {
    let pieces = whole.pieces(y);
    let closed = pieces.iter().filter(|piece| piece.closed).count();
    let wanted = closed + (margin * closed as f64).ceil() as usize + FEW;
    let mut order: Vec<usize> =
        (0..y.len()).filter(|&pair| whole.laws[pair].has_obstacle()).collect();
    order.sort_by(|&a, &b| {
        let height = |pair: usize| y[pair][0] / whole.root[whole.dim * pair];
        height(b).total_cmp(&height(a))
    });
    order.truncate(wanted);
    order.extend((0..y.len()).filter(|&pair| !whole.laws[pair].is_free_when_open()));
    order.sort_unstable();
    order.dedup();
    order
}

/// A problem parted into candidates and open pairs.
pub(super) struct Split<'w> {
    whole: &'w Equations<'w>,
    elimination: Arc<Elimination>,
    load: Vec<f64>,
}

impl<'w> Split<'w> {
    /// Eliminates all pairs but `kept`; `None` if that is not worthwhile, or not possible. `Err`: there is no time
    /// for it.
    pub(super) fn new(
        whole: &'w Equations<'w>,
        kept: &[usize],
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Self>, Stop> {
        let dim = whole.dim;
        let parts = |pair: &usize| dim * pair..dim * (pair + 1);
        let mut is_kept = vec![false; whole.laws.len()];
        kept.iter().for_each(|&pair| is_kept[pair] = true);
        let dropped: Vec<usize> = (0..is_kept.len())
            .filter(|&pair| !is_kept[pair])
            .flat_map(|pair| parts(&pair))
            .collect();
        if dropped.len() < WORTHWHILE || kept.is_empty() || !whole.symmetric {
            return Ok(None);
        }
        let components: Vec<usize> = kept.iter().flat_map(parts).collect();
        monitor.affords(Elimination::work(dropped.len(), components.len()))?;
        let elimination = Elimination::new(whole.matrix, dropped, components);
        Ok(elimination.map(|elimination| Self::by(whole, Arc::new(elimination))))
    }

    /// The problem parted by an elimination of components of its matrix.
    pub(super) fn by(whole: &'w Equations<'w>, elimination: Arc<Elimination>) -> Self {
        let on_dropped: Vec<f64> = elimination.dropped().iter().map(|&i| whole.load[i]).collect();
        let taken = elimination.transfer(&on_dropped);
        let kept = elimination.kept().iter().zip(taken);
        let load = kept.map(|(&i, taken)| whole.load[i] - taken).collect();
        Split { whole, elimination, load }
    }

    /// What is eliminated.
    pub(super) fn elimination(&self) -> &Arc<Elimination> {
        &self.elimination
    }

    /// The pairs of some components.
    fn pairs<'s>(&'s self, components: &'s [usize]) -> impl Iterator<Item = usize> + 's {
        components.iter().step_by(self.whole.dim).map(|i| i / self.whole.dim)
    }

    /// The candidates.
    pub(super) fn kept(&self) -> impl Iterator<Item = usize> + '_ {
        self.pairs(self.elimination.kept())
    }

    /// What belongs to the candidates of something that each pair has.
    pub(super) fn of_kept(&self, y: &[Vector]) -> Vec<Vector> {
        self.kept().map(|pair| y[pair]).collect()
    }

    /// The equations of the candidates.
    pub(super) fn equations(&self) -> Equations<'_> {
        let laws = self.kept().map(|pair| self.whole.laws[pair]).collect();
        let load = Cow::Borrowed(self.load.as_slice());
        let matrix = self.elimination.schur();
        Equations::new(self.whole.dim, matrix, load, Cow::Owned(laws), self.whole.unit)
    }

    /// All displacements, with the force that they need and the coordinates, from displacements and coordinates
    /// of the candidates.
    pub(super) fn whole_from(&self, d: &[f64], y: &[Vector]) -> (Vec<f64>, Vec<f64>, Vec<Vector>) {
        let d = self.expand(d);
        let force = self.whole.force(&d);
        let mut all = self.whole.coordinates(&d, &force);
        self.kept().zip(y).for_each(|(pair, own)| all[pair] = *own);
        (d, force, all)
    }

    /// All displacements from those of the candidates.
    fn expand(&self, on_kept: &[f64]) -> Vec<f64> {
        let (dropped, kept) = (self.elimination.dropped(), self.elimination.kept());
        let load: Vec<f64> = dropped.iter().map(|&i| self.whole.load[i]).collect();
        let on_dropped = self.elimination.follow(&load, on_kept);
        let mut d = vec![0.0; self.whole.root.len()];
        kept.iter().zip(on_kept).for_each(|(&i, x)| d[i] = *x);
        dropped.iter().zip(on_dropped).for_each(|(&i, x)| d[i] = x);
        d
    }

    /// Eliminated pairs that are not open at the coordinates `y` of all pairs.
    pub(super) fn closing(&self, y: &[Vector]) -> Vec<usize> {
        let pieces = self.whole.pieces(y);
        self.pairs(self.elimination.dropped()).filter(|&pair| pieces[pair].closed).collect()
    }

    /// Iterative refinement of a solution on the candidates by the residual of the whole problem, as long as there
    /// is time. Returns the number of systems.
    pub(super) fn refine(
        &self,
        contact: &Contact<'_>,
        settings: &Settings,
        (d, force): (&mut Vec<f64>, &mut Vec<f64>),
        mut point: Point,
        monitor: &mut Monitor<'_>,
    ) -> u64 {
        let (dropped, kept) = (self.elimination.dropped(), self.elimination.kept());
        let mut systems = 0;
        let mut best = eta_of(contact, d, force);
        for _ in 0..REFINEMENTS {
            // The certificate also allows for the rounding of prescribed displacements.
            if measure(contact, d, force).holds(settings.tolerance) {
                break;
            }
            let mut next = d.clone();
            let mut lack: Vec<f64> = dropped.iter().map(|&i| force[i]).collect();
            self.elimination.solve(&mut lack);
            dropped.iter().zip(&lack).for_each(|(&i, lack)| next[i] -= lack);
            // A load under which the force of the candidates is that of the whole problem.
            let whole = self.whole.force(&next);
            let mut equations = self.equations();
            let mut load = equations.matrix.product(&point.d);
            load.iter_mut().zip(kept).for_each(|(load, &i)| *load -= whole[i]);
            equations.load = Cow::Owned(load);
            if monitor.affords(System::work(&equations, &point.pieces)).is_err() {
                break;
            }
            let Some(better) = super::newton::step(&equations, &point) else { break };
            systems += 1;
            let moved: Vec<f64> = better.d.iter().zip(&point.d).map(|(b, a)| b - a).collect();
            let followed = self.elimination.follow(&vec![0.0; dropped.len()], &moved);
            kept.iter().zip(&better.d).for_each(|(&i, x)| next[i] = *x);
            dropped.iter().zip(&followed).for_each(|(&i, x)| next[i] += x);
            let residual = self.whole.force(&next);
            let eta = eta_of(contact, &next, &residual);
            if !(eta < best) {
                break;
            }
            (best, *d, *force, point) = (eta, next, residual, better);
        }
        systems
    }
}
