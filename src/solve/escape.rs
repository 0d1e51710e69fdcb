//! Sweeps on a body that nothing holds drift along a rigid motion: how they notice.

use crate::certificate;
use crate::law;
use crate::problem::{ContactProblem, Friction};

/// Compares iterates at sweeps 64, 128, 256, …: once the elastic part has died out, what is left
/// between two of them is the motion of escape.
pub struct EscapeWatch {
    sweeps: u64,
    next: u64,
    before: Vec<f64>,
}

impl EscapeWatch {
    /// Watches from the start `d` on.
    pub fn new(d: &[f64]) -> Self {
        EscapeWatch { sweeps: 0, next: 64, before: d.to_vec() }
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
        let lifted = lifted(problem, drift.clone());
        [drift, lifted].into_iter().find(|motion| certificate::is_escape(problem, motion))
    }
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
