//! Solvers: each a plain function of a call that returns a candidate; a call is a problem, settings, a start and a monitor.
//! The certificate alone decides in `result` which candidate is a solution.
//!
//! ```text
//! result ← pieces ← part ← rigid ← sweeps ← newton ← path ← proximal ← lcp ← uniqueness ← plan ← operator ← units ← mod
//! ```
//!
//! Each imports from those to its left only. One algorithm is one folder; others may use the names that its
//! `mod.rs` passes on.

mod lcp;
mod newton;
mod operator;
mod part;
mod path;
mod pieces;
mod plan;
mod proximal;
mod result;
mod rigid;
mod sweeps;
mod uniqueness;
mod units;

use crate::error::{Argument, Error, Limit};
use crate::law::Contact;
use crate::monitor::{Monitor, Watch};
use crate::problem::{
    ContactProblem, DependentRows, FlexibilityForm, FlexibilityProblem, Relation, Units,
    check_count, check_finite, in_units,
};
use crate::settings::{Search, Settings};

pub use lcp::{LcpSolution, solve_lcp};
pub(crate) use operator::{
    Case as MatrixFreeCase, CasePast, certify as certify_matrix_free, memory_of_case,
    solve as solve_matrix_free,
};
pub(crate) use plan::memory_of_ties;
use proximal::Means;
pub(crate) use proximal::largest_island;
pub(crate) use result::{CAUSES, NO_EQUILIBRIUM, check_limit, memory_of_flexibility};
use result::{Call, Solve};
pub use result::{
    Errors, Escape, Existence, Fallback, Remarks, SecondSolution, Solution, Status, Uniqueness,
    memory, memory_flexibility,
};
use rigid::Balance;
use units::to_host;

/// Solves a contact problem whose rows depend on each other, as [`solve()`] does another one. Contact forces
/// are not unique then, nor is any solution called the only one.
///
/// # Errors
/// As [`solve()`]; a search for other solutions.
pub(crate) fn solve_dependent(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &dyn Watch,
) -> Result<Solution, Error> {
    refuse_search(settings, "pairs that depend on each other do")?;
    let means = Means { settings, solve: plan::solve, monitor };
    let bytes = || memory(problem.unknowns()) + copies_of(problem);
    check(settings, bytes, ("d", problem, start))?;
    let solution = in_units(problem, |units, problem| {
        let start = start.and_then(|start| units.length.all(start));
        let solution = proximal::solve_dependent(problem, means, start.as_deref())?;
        Ok(to_host(solution, units, settings, problem))
    });
    let solution = solution.unwrap_or_else(|| proximal::solve_dependent(problem, means, start))?;
    Ok(finished(solution, means, problem))
}

/// Refuses a search for other solutions where there is no stiffness.
fn refuse_search(settings: &Settings, those: &str) -> Result<(), Error> {
    if settings.search == Search::Off {
        return Ok(());
    }
    let message = format!(
        "settings: the search for other solutions needs a stiffness, which {those} not have"
    );
    Err(Error::invalid(Argument::Settings, message))
}

/// Solves a contact problem in flexibility form from the contact forces `start` (zero if `None`).
///
/// Where `W` is singular, contact forces need not be unique: from the start zero they are the smallest, where
/// the states of pairs do not change on the way. No solution is called the only one. With
/// [`Status::NoEquilibrium`] [`Solution::recession`] holds pressing normal forces, and forces of ties, which move
/// nothing and prove that the gaps contradict each other.
///
/// Pairs that no entry of a sparse `W` ties to each other are islands, each solved by itself to the tolerance: time and
/// memory are those of dense problems of their sizes, the memory that of the largest. What was found is certified as a
/// whole. The status is that of the worst island: a proof that one has no equilibrium is one for the whole. They are
/// solved from the smallest to the largest, and those behind one at which a limit ended the call are left as they
/// were at the start. [`Solution::method`] is that of the largest island with that status, and so are
/// [`Solution::omega`] and [`Solution::damping`].
///
/// # Errors
/// As [`solve()`]; a search for other solutions; a `W` with negative eigenvalues. Where the largest island would need more memory than the settings
/// allow it is named.
pub fn solve_flexibility(
    problem: &FlexibilityProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    refuse_search(settings, "the flexibility form does")?;
    let means = Means { settings, solve: plan::solve, monitor };
    let form = &problem.relation().form;
    let copy = || match form {
        FlexibilityForm::Dense(_) => copies_of(problem),
        FlexibilityForm::Sparse(w) => memory_of_ties(problem.law(), w.largest_part()),
    };
    let bytes = || memory_of_flexibility(form) + copy();
    check(settings, bytes, ("F", problem, start)).map_err(|error| {
        match (&error, largest_island(form)) {
            (Error::Stopped { limit: Limit::Memory, .. }, Some(island)) => {
                Error::stopped(Limit::Memory, format!("{}: {island}", error.message().marked()))
            }
            _ => error,
        }
    })?;
    let solution = in_units(problem, |units, problem| {
        let start = start.and_then(|start| units.force.all(start));
        let solution = proximal::solve_flexibility(problem, means, start.as_deref())?;
        Ok(to_host(solution, units, settings, problem))
    });
    let solution =
        solution.unwrap_or_else(|| proximal::solve_flexibility(problem, means, start))?;
    Ok(finished(solution, means, problem))
}

