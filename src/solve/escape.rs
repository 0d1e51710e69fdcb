//! Sweeps on a body that nothing holds drift along a rigid motion: how they notice.
//!
//! Components that did not move between two looks are held; if `K` is singular on the others, the
//! rigid motions of these follow from the components that depend on others, and the one that agrees
//! with the drift there is free of its elastic part.

use super::factor::Factor;
use crate::certificate::is_escape;
use crate::law;
use crate::problem::{ContactProblem, Friction};

/// Looks at the iterates of sweeps 256, 512, 1024, …
pub struct EscapeWatch {
    sweeps: u64,
    next: u64,
    before: Vec<f64>,
}

impl EscapeWatch {
    /// Watches from the start `d` on.
    pub fn new(d: &[f64]) -> Self {
        EscapeWatch { sweeps: 0, next: 256, before: d.to_vec() }
    }

    /// Counts a sweep; a motion that proves that no equilibrium exists, if one shows.
    pub fn observe(&mut self, problem: &ContactProblem<'_>, d: &[f64]) -> Option<Vec<f64>> {
        self.sweeps += 1;
        if self.sweeps < self.next {
            return None;
        }
        self.next *= 2;
        let drift: Vec<f64> = d.iter().zip(&self.before).map(|(d, before)| d - before).collect();
        self.before.copy_from_slice(d);
        let motion = rigid_part(problem, &drift)?;
        let lifted = lifted(problem, motion.clone());
        [motion, lifted].into_iter().find(|motion| is_escape(problem, motion))
    }
}

fn rigid_part(problem: &ContactProblem<'_>, drift: &[f64]) -> Option<Vec<f64>> {
    let moved = (0..drift.len()).filter(|&i| drift[i] != 0.0).collect();
    let factor = Factor::new(problem, moved)?;
    let mut motion = vec![0.0; drift.len()];
    for i in factor.dependent() {
        motion[i] = drift[i];
    }
    factor.follow(problem, &mut motion);
    Some(motion)
}

/// A slide together with the lift that makes contact forces do no negative work on it.
fn lifted(problem: &ContactProblem<'_>, mut motion: Vec<f64>) -> Vec<f64> {
    if let Friction::Coulomb(mu) = problem.friction() {
        for (pair, mu) in motion.chunks_exact_mut(problem.dim()).zip(mu) {
            pair[0] = pair[0].min(0.0) - mu * law::length(&pair[1..]);
        }
    }
    motion
}
