//! The default: choose, check, fall back.
//!
//! | problem | methods, in turn, until one is certified |
//! |---|---|
//! | without friction | block pivoting, Lemke, sweeps |
//! | friction in 2D | Newton, Lemke, sweeps (nested, diagonal) |
//! | friction in 3D | sweeps (nested, diagonal) |
//!
//! A solution of orientation −1 is one of at least three, and not the one that a structure takes: the
//! next method is asked too.

use super::solution::{
    Candidate, Ending, Fallback, SecondSolution, Solution, Status, Uniqueness, certified,
};
use super::uniqueness;
use crate::certificate;
use crate::error::Error;
use crate::monitor::{Monitor, Stop};
use crate::problem::{ContactProblem, FrictionLaw};
use crate::settings::{Method, Settings};

/// Sweeps that are tried where exact methods have failed.
const LATER_SWEEPS: u64 = 5000;

/// Solves by the first method whose result is certified.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let plan = plan(problem);
    let mut tried = Tried::default();
    for &method in plan {
        let candidate = attempt(method, problem, settings, start, monitor)?;
        tried.factorisations += candidate.factorisations;
        tried.refactorisations += candidate.refactorisations;
        let why = fallback(&candidate);
        let interrupted = matches!(candidate.ending, Ending::Interrupted(_));
        let solution = certified(problem, settings, method, candidate.clone());
        match solution.status {
            Status::Solved if solution.orientation < 0 && tried.unstable.is_none() => {
                tried.unstable = Some(solution);
            }
            Status::Solved | Status::NoEquilibrium => return Ok(tried.ended(problem, solution)),
            _ => tried.keep(problem, method, candidate),
        }
        tried.first.get_or_insert((plan[0], why));
        if interrupted || (tried.unstable.is_some() && method == Method::Lemke) {
            break;
        }
    }
    if let Some(solution) = tried.unstable.take() {
        return Ok(tried.ended(problem, solution));
    }
    let (_, method, candidate) = tried.best.take().expect("a plan has a method");
    let solution = certified(problem, settings, method, candidate);
    Ok(tried.ended(problem, solution))
}

/// Runs a method; sweeps after an exact method only for a while.
fn attempt(
    method: Method,
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let sweeps = matches!(method, Method::SorNested | Method::SorDiagonal);
    if !sweeps || plan(problem)[0] == method {
        return super::run(method, problem, settings, start, monitor);
    }
    let all = monitor.allow(LATER_SWEEPS);
    let candidate = super::run(method, problem, settings, start, monitor);
    monitor.restore(all);
    let mut candidate = candidate?;
    let limit = Ending::Interrupted(Stop::IterationLimit);
    if candidate.ending == limit && monitor.iterations() < all {
        candidate.ending = Ending::Stalled("no method settles");
    }
    Ok(candidate)
}

fn plan(problem: &ContactProblem<'_>) -> &'static [Method] {
    match problem.law() {
        FrictionLaw::Frictionless => &[Method::BlockPivoting, Method::Lemke, Method::SorNested],
        friction if friction.is_zero() => {
            &[Method::BlockPivoting, Method::Lemke, Method::SorNested]
        }
        FrictionLaw::Tresca(_) if problem.dim() == 2 => {
            &[Method::Newton, Method::Lemke, Method::SorNested]
        }
        FrictionLaw::Coulomb(_) if problem.dim() == 2 => {
            &[Method::Newton, Method::Lemke, Method::SorNested, Method::SorDiagonal]
        }
        FrictionLaw::Tresca(_) => &[Method::SorNested],
        FrictionLaw::Coulomb(_) => &[Method::SorNested, Method::SorDiagonal],
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
    /// What is best among those that are none, with its `eta`, and the last ending.
    best: Option<(f64, Method, Candidate)>,
    factorisations: u64,
    refactorisations: u64,
}

impl Tried {
    /// Keeps the better displacements, with the ending of the later method.
    fn keep(&mut self, problem: &ContactProblem<'_>, method: Method, candidate: Candidate) {
        let eta = certificate::certify(problem, &candidate.d).eta;
        match &mut self.best {
            Some((least, _, best)) if !(eta < *least) => best.ending = candidate.ending,
            best => *best = Some((eta, method, candidate)),
        }
    }

    fn ended(self, problem: &ContactProblem<'_>, mut solution: Solution) -> Solution {
        solution.fallback = self.first;
        solution.factorisations = self.factorisations;
        solution.refactorisations = self.refactorisations;
        if let Some(other) = self.unstable
            && solution.status == Status::Solved
            && uniqueness::are_different(problem, &solution.d, &other.d)
        {
            solution.uniqueness = Uniqueness::Several;
            solution.second = Some(Box::new(SecondSolution {
                d: other.d,
                certificate: other.certificate,
                orientation: other.orientation,
            }));
        }
        solution
    }
}
