//! Friction in the plane on the pairs whose state is in question.
//!
//! Where Newton's method does not converge, most pairs have found their state all the same: iterates differ in a
//! quarter of the pairs, or less. A pair that is decided is held: an open one without a force, a stuck one at its
//! reference. What is left is a contact problem of its own (`part::ReducedProblem`). It is definite if `K` is, so that
//! what is proved of a path holds for it. On a quarter of the pairs a sweep, or an event of a path, costs a sixteenth, a system a sixty-fourth. Its solution
//! is one of the whole problem unless a pair that is held closes, slips or opens. Then that pair and its neighbours
//! are in question too, and the problem is solved again from there: this ends, as pairs only join.

use super::question::InQuestion;
use crate::law::Contact;
use crate::law::Piece;
use crate::monitor::{Monitor, Stop};
use crate::solve::part::{PairData, ReducedProblem};
use crate::solve::pieces::Equations;
use crate::solve::result::{Call, Candidate, Ending};

/// Largest part of the pairs that may be in question: beyond it the whole problem costs no more.
const MOST: f64 = 0.6;

/// Iterations, for each pair, after which the pairs in question are given up: more of them do not end sooner than the
/// whole problem. Of 240 hard problems with 1025 pairs all but three took fewer than 2.5.
const PATIENCE: f64 = 5.0;

/// Only the states of the pairs are taken from a solution of the pairs in question; the last system of the whole
/// problem finds the digits.
const ENOUGH: f64 = 1e-6;

/// A solver of the pairs in question.
pub type Core<'c> = dyn FnMut(&Call<'_>, &mut Monitor<'_>) -> Candidate + 'c;

/// How the pairs in question ended.
pub enum PartOutcome {
    /// The pieces of a solution of the whole problem, and its displacements to some digits.
    Settled(Vec<Piece>, Vec<f64>),
    /// Too many pairs are in question, too few are decided, or the core has found no solution; how far the
    /// displacements have come.
    Lost(Vec<f64>),
    /// A budget is used up, or the callback cancelled.
    Stopped(Stop),
}

/// Solves a problem by `core` on the pairs in question. Returns the linear systems of `core` too.
pub fn solve_part(
    call: &Call<'_>,
    monitor: &mut Monitor<'_>,
    core: &mut Core<'_>,
) -> (PartOutcome, u64) {
    let (contact, settings) = (call.contact, call.settings);
    let (mut d, mut question) = InQuestion::after_sweeps(contact, &call.start_or_zero(), monitor);
    let (whole, mut systems) = (Equations::of(contact), 0);
    let last = monitor.iterations() + (PATIENCE * contact.pairs().len() as f64) as u64;
    while question.is_fewer_than(MOST) && monitor.iterations() <= last {
        let reduced = match ReducedProblem::new(&whole, &question.held(contact), monitor) {
            Ok(Some(reduced)) => reduced,
            Ok(None) => break,
            Err(stop) => return (PartOutcome::Stopped(stop), systems),
        };
        let own = PairData::of(contact.problem(), &reduced.kept().collect::<Vec<usize>>());
        let Some(problem) = reduced.problem(contact.problem(), &own) else { break };
        let part = Contact::new(&problem);
        let candidate = core(&Call::new(&part, settings).from(&reduced.restrict(&d)), monitor);
        systems += candidate.effort.factorisations;
        match candidate.ending {
            Ending::Stopped(stop) => return (PartOutcome::Stopped(stop), systems),
            Ending::Recession(_) => break,
            _ if !candidate.is_settled(&part, settings.tolerance.max(ENOUGH)) => break,
            _ => d = reduced.expand(candidate.d()),
        }
        if !question.join_contradicted(contact, &d) {
            return (PartOutcome::Settled(question.pieces, d), systems);
        }
    }
    (PartOutcome::Lost(d), systems)
}
