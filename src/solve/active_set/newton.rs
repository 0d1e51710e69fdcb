//! Newton's method on the branches of the law (Alart and Curnier 1991), in 2D.
//!
//! The law is piecewise linear: the equations of a branch of every pair are solved exactly, and the
//! solution selects the next branches. When they are the same again it is the solution of the problem,
//! to rounding. A few sweeps between a solution and its branches carry a zone's edge over many pairs,
//! where Newton's step alone moves it by one: 3 to 11 systems on the bar on the plane up to 513 pairs,
//! 5 to 24 without. There is no merit function: the steps may cycle, which is detected by the branches
//! that were there before. Most cycles are slips that turn back from one system to the next. So there
//! is a second start then: more sweeps before it, none between its systems, and a pair whose slip would
//! turn back sticks first. On problems that need no second start these rules would only cost systems.

use super::linear_system::{LinearSystem, Singular};
use crate::certificate::{eta_of, measure};
use crate::law::Contact;
use crate::law::branch::{Branch, Row};
use crate::monitor::{Monitor, Stop};
use crate::settings::Settings;
use crate::solve::candidate::{Candidate, Effort, Ending};
use crate::solve::sweeps::Sweeper;

/// Systems of a start after which the steps count as a cycle: nearly all that converge take fewer.
const MOST_SYSTEMS: usize = 16;

/// Sweeps from the start to the branches of a second one, after a cycle. Of 332 hard problems with 257
/// pairs 14 are left unsolved, with 50 sweeps 17 and with 30 26.
const SWEEPS_OF_SECOND_START: u32 = 100;

/// Sweeps between a solution and its branches: two carry a zone's edge far enough.
const SWEEPS: u32 = 2;

/// Up to so many unknowns a linear system costs as much as a dozen sweeps, because its fixed costs
/// outweigh its arithmetic: there more sweeps save time wherever they save a system. The first
/// system, with all pairs sticking, is nearly free, and most is left to be found after it.
const FEW_UNKNOWNS: usize = 128;
const FIRST_SWEEPS_OF_FEW: u32 = 8;
const SWEEPS_OF_FEW: u32 = 4;

/// Solves from the branches on which `start` is, or from all pairs in contact and sticking.
pub fn solve(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let (branches, d) = match start {
        None => (contact.all_stick(), vec![0.0; contact.unknowns()]),
        Some(d) => (contact.branches(d, &contact.problem().force(d)), d.to_vec()),
    };
    from_branches(contact, settings, branches, d, monitor)
}

/// Solves from given branches; `d` is returned unchanged if no system could be solved.
pub fn from_branches(
    contact: &Contact<'_>,
    settings: &Settings,
    mut branches: Vec<Branch>,
    d: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let problem = contact.problem();
    let start = d.clone();
    let constant = problem.load().iter().map(|f| -f).collect();
    let mut system = LinearSystem::new(problem.stiffness(), true, contact.dim(), constant, d);
    let mut best = Best::at(&system, f64::INFINITY);
    let mut rows = Vec::with_capacity(contact.unknowns());
    let mut history = History::new(contact.unknowns());
    let ending = loop {
        if let Err(stop) = monitor.step() {
            break Ending::Stopped(stop);
        }
        select(contact, &branches, &mut rows);
        if let Err(stop) = monitor.affords(system.work(&rows)) {
            break Ending::Stopped(stop);
        }
        if let Err(Singular) = system.solve(&rows) {
            break Ending::Singular;
        }
        let eta = eta_of(contact, &system.x, &system.residual);
        monitor.measured(eta);
        best.keep(&system, eta);
        if contact.branches(&system.x, &system.residual) == branches {
            let refined = refine(&mut system, contact, &rows, settings.tolerance, monitor);
            best = Best::at(&system, 0.0);
            break refined.map_or_else(Ending::Stopped, |()| Ending::Done);
        }
        if let Err(ending) = history.advance(contact, &start, &system, &mut branches, monitor) {
            // At a degenerate solution rounding may flip the active set forever.
            let solved = ending == Ending::Cycle && best.eta <= settings.tolerance;
            break if solved { Ending::Done } else { ending };
        }
    };
    let effort = Effort { factorisations: system.factorisations, ..Effort::default() };
    let mut candidate = Candidate::new(best.d, best.force, ending, effort);
    candidate.orientation = best.orientation;
    candidate
}

