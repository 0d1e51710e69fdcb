//! The law of a pair as pieces, on each of which it is a set of linear equations: all that Newton's
//! method and block pivoting know of it.
//!
//! | piece | equations |
//! |---|---|
//! | open | `F_n = 0` |
//! | closed | `d_n = gap` |
//! | at rest | `d_t = slip` |
//! | sliding to the side `s` | `F_t = -s mu p`, `p = -F_n`; with given thresholds `F_t = -s g` |
//!
//! In two dimensions; in others without friction.

use crate::problem::{ContactProblem, FrictionLaw};

/// What a pair does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Piece {
    /// Whether it is in contact.
    pub closed: bool,
    /// What it does tangentially.
    pub motion: Motion,
}

/// What a pair does tangentially.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// It is at rest.
    Rest,
    /// It slides to the side +1 or −1; 0 where no tangential force can act.
    Slide(i8),
}

/// The equation of an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Row {
    /// The unknown has this value.
    Held(f64),
    /// `F_i + coupling F_n + offset = 0`, with the normal component `n` of its pair.
    Free { coupling: f64, offset: f64 },
}

/// An equation of equilibrium without contact force.
const FORCELESS: Row = Row::Free { coupling: 0.0, offset: 0.0 };

/// The pieces on which the natural map is at the displacements `d` with the force `K d - f`.
pub fn at(problem: &ContactProblem<'_>, d: &[f64], force: &[f64]) -> Vec<Piece> {
    let dim = problem.dim();
    let piece = |pair: usize| {
        let n = dim * pair;
        let pressure = problem.diagonal(n) * (d[n] - problem.gap(pair)) - force[n];
        let closed = pressure > 0.0;
        let threshold = problem.threshold(pair, pressure.max(0.0));
        if dim != 2 || threshold == 0.0 {
            return Piece { closed, motion: Motion::Slide(0) };
        }
        let t = n + 1;
        let trial = problem.diagonal(t) * (d[t] - problem.reference_slip(pair, 0)) - force[t];
        let motion = if trial > threshold {
            Motion::Slide(1)
        } else if trial < -threshold {
            Motion::Slide(-1)
        } else {
            Motion::Rest
        };
        Piece { closed, motion }
    };
    (0..problem.pairs()).map(piece).collect()
}

/// All pairs in contact and at rest, as far as they have an obstacle and friction.
pub fn stuck(problem: &ContactProblem<'_>) -> Vec<Piece> {
    let piece = |pair| {
        let closed = problem.gap(pair) < f64::INFINITY;
        let rests =
            problem.dim() == 2 && problem.threshold(pair, f64::from(u8::from(closed))) > 0.0;
        Piece { closed, motion: if rests { Motion::Rest } else { Motion::Slide(0) } }
    };
    (0..problem.pairs()).map(piece).collect()
}

/// The equations of all unknowns.
pub fn rows(problem: &ContactProblem<'_>, pieces: &[Piece]) -> Vec<Row> {
    let mut rows = Vec::with_capacity(problem.unknowns());
    for (pair, piece) in pieces.iter().enumerate() {
        rows.push(if piece.closed { Row::Held(problem.gap(pair)) } else { FORCELESS });
        for component in 0..problem.dim() - 1 {
            rows.push(match (piece.motion, problem.law()) {
                (Motion::Rest, _) => Row::Held(problem.reference_slip(pair, component)),
                (Motion::Slide(0), _) | (_, FrictionLaw::Frictionless) => FORCELESS,
                (Motion::Slide(side), FrictionLaw::Coulomb(mu)) => {
                    Row::Free { coupling: -f64::from(side) * mu[pair], offset: 0.0 }
                }
                (Motion::Slide(side), FrictionLaw::Tresca(g)) => {
                    Row::Free { coupling: 0.0, offset: f64::from(side) * g[pair] }
                }
            });
        }
    }
    rows
}
