//! Block principal pivoting on an LCP (Júdice and Pires 1994): exchange all variables that violate
//! their condition at once; when their number has not fallen for as many systems as there are
//! variables, exchange the last of them only (Murty 1974) until it does. Finite for positive definite
//! matrices.
//!
//! Contact without friction is the LCP in `x = -d` with `M = K` and the bounds `-gap`; tangential
//! components are free. Starting with all pairs closed keeps the first system small, tangential
//! components only, and a few sweeps from its solution tell nearly all pairs that open; sweeps follow
//! each later solution too, as long as they help.

use crate::linalg::vector::opposite;
use std::cell::Cell;

use super::past::Past;
use super::refinement::Task;
use crate::law::Linearised;
use crate::law::complementarity::lower_bounds;
use crate::monitor::{Stop, Watch};
use crate::problem::symmetric_matrix::is_symmetric_beside;
use crate::problem::{BoundedLcp, LcpCertificate};
use crate::settings::{Method, Settings};
use crate::solve::pieces::{Before, Equations, REFINEMENTS, SMALL, Systems};
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::sweeps::sweep_lcp;

/// Sweeps between a solution and its active set: they cost a small part of the system that they may save.
const SWEEPS: u32 = 2;

/// Systems after which a problem of `n` complementary variables is left to another method, if the host has not chosen this
/// one: single exchanges may take `2^n`; whole blocks take a few, or at most about `n` on the worst problems known. Twice
/// that and 50 more end no run that converges.
fn most_systems(is_chosen: bool, n: usize) -> u64 {
    if is_chosen { u64::MAX } else { 50 + 2 * n as u64 }
}

/// Solves frictionless contact from the active set of the start, or from all pairs closed.
pub fn contact(call: &Call<'_>) -> Candidate {
    let (contact, settings, problem) = (call.contact, call.settings, call.contact.problem());
    let lower = lower_bounds(contact);
    let lcp = BoundedLcp {
        matrix: problem.stiffness(),
        q: contact.load_with_tension(),
        lower: &lower,
        symmetric: true,
        remembered: problem.remembered(),
    };
    let start = call.start.map(opposite);
    let measured = Cell::new(None);
    let measure = |x: &[f64]| {
        let candidate = Candidate::new(opposite(x), Vec::new(), Ending::Done, Effort::default());
        let certificate = candidate.certificate(contact);
        let holds = certificate.holds(settings.tolerance);
        let force = certificate.raw.clone();
        let loads = lcp.q.iter().zip(problem.load());
        let w = force.iter().zip(loads).map(|(force, (q, load))| (q - load) - force).collect();
        measured.set(Some(candidate.with_force(force)));
        (holds, w)
    };
    let most = most_systems(call.is_chosen(), contact.pairs().len());
    let pivoted = solve(&lcp, settings.tolerance, start, most, &measure, call.monitor);
    let d = opposite(pivoted.d());
    // The basis that was measured last is nearly always the one on which block pivoting ends.
    let measured = measured.take().filter(|candidate: &Candidate| candidate.d() == d);
    let mut candidate = measured.unwrap_or_else(|| {
        let mut force = opposite(pivoted.force());
        contact.add_tension(&mut force);
        Candidate::new(d, force, Ending::Done, Effort::default())
    });
    (candidate.ending, candidate.effort) = (pivoted.ending, pivoted.effort);
    (candidate.orientation, candidate.definite) = (pivoted.orientation, pivoted.definite);
    candidate
}

/// Solves an LCP whose matrix has a positive diagonal, from all variables at their bounds. The candidate has `x` for
/// displacements and `w` for forces.
pub fn lcp(task: Task<'_>) -> Candidate {
    let Task { lcp, magnitudes, settings: &Settings { tolerance, method, .. }, monitor } = task;
    let zero = vec![0.0; lcp.size()];
    let bounded = BoundedLcp {
        matrix: lcp.matrix,
        q: lcp.q(),
        lower: &zero,
        symmetric: is_symmetric_beside(&lcp.matrix, &lcp.matrix.diagonal_roots()),
        remembered: None,
    };
    let measure = |x: &[f64]| {
        let LcpCertificate { eta, w, .. } = lcp.measure((x, &[]), magnitudes);
        (eta <= tolerance, w)
    };
    let most = most_systems(method == Method::BlockPivoting, lcp.size());
    solve(&bounded, tolerance, None, most, &measure, monitor)
}

/// Tells if variables are accurate enough, and their `w`.
type Measure<'m> = dyn Fn(&[f64]) -> (bool, Vec<f64>) + 'm;

