//! Friction in the plane on the pairs whose state is in question.
//!
//! Where Newton's method does not converge, most pairs have found their state all the same: iterates differ in a
//! quarter of the pairs, or less. A pair that is decided is held: an open one without a force, a stuck one at its
//! reference. What is left is a contact problem of its own (`part::ReducedProblem`). It is definite if `K` is, so that
//! what is proved of a path holds for it. On a quarter of the pairs a sweep, or an event of a path, costs a sixteenth, a system a sixty-fourth. Its solution
//! is one of the whole problem unless a pair that is held closes, slips or opens. Then that pair and its neighbours
//! are in question too, and the problem is solved again from there: this ends, as pairs only join.

use super::iteration::from_pieces;
use crate::law::{Contact, PairLaw, Piece};
use crate::solve::part::{PairData, ReducedProblem};
use crate::solve::pieces::Equations;
use crate::solve::result::{Call, Candidate, Ending};
use crate::solve::sweeps::sweep_pairs;

/// Sweeps before pairs are watched, and as many in which they are: a pair whose piece changes in these is in question.
const SWEEPS: usize = 10;

/// Pairs that a pair takes along to either side when it joins. What joins one by one takes many rounds.
const BESIDE: usize = 4;

/// Largest part of the pairs that may be in question: beyond it the whole problem costs no more.
const MOST: f64 = 0.6;

/// Iterations, for each pair, after which the pairs in question are given up: more of them do not end sooner than the
/// whole problem. Of 240 hard problems with 1025 pairs all but three took fewer than 2.5.
const PATIENCE: f64 = 5.0;

/// Only the states of the pairs are taken from a solution of the pairs in question; the last system of the whole
/// problem finds the digits.
const ENOUGH: f64 = 1e-6;

/// A solver of the pairs in question.
pub type Core<'c> = dyn FnMut(&Call<'_>) -> Candidate + 'c;

/// Solves a problem by `core` on the pairs in question. `Err`: too many pairs are in question, too few are decided, or the
/// core has found no solution; how far the displacements have come.
pub fn solve_part(call: &Call<'_>, core: &mut Core<'_>) -> Result<Candidate, Vec<f64>> {
    let (contact, settings) = (call.contact, call.settings);
    let (mut d, mut question) = InQuestion::after_sweeps(call);
    let (whole, mut systems) = (Equations::of(contact), 0);
    let last = call.monitor.iterations() + (PATIENCE * contact.pairs().len() as f64) as u64;
    let stopped = loop {
        if !question.is_fewer_than(MOST) || call.monitor.iterations() > last {
            return Err(d);
        }
        let reduced = match ReducedProblem::new(&whole, &question.held(contact), call.monitor) {
            Ok(Some(reduced)) => reduced,
            Ok(None) => return Err(d),
            Err(stop) => break Some(stop),
        };
        let own = PairData::of(contact.problem(), &reduced.kept().collect::<Vec<usize>>());
        let Some(problem) = reduced.problem(contact.problem(), &own) else { return Err(d) };
        let part = Contact::new(&problem);
        let candidate = core(&Call::new(&part, settings, call.monitor).from(&reduced.restrict(&d)));
        systems += candidate.effort.factorisations;
        match candidate.ending {
            Ending::Stopped(stop) => break Some(stop),
            Ending::Recession(_) => return Err(d),
            _ if !candidate.is_settled(&part, settings.tolerance.max(ENOUGH)) => return Err(d),
            _ => d = reduced.expand(candidate.d()),
        }
        if !question.join_contradicted(contact, &d) {
            break None;
        }
    };
    let mut found = match stopped {
        Some(stop) => {
            Candidate::of_displacements(contact, call.start_or_zero(), Ending::Stopped(stop))
        }
        None => from_pieces(&call.from(&d), &question.pieces),
    };
    found.effort.factorisations += systems;
    Ok(found)
}

/// Which pairs are in question, and the pieces of all.
struct InQuestion {
    pairs: Vec<bool>,
    pieces: Vec<Piece>,
}

impl InQuestion {
    /// The pairs whose piece changes in sweeps from the start, or that are not held on it; and the displacements after
    /// the sweeps.
    fn after_sweeps(call: &Call<'_>) -> (Vec<f64>, Self) {
        let contact = call.contact;
        let mut d = contact.admissible(&call.start_or_zero());
        let mut force = contact.problem().force(&d);
        let (laws, matrix) = (contact.pairs(), contact.problem().stiffness());
        let mut swept = |d: &mut Vec<f64>| {
            sweep_pairs(laws, matrix, (&mut d[..], &mut force), (1, 1.0), call.monitor);
            contact.pieces(d, &force)
        };
        let mut pieces = Vec::new();
        for _ in 0..SWEEPS {
            pieces = swept(&mut d);
        }
        let mut pairs = vec![false; pieces.len()];
        for _ in 0..SWEEPS {
            let next = swept(&mut d);
            for (is_in, (before, after)) in pairs.iter_mut().zip(pieces.iter().zip(&next)) {
                *is_in |= before != after;
            }
            pieces = next;
        }
        for (is_in, (law, piece)) in pairs.iter_mut().zip(contact.pairs().iter().zip(&pieces)) {
            *is_in |= law.decided(*piece).is_none();
        }
        (d, InQuestion { pairs, pieces })
    }

    /// True if at most `part` of the pairs is in question, and not none.
    fn is_fewer_than(&self, part: f64) -> bool {
        let (count, all) = (self.pairs.iter().filter(|is_in| **is_in).count(), self.pairs.len());
        count > 0 && count as f64 <= part * all as f64
    }

    /// The piece on which each pair is held; `None` of those in question.
    fn held(&self, contact: &Contact<'_>) -> Vec<Option<Piece>> {
        let pairs = contact.pairs().iter().zip(self.pairs.iter().zip(&self.pieces));
        pairs.map(|(law, (is_in, piece))| if *is_in { None } else { law.decided(*piece) }).collect()
    }

    /// Puts the pairs whose state the displacements `d` contradict, and those before and after them, in question;
    /// whether there are any. The pieces become those at `d`.
    fn join_contradicted(&mut self, contact: &Contact<'_>, d: &[f64]) -> bool {
        let next = contact.pieces(d, &contact.problem().force(d));
        let laws = contact.pairs().iter().zip(self.pieces.iter().zip(&next));
        let is_other = |(law, (before, after)): (&PairLaw, (&Piece, &Piece))| {
            law.decided(*before) != law.decided(*after)
        };
        let others: Vec<bool> = laws.map(is_other).collect();
        let joining: Vec<usize> =
            (0..others.len()).filter(|&pair| others[pair] && !self.pairs[pair]).collect();
        for &pair in &joining {
            let end = (pair + BESIDE + 1).min(self.pairs.len());
            self.pairs[pair.saturating_sub(BESIDE)..end].fill(true);
        }
        self.pieces = next;
        !joining.is_empty()
    }
}
