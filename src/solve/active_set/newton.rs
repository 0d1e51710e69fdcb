//! Newton's method on the branches of the law (Alart and Curnier 1991), in 2D.
//!
//! The law is piecewise linear: the equations of a branch of every pair are solved exactly, and the
//! solution selects the next branches. When they are the same again it is the solution of the problem,
//! to rounding. A few sweeps between a solution and its branches carry a zone's edge over many pairs,
//! where Newton's step alone moves it by one: 3 to 11 systems on the bar on the plane up to 513 pairs,
//! 5 to 24 without. There is no merit function: the steps may cycle, which is detected by the branches
//! that were there before, or by systems that no longer change fewer pairs. Most cycles are slips that turn back
//! from one system to the next. So there are further starts then: more sweeps before them, none between their
//! systems, and a pair whose slip would turn back sticks first. They are made on the pairs in question
//! ([`crate::solve::undecided`]), or on all where these are not few. On problems that need no further start
//! these rules would only cost systems.

use super::linear_system::{LinearSystem, Singular};
use crate::certificate::{eta_of, measure};
use crate::law::Contact;
use crate::law::branch::{Branch, Row};
use crate::monitor::{Monitor, Stop};
use crate::settings::Settings;
use crate::solve::candidate::{Candidate, Effort, Ending};
use crate::solve::sweeps::Sweeper;
use crate::solve::undecided::{self, Ended};

/// Systems of a start after which the steps count as a cycle: nearly all that converge take fewer.
const MOST_SYSTEMS: usize = 16;

/// Systems without one that changes the branches of fewer pairs than all before, after which the steps count as a
/// cycle: with more, those that do not converge take longer; with less, more of the others go to the pairs in question.
const PATIENCE: usize = 2;

/// Sweeps from the start to the branches of a second one. Of 332 hard problems with 257
/// pairs 14 are left unsolved, with 50 sweeps 17 and with 30 26.
const SWEEPS_OF_SECOND_START: u32 = 100;

/// Sweeps before each start on the pairs in question.
const SWEEPS_ON_UNDECIDED: [u32; 2] = [3, 20];

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
    let first = from_branches(contact, settings, branches, d.clone(), monitor);
    if !matches!(first.ending, Ending::Cycle | Ending::Stalled(_)) {
        return first;
    }
    let mut core = |part: &Contact<'_>, d: &[f64], monitor: &mut Monitor<'_>| {
        on_undecided(part, settings, d, monitor)
    };
    let (ended, systems) = undecided::solve(contact, settings, &first.d, monitor, &mut core);
    let systems = systems + first.effort.factorisations;
    let further = match ended {
        Ended::Settled(branches, d) => from_branches(contact, settings, branches, d, monitor),
        Ended::Undivided(_) => after_sweeps(contact, settings, &d, SWEEPS_OF_SECOND_START, monitor),
        Ended::Lost(_) | Ended::Stopped(_) => {
            let mut first = first.with_effort(Effort::of_systems(systems));
            if let Ended::Stopped(stop) = ended {
                first.ending = Ending::Stopped(stop);
            }
            return first;
        }
    };
    let systems = systems + further.effort.factorisations;
    further.with_effort(Effort::of_systems(systems))
}

/// Solves the problem of some pairs from the displacements `d`, by several starts.
fn on_undecided(
    part: &Contact<'_>,
    settings: &Settings,
    d: &[f64],
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let mut systems = 0;
    let mut candidate = None;
    for sweeps in SWEEPS_ON_UNDECIDED {
        let mut next = after_sweeps(part, settings, d, sweeps, monitor);
        systems += next.effort.factorisations;
        next.effort.factorisations = systems;
        let ended = matches!(next.ending, Ending::Done | Ending::Stopped(_));
        candidate = Some(next);
        if ended {
            break;
        }
    }
    candidate.expect("there is a start")
}

/// Solves from given branches; `d` is returned unchanged if no system could be solved.
pub fn from_branches(
    contact: &Contact<'_>,
    settings: &Settings,
    branches: Vec<Branch>,
    d: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    run(contact, settings, (branches, d), History::first(contact.unknowns()), monitor)
}

/// Solves from the branches on which the displacements `d` are after so many sweeps.
fn after_sweeps(
    contact: &Contact<'_>,
    settings: &Settings,
    d: &[f64],
    sweeps: u32,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let admissible = contact.admissible(d);
    let force = contact.problem().force(&admissible);
    let branches = swept(contact, (&admissible, &force), sweeps, monitor);
    run(contact, settings, (branches, d.to_vec()), History::further(), monitor)
}

/// Goes on from branches by the rules of a start; `d` is returned unchanged if no system could be solved.
fn run(
    contact: &Contact<'_>,
    settings: &Settings,
    (mut branches, d): (Vec<Branch>, Vec<f64>),
    mut history: History,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let problem = contact.problem();
    let constant = problem.load().iter().map(|f| -f).collect();
    let mut system = LinearSystem::new(problem.stiffness(), true, contact.dim(), constant, d);
    let mut best = Best::at(&system, f64::INFINITY);
    let mut rows = Vec::with_capacity(contact.unknowns());
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
        if let Err(ending) = history.advance(contact, &system, &mut branches, monitor) {
            // At a degenerate solution rounding may flip the active set forever.
            let solved = ending == Ending::Cycle && best.eta <= settings.tolerance;
            break if solved { Ending::Done } else { ending };
        }
    };
    let effort = Effort::of_systems(system.factorisations);
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
    /// Whether a pair whose slip would turn back sticks first.
    sticks_first: bool,
    /// Fewest pairs whose branch a system has changed, and which system that was.
    fewest: (usize, usize),
}

impl History {
    /// Of a first start.
    fn first(unknowns: usize) -> Self {
        let (sweeps, later_sweeps) = match unknowns <= FEW_UNKNOWNS {
            true => (FIRST_SWEEPS_OF_FEW, SWEEPS_OF_FEW),
            false => (SWEEPS, SWEEPS),
        };
        let fewest = (usize::MAX, 0);
        History { seen: Vec::new(), sweeps, later_sweeps, sticks_first: false, fewest }
    }

    /// Of a further one.
    fn further() -> Self {
        History { sweeps: 0, later_sweeps: 0, sticks_first: true, ..Self::first(0) }
    }

    /// Goes on to the branches that the solution of the last system selects.
    fn advance(
        &mut self,
        contact: &Contact<'_>,
        system: &LinearSystem<'_>,
        branches: &mut Vec<Branch>,
        monitor: &Monitor<'_>,
    ) -> Result<(), Ending> {
        let mut next = swept(contact, (&system.x, &system.residual), self.sweeps, monitor);
        self.sweeps = self.later_sweeps;
        if self.sticks_first {
            let pairs = contact.pairs().iter().zip(branches.iter());
            for (next, (law, before)) in next.iter_mut().zip(pairs) {
                *next = before.without_reversal(law, *next);
            }
        }
        let changed = branches.iter().zip(&next).filter(|(before, next)| before != next).count();
        let systems = self.seen.len();
        if changed < self.fewest.0 {
            self.fewest = (changed, systems);
        }
        self.seen.push(std::mem::replace(branches, next));
        if self.seen.contains(branches) {
            return Err(Ending::Cycle);
        }
        if self.seen.len() >= MOST_SYSTEMS || systems >= self.fewest.1 + PATIENCE {
            return Err(Ending::Stalled("Newton's method does not converge"));
        }
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