/// As [`lcp`], of a bounded one; after `most` systems it gives up.
fn solve(
    lcp: &BoundedLcp<'_>,
    tolerance: f64,
    start: Option<Vec<f64>>,
    most: u64,
    measure: &Measure<'_>,
    monitor: &dyn Watch,
) -> Candidate {
    let equations = Equations::of_lcp(lcp);
    let mut systems = Systems::of(&equations, monitor);
    let before = systems.before(start.as_deref());
    // The solution on the active set of the one before is nearly always the one: it is measured at once.
    let mut near = before.is_some().then_some(measure);
    let (mut basic, x, w) = begin(lcp, before, start);
    let mut iterate = Iterate { lcp, root: &equations.root, systems, w, x, is_accurate: None };
    let mut best = (f64::INFINITY, iterate.x.clone(), iterate.w.clone());
    let mut exchange = Exchange::new(lcp);
    let last = monitor.iterations().saturating_add(most);
    let ending = loop {
        if monitor.iterations() >= last {
            break Ending::Stalled("block pivoting does not converge");
        }
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        if let Err(ending) = iterate.solve(&basic, near.take()) {
            break ending;
        }
        let eta = lcp.eta(&iterate.x, &iterate.w);
        monitor.measured(eta);
        if eta < best.0 {
            best = (eta, iterate.x.clone(), iterate.w.clone());
        }
        let next = active_set(lcp, &iterate.x, &iterate.w);
        if next == basic {
            let refined = iterate.refine(&basic, measure);
            best = (0.0, std::mem::take(&mut iterate.x), std::mem::take(&mut iterate.w));
            break refined.map_or_else(Ending::Stopped, |()| Ending::Done);
        }
        match exchange.choose(&iterate, &mut basic, next) {
            Ok(true) => {}
            // At a degenerate solution rounding may flip the active set forever.
            _ if best.0 <= tolerance && measure(&best.1).0 => break Ending::Done,
            Ok(false) => {}
            Err(ending) => break ending,
        }
    };
    let ((_, x, w), systems) = (best, iterate.systems);
    let mut found = Candidate::new(x, w, ending, Effort::of_systems(systems.factorisations));
    // Variables that are all at their bounds have the system of the identity.
    let is_factorised = basic.contains(&true);
    found.orientation = if is_factorised { systems.orientation() } else { 1 };
    found.definite = match found.ending {
        Ending::Done if is_factorised => systems.definite(&mut monitor.asking()),
        Ending::Done => basic.clone(),
        _ => Vec::new(),
    };
    systems.leave(|| Before::of_variables(&basic, (found.d(), found.force()), lcp.q));
    found
}

/// The active set, the variables and their `w` at which a solution begins: where the one before has ended, at the start, or
/// at zero.
fn begin(
    lcp: &BoundedLcp<'_>,
    before: Option<Before>,
    start: Option<Vec<f64>>,
) -> (Vec<bool>, Vec<f64>, Vec<f64>) {
    if let Some(Before { pieces, d, product, .. }) = before {
        let basic = pieces.iter().map(|piece| !piece.closed).collect();
        let w = product.iter().zip(lcp.q).map(|(product, q)| product + q).collect();
        return (basic, d, w);
    }
    let is_given = start.is_some();
    let x = start.unwrap_or_else(|| vec![0.0; lcp.q.len()]);
    let w = lcp.w(&x);
    let basic = match is_given {
        true => active_set(lcp, &x, &w),
        false => (0..x.len()).map(|i| lcp.is_free(i)).collect(),
    };
    (basic, x, w)
}

/// An iterate with its `w`.
struct Iterate<'l> {
    lcp: &'l BoundedLcp<'l>,
    /// Roots of the units of the variables.
    root: &'l [f64],
    systems: Systems<'l>,
    x: Vec<f64>,
    w: Vec<f64>,
    /// True if these are accurate enough; `None`: they are not measured.
    is_accurate: Option<bool>,
}

