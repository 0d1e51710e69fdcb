//! Candidate elimination: pairs that are surely open leave the equations by one Cholesky factorisation.
//!
//! After the sweeps the set of open pairs is nearly final. With `O` the pairs that are far from contact
//! and `C` the candidates, `K_OO d_O + K_OC d_C = f_O` holds as long as `O` stays open, so that the
//! contact problem on `C` alone has the matrix `S = K_CC - K_CO K_OO⁻¹ K_OC`. It is solved with all
//! states allowed. If a pair of `O` then penetrates, it joins `C`, and the problem is solved again: this
//! ends, as each pass adds pairs. The result is measured and refined on the whole problem.

use std::borrow::Cow;

use super::equations::{Equations, Point};
use super::newton::Ended;
use super::start::swept;
use crate::certificate::{eta_of, measure};
use crate::law::{Contact, Vector};
use crate::linalg::elimination::Elimination;
use crate::linalg::matrix::Matrix;
use crate::monitor::Monitor;
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
    let mut y = swept(contact, &whole, start);
    if !y.iter().flatten().all(|y| y.is_finite()) {
        return Candidate::without_displacements(contact, Ending::Stalled(OVERFLOW));
    }
    let mut kept = closed_with_margin(&whole, &y);
    let (mut systems, mut orientation) = (0, 0);
    loop {
        let split = Split::new(&whole, &kept);
        let Some(split) = split else {
            let ended = core(&whole, y, monitor);
            systems += ended.systems;
            return Ended { systems, ..ended }.into_candidate();
        };
        let on_kept = split.kept.iter().map(|&pair| y[pair]).collect();
        let ended = core(&split.equations(), on_kept, monitor);
        systems += ended.systems;
        if ended.orientation != 0 {
            orientation = ended.orientation;
        }
        let mut d = split.expand(&ended.point.d);
        let mut force = whole.force(&d);
        let stopped = ended.ending != Ending::Done;
        let eta = eta_of(contact, &d, &force);
        if !stopped && eta <= settings.tolerance {
            return candidate(d, force, Ending::Done, systems, orientation);
        }
        y = whole.coordinates(&d, &force);
        for (&pair, own) in split.kept.iter().zip(&ended.point.y) {
            y[pair] = *own;
        }
        let closing = split.closing(&y);
        if stopped || closing.is_empty() {
            if !stopped {
                systems += split.refine(contact, settings, &mut d, &mut force, ended.point);
            }
            return candidate(d, force, ended.ending, systems, orientation);
        }
        kept.extend(closing);
        kept.sort_unstable();
    }
}

fn candidate(
    d: Vec<f64>,
    force: Vec<f64>,
    ending: Ending,
    factorisations: u64,
    orientation: i8,
) -> Candidate {
    let effort = Effort { factorisations, ..Effort::default() };
    let mut candidate = Candidate::new(d, force, ending, effort);
    candidate.orientation = orientation;
    candidate
}

/// The pairs that are closed, those next to closing, and those that carry forces when they are open.
fn closed_with_margin(whole: &Equations<'_>, y: &[Vector]) -> Vec<usize> {
    let pieces = whole.pieces(y);
    let closed = pieces.iter().filter(|piece| piece.closed).count();
    let wanted = closed + (MARGIN * closed as f64).ceil() as usize + FEW;
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
struct Split<'w> {
    whole: &'w Equations<'w>,
    /// Pairs that are kept.
    kept: Vec<usize>,
    /// Their components, and those of the others.
    components: Vec<usize>,
    dropped: Vec<usize>,
    elimination: Elimination,
    schur: Vec<f64>,
    load: Vec<f64>,
}

