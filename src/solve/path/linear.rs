//! The linear path in the plane.

use super::linear_start::{Random, Starts};
use super::linear_walk::{End, Ground, Rules, Walk};
use crate::law::{Contact, Planar};
use crate::monitor::Monitor;
use crate::settings::Settings;
use crate::solve::active_set;
use crate::solve::candidate::{Candidate, Effort, Ending};
use crate::solve::rigid_balance;

/// Events of a walk from the swept start, for each pair: the most that arrived took fewer.
const SHORT: usize = 1;

/// Events of a walk from a sure start, for each pair, and of any on few pairs.
const LONG: usize = 10;
const LEAST: usize = 200;

/// Changes after which a system is factorised again: a factorisation then costs about as much as the
/// changes.
const AGE: usize = 60;

/// The same where rounding has spoilt a walk.
const CAREFUL_AGE: usize = 4;

/// Where a walk starts.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    /// At the coordinates after the sweeps.
    Swept,
    /// At those that have no other coordinates beside them.
    Sure,
    /// With all pairs pressed on their obstacles.
    Pressed,
}

const ATTEMPTS: [(Start, usize, usize); 4] = [
    (Start::Swept, SHORT, AGE),
    (Start::Sure, LONG, AGE),
    (Start::Sure, LONG, CAREFUL_AGE),
    (Start::Pressed, LONG, CAREFUL_AGE),
];

/// Solves a problem in 2D, from the displacements `start` (zero if `None`).
pub fn linear(
    contact: &Contact<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let root = contact.problem().stiffness().diagonal_roots();
    let starts = Starts::new(contact, &root, start);
    let ground = Ground { contact, root: &root, load: &starts.load, size: starts.size };
    let mut best = Candidate::without_displacements(contact, Ending::Stalled(LOST));
    let mut effort = Effort::default();
    let mut random = Random::new(0);
    for (kind, events, age) in ATTEMPTS {
        if kind == Start::Swept && !contact.is_coupled() {
            // Every start is sure.
            continue;
        }
        let y: Vec<Planar> = match kind {
            Start::Swept => starts.swept(&mut random),
            Start::Sure => starts.sure(contact, &mut random),
            Start::Pressed => starts.pressed(contact, &root, &mut random),
        };
        let Some(mut walk) = Walk::new(&ground, &y) else { continue };
        if kind == Start::Swept && !walk.begins_upwards() {
            continue;
        }
        let most = (events * y.len()).max(LEAST);
        let end = walk.follow(Rules { most, age }, monitor);
        effort.factorisations += walk.factorisations;
        let mut candidate = ended(contact, settings, &walk, end, monitor);
        effort.factorisations += candidate.effort.factorisations;
        candidate.effort = effort;
        if candidate.is_settled(contact, settings.tolerance) {
            return candidate;
        }
        let eta = |candidate: &Candidate| candidate.certificate(contact).eta;
        if eta(&candidate) < eta(&best) {
            best = candidate;
        }
        best.effort = effort;
    }
    best
}

/// Why there is no solution.
const LOST: &str = "the path does not arrive";

/// The candidate of a walk that has ended.
fn ended(
    contact: &Contact<'_>,
    settings: &Settings,
    walk: &Walk<'_>,
    end: End,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let d = walk.displacements();
    let ending = match end {
        End::Arrived => {
            let branches = walk.branches();
            let mut polished = active_set::from_branches(contact, settings, branches, d, monitor);
            if polished.ending == Ending::Cycle {
                polished.ending = Ending::Stalled(LOST);
            }
            return polished;
        }
        End::Back | End::Lost => Ending::Stalled(LOST),
        End::Escape(motion) => Ending::Recession(rigid_balance::escape(contact).unwrap_or(motion)),
        End::Stopped(stop) => Ending::Stopped(stop),
    };
    Candidate::of_displacements(contact, d, ending)
}
