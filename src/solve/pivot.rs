//! Block principal pivoting without friction (Júdice and Pires 1994): exchange all pairs that
//! violate their condition at once; when their number has not fallen for as many systems as there are
//! pairs, exchange the last of them only (Murty 1974) until it does. Finite for positive definite `K`.
//!
//! All pairs closed is a cheap start: the first system has the components without a contact law
//! alone, and a few sweeps from its solution tell nearly all pairs that open; sweeps follow each later
//! solution too, as in Newton's method, as long as they help.

use super::equations::{Equations, Singular};
use super::newton::refine;
use super::pieces;
use super::solution::{Candidate, Ending};
use crate::certificate;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Least number of systems without progress before single exchanges. Júdice and Pires recommend 10; on
/// the worst problems of single exchanges, which take `2^n`, whole blocks need `n`.
const PATIENCE: usize = 10;

/// Sweeps between a solution and its pieces.
const SWEEPS: u32 = 2;

/// Systems after which a problem of `n` pairs is left to another method: single exchanges may take
/// `2^n`, whole blocks take a few, or at most about `n` on the worst problems known.
pub fn enough(n: usize) -> u64 {
    50 + 2 * n as u64
}

/// Solves from the pieces on which `start` is, or from all pairs closed. `symmetric` tells
/// whether `K` is, as far as rounding goes; after `most` systems it gives up.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    symmetric: bool,
    start: Option<&[f64]>,
    most: u64,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let (mut pieces, d) = match start {
        Some(d) => (pieces::at(problem, d, &problem.force(d)), d.to_vec()),
        None => (pieces::stuck(problem), vec![0.0; problem.unknowns()]),
    };
    let mut equations = Equations::new(problem, symmetric, d);
    let mut best = (f64::INFINITY, equations.d.clone());
    let most_patience = PATIENCE.max(problem.pairs());
    let (mut fewest, mut patience) = (usize::MAX, most_patience);
    let last = monitor.iterations().saturating_add(most);
    let ending = loop {
        if monitor.iterations() >= last {
            break Ending::Stalled("block pivoting does not settle");
        }
        if let Err(reason) = monitor.step() {
            break Ending::Interrupted(reason);
        }
        if let Err(Singular) = equations.solve(&pieces::rows(problem, &pieces)) {
            break Ending::Singular;
        }
        let eta = certificate::eta(problem, &equations.d, &equations.force);
        monitor.measured(eta);
        if eta < best.0 {
            best = (eta, equations.d.clone());
        }
        let next = pieces::at(problem, &equations.d, &equations.force);
        let violated: Vec<usize> = (0..pieces.len()).filter(|&i| next[i] != pieces[i]).collect();
        let progress = violated.len() < fewest;
        if violated.is_empty() {
            refine(&mut equations, problem, &pieces, settings.tolerance);
            best.1 = std::mem::take(&mut equations.d);
            break Ending::Done;
        }
        if !progress && best.0 <= settings.tolerance {
            // Where pieces meet, rounding may exchange them for ever at the solution.
            break Ending::Done;
        }
        if progress {
            (fewest, patience) = (violated.len(), most_patience);
        }
        if patience > 0 {
            patience -= usize::from(!progress);
            pieces = if symmetric && progress { equations.swept_pieces(SWEEPS) } else { next };
        } else {
            let single = violated[violated.len() - 1];
            pieces[single] = next[single];
        }
    };
    let factorisations = equations.factorisations;
    Candidate { orientation: 1, factorisations, ..Candidate::ended(best.1, ending) }
}