impl<'w> Split<'w> {
    /// Eliminates all pairs but `kept`; `None` if that is not worthwhile, or not possible.
    fn new(whole: &'w Equations<'w>, kept: &[usize]) -> Option<Self> {
        let dim = whole.dim;
        let parts = |pair: &usize| dim * pair..dim * (pair + 1);
        let components: Vec<usize> = kept.iter().flat_map(parts).collect();
        let mut is_kept = vec![false; whole.laws.len()];
        kept.iter().for_each(|&pair| is_kept[pair] = true);
        let dropped: Vec<usize> = (0..is_kept.len())
            .filter(|&pair| !is_kept[pair])
            .flat_map(|pair| parts(&pair))
            .collect();
        if dropped.len() < WORTHWHILE || kept.is_empty() || !whole.symmetric {
            return None;
        }
        let (elimination, schur) = Elimination::new(whole.matrix, &dropped, &components)?;
        let on_dropped: Vec<f64> = dropped.iter().map(|&i| whole.load[i]).collect();
        let taken = elimination.transfer(&on_dropped);
        let load = components.iter().zip(taken).map(|(&i, taken)| whole.load[i] - taken).collect();
        Some(Split { whole, kept: kept.to_vec(), components, dropped, elimination, schur, load })
    }

    /// The equations of the candidates.
    fn equations(&self) -> Equations<'_> {
        let size = self.components.len();
        let laws = self.kept.iter().map(|&pair| self.whole.laws[pair]).collect();
        let matrix = Matrix::new(size, &self.schur, size);
        let load = Cow::Borrowed(self.load.as_slice());
        Equations::new(self.whole.dim, matrix, load, Cow::Owned(laws), self.whole.unit)
    }

    /// All displacements from those of the candidates.
    fn expand(&self, on_kept: &[f64]) -> Vec<f64> {
        let load: Vec<f64> = self.dropped.iter().map(|&i| self.whole.load[i]).collect();
        let on_dropped = self.elimination.follow(&load, on_kept);
        let mut d = vec![0.0; self.whole.root.len()];
        self.components.iter().zip(on_kept).for_each(|(&i, x)| d[i] = *x);
        self.dropped.iter().zip(on_dropped).for_each(|(&i, x)| d[i] = x);
        d
    }

    /// Eliminated pairs that are not open at the coordinates `y` of all pairs.
    fn closing(&self, y: &[Vector]) -> Vec<usize> {
        let pieces = self.whole.pieces(y);
        let first = |at: usize| self.dropped[at] / self.whole.dim;
        let dropped = (0..self.dropped.len()).step_by(self.whole.dim).map(first);
        dropped.filter(|&pair| pieces[pair].closed).collect()
    }

    /// Iterative refinement of a solution on the candidates by the residual of the whole problem.
    /// Returns the number of systems.
    fn refine(
        &self,
        contact: &Contact<'_>,
        settings: &Settings,
        d: &mut Vec<f64>,
        force: &mut Vec<f64>,
        mut point: Point,
    ) -> u64 {
        let mut systems = 0;
        let mut best = eta_of(contact, d, force);
        for _ in 0..REFINEMENTS {
            // The certificate also allows for the rounding of prescribed displacements.
            if measure(contact, d, force).holds(settings.tolerance) {
                break;
            }
            let mut next = d.clone();
            let mut lack: Vec<f64> = self.dropped.iter().map(|&i| force[i]).collect();
            self.elimination.solve(&mut lack);
            self.dropped.iter().zip(&lack).for_each(|(&i, lack)| next[i] -= lack);
            // A load under which the force of the candidates is that of the whole problem.
            let whole = self.whole.force(&next);
            let mut equations = self.equations();
            let mut load = equations.matrix.product(&point.d);
            load.iter_mut().zip(&self.components).for_each(|(load, &i)| *load -= whole[i]);
            equations.load = Cow::Owned(load);
            let Some(better) = super::newton::step(&equations, &point) else { break };
            systems += 1;
            let moved: Vec<f64> = better.d.iter().zip(&point.d).map(|(b, a)| b - a).collect();
            let followed = self.elimination.follow(&vec![0.0; self.dropped.len()], &moved);
            self.components.iter().zip(&better.d).for_each(|(&i, x)| next[i] = *x);
            self.dropped.iter().zip(&followed).for_each(|(&i, x)| next[i] += x);
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
