//! Newton's method on the pieces of the law (Alart and Curnier 1991), in 2D.
//!
//! The law is piecewise linear: the equations of a piece of every pair are solved exactly, and the
//! solution tells the next pieces. When they are the same again it is the solution of the problem,
//! to rounding. Two sweeps between a solution and its pieces carry a zone's edge over many pairs,
//! where Newton's step alone moves it by one: 3 to 11 systems on the bar on the plane up to 513 pairs,
//! 5 to 24 without. Nothing makes the steps descend: they may cycle, which is recognised, when pieces
//! come that were there before.

use std::collections::HashSet;

use super::equations::{Equations, Singular};
use super::pieces::{self, Piece};
use super::solution::{Candidate, Ending};
use crate::certificate;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Systems after which it is given up.
const MOST_SYSTEMS: usize = 60;

/// Sweeps between a solution and its pieces, and after cycles, when they are made four times as many.
const SWEEPS: u32 = 2;
const MOST_SWEEPS: u32 = 32;

/// Steps of iterative refinement at the end, if rounding has left more than was asked.
const REFINEMENTS: usize = 3;

/// Solves from the pieces on which `start` is, or from all pairs in contact and at rest.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let (pieces, d) = match start {
        None => (pieces::stuck(problem), vec![0.0; problem.unknowns()]),
        Some(d) => (pieces::at(problem, d, &problem.force(d)), d.to_vec()),
    };
    from_pieces(problem, settings, pieces, d, monitor)
}

/// Solves from given pieces; `d` is where steps begin, and what is returned if there is none.
pub fn from_pieces(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    mut pieces: Vec<Piece>,
    d: Vec<f64>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let mut equations = Equations::new(problem, true, d);
    let mut best = (f64::INFINITY, equations.d.clone(), 0);
    let mut seen = HashSet::new();
    let mut sweeps = SWEEPS;
    let ending = loop {
        if let Err(reason) = monitor.step() {
            break Ending::Interrupted(reason);
        }
        if let Err(Singular) = equations.solve(&pieces::rows(problem, &pieces)) {
            break Ending::Singular;
        }
        let eta = certificate::eta(problem, &equations.d, &equations.force);
        monitor.measured(eta);
        if eta < best.0 {
            best = (eta, equations.d.clone(), equations.orientation);
        }
        let next = pieces::at(problem, &equations.d, &equations.force);
        if next == pieces {
            refine(&mut equations, problem, &pieces, settings.tolerance);
            best = (0.0, std::mem::take(&mut equations.d), equations.orientation);
            break Ending::Done;
        }
        if seen.len() >= MOST_SYSTEMS {
            break Ending::Stalled("Newton's method does not settle");
        }
        let next = equations.swept_pieces(sweeps);
        seen.insert(std::mem::replace(&mut pieces, next));
        if seen.contains(&pieces) {
            if best.0 <= settings.tolerance {
                // Where pieces meet, rounding may change them for ever at the solution.
                break Ending::Done;
            }
            if sweeps >= MOST_SWEEPS {
                break Ending::Cycle;
            }
            sweeps *= 4;
            seen.clear();
        }
    };
    let (_, d, orientation) = best;
    let factorisations = equations.factorisations;
    Candidate { orientation, factorisations, ..Candidate::ended(d, ending) }
}

/// Brings the solution of the last system to `tolerance` where rounding has not.
pub fn refine(
    equations: &mut Equations<'_>,
    problem: &ContactProblem<'_>,
    pieces: &[Piece],
    tolerance: f64,
) {
    let mut best = f64::INFINITY;
    for _ in 0..=REFINEMENTS {
        equations.refresh();
        let eta = certificate::eta(problem, &equations.d, &equations.force);
        // The second look takes the rounding of what gaps and slips prescribe into account.
        if eta <= tolerance || certificate::certify(problem, &equations.d).holds(tolerance) {
            return;
        }
        if eta >= best {
            // Borders may have lost what a fresh factor has.
            equations.forget();
        }
        best = best.min(eta);
        let before = equations.d.clone();
        if equations.solve(&pieces::rows(problem, pieces)).is_err() {
            equations.d = before;
            return;
        }
    }
}