impl Iterate<'_> {
    /// Goes to the solution in which the basic variables have no `w`, and the others are at their bounds. What is `near` is
    /// measured in the place of a product with the step.
    fn solve(&mut self, basic: &[bool], near: Option<&Measure<'_>>) -> Result<(), Ending> {
        let lcp = self.lcp;
        self.is_accurate = None;
        let mut step = vec![0.0; self.x.len()];
        for i in (0..step.len()).filter(|&i| !basic[i]) {
            step[i] = lcp.lower[i] - self.x[i];
            self.x[i] = lcp.lower[i];
        }
        lcp.matrix.add_product(&step, &mut self.w);
        if basic.contains(&true) {
            let pair = |(&basic, root): (&bool, &f64)| Linearised::of_variable(basic, root * root);
            let pairs: Vec<Linearised> = basic.iter().zip(self.root).map(pair).collect();
            self.systems.go_to(pairs)?;
            let lack = self.w.iter().zip(basic).map(|(&w, &basic)| if basic { w } else { 0.0 });
            step = self.systems.motion(&lack.collect::<Vec<f64>>())?;
            self.x.iter_mut().zip(&step).for_each(|(x, step)| *x += step);
            if near.is_none() {
                lcp.matrix.add_product(&step, &mut self.w);
                // Its worth is measured where it ends.
                let solved = self.w.iter_mut().zip(basic).filter(|(_, basic)| **basic);
                solved.for_each(|(w, _)| *w = 0.0);
            }
        }
        near.map(|measure| self.is_accurate(measure));
        Ok(())
    }

    /// True if the variables are accurate enough, whose `w` is measured then.
    fn is_accurate(&mut self, measure: &Measure<'_>) -> bool {
        *self.is_accurate.get_or_insert_with(|| {
            let is_accurate;
            (is_accurate, self.w) = measure(&self.x);
            is_accurate
        })
    }

    /// Brings the solution of the last system to the accuracy that `measure` asks for, if rounding has left less.
    /// `Err`: there is no time for more of it.
    fn refine(&mut self, basic: &[bool], measure: &Measure<'_>) -> Result<(), Stop> {
        let mut best = f64::INFINITY;
        for _ in 0..=REFINEMENTS {
            if self.is_accurate(measure) {
                break;
            }
            let eta = self.lcp.eta(&self.x, &self.w);
            if eta >= best {
                self.systems.forget();
            }
            best = best.min(eta);
            let before = self.x.clone();
            match self.solve(basic, None) {
                Ok(()) => {}
                Err(Ending::Stopped(stop)) => return Err(stop),
                Err(_) => {
                    self.x = before;
                    break;
                }
            }
        }
        Ok(())
    }
}

/// Which variables are exchanged: blocks as long as that helps.
struct Exchange {
    /// Fewest variables that violated their condition so far.
    fewest: usize,
    /// Systems without progress that are left before single exchanges.
    patience: usize,
    /// As many as there are complementary variables: on the worst problems of single exchanges, which take `2^n`, whole
    /// blocks need `n`.
    most_patience: usize,
    /// A set of single exchanges, which end where it comes back.
    past: Past,
}

impl Exchange {
    fn new(lcp: &BoundedLcp<'_>) -> Self {
        let complementary = (0..lcp.q.len()).filter(|&i| !lcp.is_free(i)).count();
        let (fewest, patience) = (usize::MAX, complementary);
        Exchange { fewest, patience, most_patience: patience, past: Past::default() }
    }

    /// Changes `basic`, of which the solution of the system selects `next`. True: fewer variables than ever violate their
    /// condition. `Err`: single exchanges have come to a set of variables again.
    fn choose(
        &mut self,
        iterate: &Iterate<'_>,
        basic: &mut Vec<bool>,
        next: Vec<bool>,
    ) -> Result<bool, Ending> {
        let violated = || (0..next.len()).filter(|&i| next[i] != basic[i]);
        let count = violated().count();
        let progress = count < self.fewest;
        if progress {
            (self.fewest, self.patience) = (count, self.most_patience);
            self.past = Past::default();
        }
        if self.patience > 0 {
            self.patience -= usize::from(!progress);
            let sweeps_help = iterate.lcp.symmetric && progress;
            *basic = if sweeps_help { swept(iterate, basic) } else { next };
        } else if self.past.repeats(basic) {
            return Err(Ending::Cycle);
        } else if let Some(single) = violated().next_back() {
            basic[single] = next[single];
        }
        Ok(progress)
    }
}

/// True if each variable is off its bound.
fn active_set(lcp: &BoundedLcp<'_>, x: &[f64], w: &[f64]) -> Vec<bool> {
    (0..x.len()).map(|i| lcp.is_basic(i, x, w)).collect()
}

/// The active set after some sweeps, which the iterate does not keep. Where the fixed costs of a system outweigh its
/// arithmetic more of them save systems.
fn swept(iterate: &Iterate<'_>, basic: &[bool]) -> Vec<bool> {
    let (lcp, mut x, mut w) = (iterate.lcp, iterate.x.clone(), iterate.w.clone());
    let is_small = basic.iter().filter(|basic| **basic).count() < SMALL;
    for _ in 0..if is_small { 3 * SWEEPS } else { SWEEPS } {
        sweep_lcp(lcp, &mut x, &mut w, 1.0);
    }
    active_set(lcp, &x, &w)
}