/// The branches that were there before, and the way to the next ones.
struct History {
    seen: Vec<Vec<Branch>>,
    /// Sweeps to the next branches.
    sweeps: u32,
    /// Sweeps after all systems but the first.
    later_sweeps: u32,
    is_second_start: bool,
}

impl History {
    fn new(unknowns: usize) -> Self {
        let (sweeps, later_sweeps) = match unknowns <= FEW_UNKNOWNS {
            true => (FIRST_SWEEPS_OF_FEW, SWEEPS_OF_FEW),
            false => (SWEEPS, SWEEPS),
        };
        History { seen: Vec::new(), sweeps, later_sweeps, is_second_start: false }
    }

    /// Goes on to the branches that the solution of the last system selects, or to a second start.
    fn advance(
        &mut self,
        contact: &Contact<'_>,
        start: &[f64],
        system: &LinearSystem<'_>,
        branches: &mut Vec<Branch>,
        monitor: &Monitor<'_>,
    ) -> Result<(), Ending> {
        let mut next = swept(contact, (&system.x, &system.residual), self.sweeps, monitor);
        self.sweeps = self.later_sweeps;
        if self.is_second_start {
            let pairs = contact.pairs().iter().zip(branches.iter());
            for (next, (law, before)) in next.iter_mut().zip(pairs) {
                *next = before.without_reversal(law, *next);
            }
        }
        self.seen.push(std::mem::replace(branches, next));
        let repeats = self.seen.contains(branches);
        if !repeats && self.seen.len() < MOST_SYSTEMS {
            return Ok(());
        }
        if self.is_second_start {
            let slow = Ending::Stalled("Newton's method does not converge");
            return Err(if repeats { Ending::Cycle } else { slow });
        }
        (self.sweeps, self.later_sweeps) = (0, 0);
        self.is_second_start = true;
        self.seen.clear();
        let d = contact.admissible(start);
        let force = contact.problem().force(&d);
        *branches = swept(contact, (&d, &force), SWEEPS_OF_SECOND_START, monitor);
        Ok(())
    }
}

/// The best iterate so far.
struct Best {
    eta: f64,
    d: Vec<f64>,
    force: Vec<f64>,
    orientation: i8,
}

impl Best {
    fn at(system: &LinearSystem<'_>, eta: f64) -> Self {
        let (d, force) = (system.x.clone(), system.residual.clone());
        Best { eta, d, force, orientation: system.orientation }
    }

    fn keep(&mut self, system: &LinearSystem<'_>, eta: f64) {
        if eta < self.eta {
            self.eta = eta;
            self.d.clone_from(&system.x);
            self.force.clone_from(&system.residual);
            self.orientation = system.orientation;
        }
    }
}

/// The equations of all unknowns on the branches.
fn select(contact: &Contact<'_>, branches: &[Branch], rows: &mut Vec<Row>) {
    rows.clear();
    for (law, branch) in contact.pairs().iter().zip(branches) {
        rows.extend_from_slice(&branch.rows(law)[..contact.dim()]);
    }
}

/// The branches on which displacements with their force are after some sweeps, fewer if the time is up.
fn swept(
    contact: &Contact<'_>,
    (d, force): (&[f64], &[f64]),
    sweeps: u32,
    monitor: &Monitor<'_>,
) -> Vec<Branch> {
    let (mut d, mut force) = (d.to_vec(), force.to_vec());
    let sweeper = Sweeper::new();
    for _ in 0..sweeps {
        if monitor.is_late() {
            break;
        }
        sweeper.sweep(contact, (&mut d, &mut force), 1.0);
    }
    contact.branches(&d, &force)
}

/// Brings the solution of the last system to `tolerance` where rounding has not. `Err`: there is no time for it.
fn refine(
    system: &mut LinearSystem<'_>,
    contact: &Contact<'_>,
    rows: &[Row],
    tolerance: f64,
    monitor: &mut Monitor<'_>,
) -> Result<(), Stop> {
    system.refine(
        rows,
        |d, force| eta_of(contact, d, force),
        // The certificate also allows for the rounding of prescribed displacements.
        |d, eta| eta <= tolerance || measure(contact, d, &[]).holds(tolerance),
        monitor,
    )
}
