//! The default: choose, check, fall back.
//!
//! | problem | methods, in turn, until one is certified |
//! |---|---|
//! | without friction | block pivoting, Lemke, sweeps |
//! | friction in 2D | Newton, path (from its best iterate), Lemke, sweeps (nested, diagonal) |
//! | friction in 3D | Newton, path (from its last iterate), sweeps (nested, diagonal) |
//!
//! In 2D Newton's method and the path go to the pairs in question first (`undecided`), and then to the whole.
//! The path has the guarantee. In 2D it starts where sweeps end and takes far fewer events than Lemke's
//! method takes pivots on most problems. Lemke's method is asked only where rounding spoils all its starts, or where a body without
//! supports leaves it on a ray that proves nothing: another path may end elsewhere.
//!
//! If the orientation of a solution is −1, there are at least three solutions and this one is
//! unstable: the next method is asked too.

use super::candidate::{Candidate, Effort, Ending, certified};
use super::dispatch::run;
use super::outcome::{Fallback, SecondSolution, Solution, Status, Uniqueness};
use super::uniqueness;
use crate::error::Error;
use crate::law::Contact;
use crate::monitor::{Monitor, Stop};
use crate::settings::{Method, Settings};

/// Sweeps that are tried where exact methods have failed: a thousandth of what they may take when they
/// are chosen is not worth the wait, ten times more never helped on the problems of the tests.
const LATER_SWEEPS: u64 = 5000;

/// Solves by the first method whose result is certified.
pub fn solve(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let plan = plan(contact);
    let mut tried = Tried::default();
    for &method in plan {
        let from = match (&tried.best, method) {
            (Some((_, best)), Method::Path) => Some(best.d.as_slice()),
            _ => start,
        };
        let candidate = attempt(method, contact, settings, from, monitor)?;
        tried.count(&candidate.effort);
        let (why, stopped) = (fallback(&candidate), matches!(candidate.ending, Ending::Stopped(_)));
        let solution = certified(contact, settings, method, &candidate);
        match solution.status {
            Status::Solved if solution.orientation < 0 && tried.unstable.is_none() => {
                tried.unstable = Some(solution);
            }
            Status::Solved | Status::NoEquilibrium => {
                return Ok(tried.ended(contact, solution, monitor));
            }
            _ => tried.keep(contact, method, candidate),
        }
        tried.first.get_or_insert((plan[0], why));
        if stopped || (tried.unstable.is_some() && method == Method::Lemke) {
            break;
        }
    }
    if let Some(solution) = tried.unstable.take() {
        return Ok(tried.ended(contact, solution, monitor));
    }
    let (method, candidate) = tried.best.take().expect("a plan has a method");
    let solution = certified(contact, settings, method, &candidate);
    Ok(tried.ended(contact, solution, monitor))
}

/// Runs a method; sweeps after an exact method only for a while.
fn attempt(
    method: Method,
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    if !matches!(method, Method::SorNested | Method::SorDiagonal) {
        return run(method, contact, settings, start, monitor);
    }
    let (candidate, used_up) =
        monitor.within(LATER_SWEEPS, |monitor| run(method, contact, settings, start, monitor));
    let mut candidate = candidate?;
    if candidate.ending == Ending::Stopped(Stop::IterationLimit) && !used_up {
        candidate.ending = Ending::Stalled("no method converges");
    }
    Ok(candidate)
}

fn plan(contact: &Contact<'_>) -> &'static [Method] {
    if !contact.problem().is_symmetric() {
        return &[Method::Newton, Method::Path];
    }
    match (contact.is_frictionless(), contact.dim(), contact.is_coupled()) {
        (true, _, _) => &[Method::BlockPivoting, Method::Lemke, Method::SorNested],
        (false, 2, false) => &[Method::Newton, Method::Path, Method::Lemke, Method::SorNested],
        (false, 2, true) => {
            &[Method::Newton, Method::Path, Method::Lemke, Method::SorNested, Method::SorDiagonal]
        }
        (false, _, false) => &[Method::Newton, Method::Path, Method::SorNested],
        (false, _, true) => &[Method::Newton, Method::Path, Method::SorNested, Method::SorDiagonal],
    }
}

fn fallback(candidate: &Candidate) -> Fallback {
    match candidate.ending {
        Ending::Cycle => Fallback::Cycle,
        Ending::Singular => Fallback::Singular,
        Ending::Done if candidate.orientation < 0 => Fallback::Unstable,
        _ => Fallback::Inaccurate,
    }
}

/// What earlier methods have left.
#[derive(Default)]
struct Tried {
    first: Option<(Method, Fallback)>,
    /// A solution of orientation −1.
    unstable: Option<Solution>,
    /// Best uncertified candidate and its method, with how the last method ended.
    best: Option<(Method, Candidate)>,
    effort: Effort,
}

impl Tried {
    fn count(&mut self, effort: &Effort) {
        self.effort.factorisations += effort.factorisations;
        self.effort.refactorisations += effort.refactorisations;
    }

    /// Keeps the better displacements, with the ending of the later method.
    fn keep(&mut self, contact: &Contact<'_>, method: Method, candidate: Candidate) {
        let eta = |candidate: &Candidate| candidate.certificate(contact).eta;
        match &mut self.best {
            Some((_, best)) if !(eta(&candidate) < eta(best)) => best.ending = candidate.ending,
            best => *best = Some((method, candidate)),
        }
    }

    fn ended(
        self,
        contact: &Contact<'_>,
        mut solution: Solution,
        monitor: &Monitor<'_>,
    ) -> Solution {
        solution.fallback = self.first;
        solution.factorisations = self.effort.factorisations;
        solution.refactorisations = self.effort.refactorisations;
        if let Some(other) = self.unstable
            && solution.status == Status::Solved
            && uniqueness::are_two(contact, &solution, &other, monitor)
        {
            solution.uniqueness = Uniqueness::Several;
            solution.second = Some(Box::new(SecondSolution {
                d: other.d,
                d_low: other.d_low,
                certificate: other.certificate,
                orientation: other.orientation,
            }));
        }
        solution
    }
}
