//! Sweeps on a body that nothing holds drift along a rigid motion: how they notice.
//!
//! Components that did not move between two looks are held; if `K` is singular on the others, the
//! rigid motions of these follow from the components that depend on others, and the one that agrees
//! with the drift there is free of its elastic part.

use super::factor::Factor;
use crate::certificate::is_escape;
use crate::law;
use crate::linalg::small::largest;
use crate::problem::{ContactProblem, FrictionLaw};

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
        let FrictionLaw::Coulomb(mu) = problem.law() else {
            return is_escape(problem, &motion).then_some(motion);
        };
        let slides = motion.chunks_exact(problem.dim()).map(|pair| law::length(&pair[1..]));
        let lifts: Vec<f64> = slides.zip(mu).map(|(slide, mu)| mu * slide).collect();
        let uniform = vec![largest(&lifts); lifts.len()];
        [vec![0.0; lifts.len()], lifts, uniform]
            .into_iter()
            .map(|lifts| lifted(problem, &motion, &lifts))
            .find(|motion| is_escape(problem, motion))
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

/// A slide together with a lift of each pair, which makes contact forces do no negative work on it.
/// Off a plane it is rigid if all are lifted by the same.
fn lifted(problem: &ContactProblem<'_>, motion: &[f64], lifts: &[f64]) -> Vec<f64> {
    let mut motion = motion.to_vec();
    for (pair, lift) in motion.chunks_exact_mut(problem.dim()).zip(lifts) {
        pair[0] -= lift;
    }
    motion
}
