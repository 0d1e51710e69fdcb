//! Sweeps before Newton's method: rounds until the pieces of the pairs settle.
//!
//! A hundred sweeps cost about as much as a linear system of a thousand pairs, less on fewer. Sweeps with
//! the over-relaxation factor 1 bring most problems near their states in two rounds. Where a front of slip
//! or contact moves across many pairs, each round leaves the pieces as they are and the residual large;
//! over-relaxed sweeps then move the front some times as fast. They do not converge on all matrices with
//! large coefficients of friction: a round that gains too little is taken back.

use std::ops::RangeInclusive;

use crate::law::{Vector, references};
use crate::monitor::Watch;
use crate::solve::pieces::Equations;
use crate::solve::sweeps::sweep_pairs;

/// How many rounds are made, and of how many sweeps: in the range, one for so many unknowns.
struct Rounds {
    sweeps: RangeInclusive<usize>,
    unknowns_per_sweep: usize,
    least: usize,
    most: usize,
}

/// A system of `n` unknowns costs as much as `n / 3` sweeps, so that a round costs about a hundredth of it.
const IN_SPACE: Rounds = Rounds { sweeps: 5..=10, unknowns_per_sweep: 300, least: 2, most: 20 };

/// In the plane a system costs as much as a few sweeps, as one factor serves many, and most fronts move by two sweeps
/// between systems.
const IN_PLANE: Rounds = Rounds { sweeps: 5..=5, unknowns_per_sweep: 1, least: 1, most: 2 };

/// Settled is a round that changes at most this part of the pieces, and leaves at most this residual `eta`.
const CHANGING: f64 = 0.01;
const NEAR: f64 = 0.03;

/// Over-relaxation factor after the first rounds. The last sweep of a round has the factor 1: its residual
/// is that of the point, not that of a step beyond it.
const OVER_RELAXATION: f64 = 1.5;

/// Part of `eta` that an over-relaxed round may leave.
const WORTHWHILE: f64 = 0.7;

/// The coordinates after some sweeps from the displacements `start`, fewer if the time is up. If that is `None`, all pairs
/// are closed without slip in the plane, and all displacements zero in space. `None`: they lead beyond the largest number.
pub(super) fn swept(
    whole: &Equations<'_>,
    start: Option<&[f64]>,
    monitor: &dyn Watch,
) -> Option<Vec<Vector>> {
    let mut d = match start {
        Some(start) => start.to_vec(),
        None if whole.dim == 2 => references(&whole.laws, 2).collect(),
        None => vec![0.0; whole.root.len()],
    };
    for (law, normal) in whole.laws.iter().zip(d.iter_mut().step_by(whole.dim)) {
        *normal = law.admissible(*normal);
    }
    let mut force = whole.force(&d);
    let rounds = if whole.dim == 2 { IN_PLANE } else { IN_SPACE };
    let (fewest, most) = rounds.sweeps.into_inner();
    let sweeps = (whole.root.len() / rounds.unknowns_per_sweep).clamp(fewest, most);
    let round = |d: &mut Vec<f64>, force: &mut Vec<f64>, omega| {
        for sweeps in [(sweeps - 1, omega), (1, 1.0)] {
            sweep_pairs(&whole.laws, whole.matrix, (&mut d[..], &mut force[..]), sweeps, monitor);
        }
        whole.eta(d, force)
    };
    let (mut y, mut pieces, mut eta) = (Vec::new(), Vec::new(), f64::INFINITY);
    let mut omega = OVER_RELAXATION;
    for number in 1..=rounds.most {
        if number <= IN_SPACE.least || omega <= 1.0 {
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
        y = whole.coordinates(&d, &force);
        let now = whole.pieces(&y);
        let changed = now.iter().zip(&pieces).filter(|(now, before)| now != before).count();
        let settled = changed as f64 <= CHANGING * now.len() as f64 && eta <= NEAR;
        pieces = now;
        if (settled && number >= rounds.least) || monitor.is_late() {
            break;
        }
    }
    let is_finite = y.iter().flatten().all(|y| y.is_finite());
    is_finite.then_some(y)
}
