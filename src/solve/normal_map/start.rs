//! Sweeps before Newton's method: rounds until the pieces of the pairs settle.
//!
//! A hundred sweeps cost about as much as a linear system of a thousand pairs, less on fewer. Sweeps with
//! the over-relaxation factor 1 bring most problems near their states in two rounds. Where a front of slip
//! or contact moves across many pairs, each round leaves the pieces as they are and the residual large;
//! over-relaxed sweeps then move the front some times as fast. They do not converge on all matrices with
//! large coefficients of friction: a round that gains too little is taken back.

use super::equations::Equations;
use crate::law::Vector;
use crate::monitor::Monitor;
use crate::solve::sweeps::Sweeper;

/// Sweeps of a round; rounds.
const SWEEPS: usize = 10;
const LEAST_ROUNDS: usize = 2;
const MOST_ROUNDS: usize = 10;

/// Settled is a round that changes at most this part of the pieces, and leaves at most this residual `eta`.
const CHANGING: f64 = 0.01;
const NEAR: f64 = 0.03;

/// Over-relaxation factor after the first rounds. The last sweep of a round has the factor 1: its residual
/// is that of the point, not that of a step beyond it.
const OVER_RELAXATION: f64 = 1.5;

/// Part of `eta` that an over-relaxed round may leave.
const WORTHWHILE: f64 = 0.7;

/// The coordinates after some sweeps from the displacements `start` (zero if `None`), fewer if the time is up.
pub(super) fn swept(
    whole: &Equations<'_>,
    start: Option<&[f64]>,
    monitor: &Monitor<'_>,
) -> Vec<Vector> {
    let mut d = start.map_or_else(|| vec![0.0; whole.root.len()], <[f64]>::to_vec);
    for (law, normal) in whole.laws.iter().zip(d.iter_mut().step_by(whole.dim)) {
        *normal = law.admissible(*normal);
    }
    let mut force = whole.force(&d);
    let sweeper = Sweeper::new();
    let round = |d: &mut Vec<f64>, force: &mut Vec<f64>, omega: f64| {
        let mut sweep = |omega| {
            if monitor.is_late() {
                return;
            }
            sweeper.sweep_pairs(&whole.laws, whole.matrix, (&mut *d, &mut *force), omega);
        };
        (1..SWEEPS).for_each(|_| sweep(omega));
        sweep(1.0);
        whole.eta(d, force)
    };
    let (mut pieces, mut eta) = (Vec::new(), f64::INFINITY);
    let mut omega = OVER_RELAXATION;
    for number in 1..=MOST_ROUNDS {
        if number <= LEAST_ROUNDS || omega <= 1.0 {
            eta = round(&mut d, &mut force, 1.0);
        } else {
            let before = (d.clone(), force.clone());
            let after = round(&mut d, &mut force, omega);
            if after <= WORTHWHILE * eta {
                eta = after;
            } else {
                (d, force) = before;
                omega = 1.0;
                continue;
            }
        }
        let now = whole.pieces(&whole.coordinates(&d, &force));
        let changed = now.iter().zip(&pieces).filter(|(now, before)| now != before).count();
        let settled = changed as f64 <= CHANGING * now.len() as f64 && eta <= NEAR;
        pieces = now;
        if (settled && number >= LEAST_ROUNDS) || monitor.is_late() {
            break;
        }
    }
    whole.coordinates(&d, &force)
}
