//! The default: choose, check, fall back.
//!
//! The methods of the plan ([`super::table`]) run in turn until the certificate says that one has found a solution, or
//! until a motion proves that there is none. How a method ended decides nothing. A start that another method has left
//! is followed by the start of the call, so that the default solves what any method solves.
//!
//! If the orientation of a solution is −1, there are at least three solutions and this one is
//! unstable: the next method is asked too.

use super::table::{MethodRow, Start, plan};
use crate::counters::count;
use crate::error::Error;
use crate::law::Contact;
use crate::settings::Method;
use crate::solve::result::{
    Call, Candidate, Effort, Ending, Fallback, SecondSolution, Solution, Status, Uniqueness,
    certified,
};
use crate::solve::{rigid, uniqueness};

/// Solves by the first method whose result is certified.
pub fn solve(call: &Call<'_>) -> Result<Solution, Error> {
    let contact = call.contact;
    let mut tried = Tried::default();
    for (place, row) in plan(contact).enumerate() {
        let from = match (row.start, &tried.best) {
            (Start::Best | Start::Nearest, Some((_, best))) => call.from(best.d()),
            (Start::Best, None) => continue,
            (Start::Own | Start::Nearest, _) => *call,
        };
        let Some(candidate) = row.candidate(&from)? else { continue };
        tried.count(&candidate.effort);
        if let Ending::RunsAway(motion) = &candidate.ending {
            tried.away = Some(motion.clone());
        }
        let why = candidate.ending.fallback(candidate.orientation);
        let stopped = matches!(candidate.ending, Ending::Stopped(_));
        let is_solved = candidate.certificate(contact).holds(call.settings.tolerance);
        let unsolved = (!is_solved).then(|| candidate.clone());
        let mut solution = certified(call, row.method, candidate);
        let decided = matches!(solution.status, Status::Solved | Status::NoEquilibrium);
        count(row.name, place, decided);
        match solution.status {
            Status::Solved if solution.orientation < 0 && tried.unstable.is_none() => {
                tried.unstable = Some(solution);
            }
            _ if decided => {
                tried.end(call, &mut solution);
                return Ok(solution);
            }
            _ => tried.keep(contact, row, unsolved.expect("a candidate that is no solution")),
        }
        tried.first.get_or_insert((row.method, why));
        if stopped || (tried.unstable.is_some() && row.method == Method::Lemke) {
            break;
        }
    }
    let mut solution = tried.unstable.take().unwrap_or_else(|| {
        let (method, candidate) = tried.best.take().expect("a plan has a method");
        certified(call, method, candidate)
    });
    tried.end(call, &mut solution);
    Ok(solution)
}

/// The results of earlier methods.
#[derive(Default)]
struct Tried {
    first: Option<(Method, Fallback)>,
    /// A solution of orientation −1.
    unstable: Option<Solution>,
    /// Best uncertified candidate and its method, with how the last method ended.
    best: Option<(Method, Candidate)>,
    effort: Effort,
    /// The motion along which bodies move away as springs are let go.
    away: Option<Vec<f64>>,
}

impl Tried {
    fn count(&mut self, effort: &Effort) {
        self.effort.factorisations += effort.factorisations;
        self.effort.refactorisations += effort.refactorisations;
    }

    /// Keeps the better displacements, with the ending of the later method.
    fn keep(&mut self, contact: &Contact<'_>, row: &MethodRow, candidate: Candidate) {
        let eta = |candidate: &Candidate| candidate.certificate(contact).eta;
        match &mut self.best {
            Some((_, best)) if !(eta(&candidate) < eta(best)) => best.ending = candidate.ending,
            best => *best = Some((row.method, candidate)),
        }
    }

    /// Tells in the last solution what came before it.
    fn end(&mut self, call: &Call<'_>, solution: &mut Solution) {
        solution.fallback = self.first;
        if let Some(motion) = self.away.take()
            && solution.status == Status::Stalled
        {
            rigid::describe_run_away(call.contact, solution, motion);
        }
        solution.factorisations = self.effort.factorisations;
        solution.refactorisations = self.effort.refactorisations;
        if let Some(other) = self.unstable.take()
            && solution.status == Status::Solved
            && uniqueness::are_two(call, solution, &other)
        {
            solution.uniqueness = Uniqueness::Several;
            solution.second = Some(Box::new(SecondSolution {
                d: other.d,
                d_low: other.d_low,
                certificate: other.certificate,
                orientation: other.orientation,
            }));
        }
    }
}