/// Solves a contact problem from the displacements `start` (zero if `None`).
///
/// # Errors
/// Settings out of range, a method that does not fit the problem, a start of the wrong length or
/// with entries that are not finite; memory that cannot be had.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let bytes = || memory(problem.unknowns()) + copies_of(problem);
    check(settings, bytes, ("d", problem, start))?;
    let found = in_units(problem, |units, problem| {
        let start = start.and_then(|start| units.length.all(start));
        let solution = solve_as_it_stands(problem, settings, start.as_deref(), monitor)?;
        Ok(to_host(solution, units, settings, problem))
    });
    let mut found = found.unwrap_or_else(|| solve_as_it_stands(problem, settings, start, monitor));
    if let Ok(solution) = &mut found {
        plan::say_remarks(problem, solution);
        solution.iterations = monitor.iterations();
    }
    found
}

fn solve_as_it_stands(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &dyn Watch,
) -> Result<Solution, Error> {
    // Further questions take the memory that would be kept.
    let more = settings.search == Search::Others || settings.proof;
    let problem = &problem.remembering(problem.remembered().filter(|_| !more));
    let contact = Contact::new(problem);
    // Where d = 0 is the solution, other starts only approach it.
    let start = start.filter(|_| !contact.is_at_rest());
    let call = Call { contact: &contact, settings, start, monitor };
    let Some(mut found) = plan::without_ties(&call, solve_with_questions) else {
        return solve_with_questions(&call);
    };
    if settings.proof
        && let Ok(solution) = &mut found
    {
        uniqueness::prove(&call, solution);
    }
    found
}

/// Solves a problem without ties, and answers what the settings ask of its solution.
fn solve_with_questions(call: &Call<'_>) -> Result<Solution, Error> {
    let (contact, settings) = (call.contact, call.settings);
    // A result is large: it stays where it is.
    let mut found = plan::solve(call);
    let Ok(solution) = &mut found else { return found };
    if solution.status == Status::NoEquilibrium {
        let (balance, solve) = (Balance::new(contact, call.monitor), Some(plan::solve as Solve));
        rigid::describe(contact, solution, balance, solve, call.monitor)?;
    }
    uniqueness::by_orientation(call, solution);
    if settings.proof {
        uniqueness::prove(call, solution);
    }
    if settings.search == Search::Others && !call.monitor.is_late() {
        uniqueness::examine(call, solution)?;
    }
    plan::add_remarks(call, solution);
    found
}

/// A result with the remarks on its data and the count of its iterations.
fn finished<R: Relation>(
    mut solution: Solution,
    Means { settings, monitor, .. }: Means<'_>,
    problem: &ContactProblem<'_, R>,
) -> Solution {
    if settings.proof {
        solution.existence = Existence::NotProved;
    }
    plan::remark_on_data(problem, settings, &mut solution);
    solution.iterations = monitor.iterations();
    solution
}

/// Bytes of copies of the matrix of a problem: one in other units, and one of the pairs that are not tied.
fn copies_of<R: Relation>(problem: &ContactProblem<'_, R>) -> u64 {
    let size = problem.unknowns();
    let in_units = if Units::of(problem).is_some() { size * size * size_of::<f64>() } else { 0 };
    in_units as u64 + memory_of_ties(problem.law(), size)
}

/// Refuses settings out of range, a call that needs more bytes than they allow, and a start of a wrong length
/// or with entries that are not finite.
fn check<R: Relation>(
    settings: &Settings,
    bytes: impl FnOnce() -> u64,
    (name, problem, start): (&str, &ContactProblem<'_, R>, Option<&[f64]>),
) -> Result<(), Error> {
    settings.validate()?;
    if settings.memory_limit > 0 {
        check_limit(bytes(), settings)?;
    }
    check_start(name, problem.unknowns(), start)
}

pub(crate) fn check_start(name: &str, n: usize, start: Option<&[f64]>) -> Result<(), Error> {
    let Some(start) = start else { return Ok(()) };
    check_count(("the start", Argument::Start), start.len(), n)?;
    check_finite((&format!("the start {name}"), Argument::Start), start)
}
