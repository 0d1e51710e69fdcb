//! The rounding of a host's condensation, where a stiffness shows it.
//!
//! A stiffness has no energy below zero. So a motion whose energy is further below zero than rounding of the entries
//! explains proves that the entries are wrong by more than their last digits: by Weyl's theorem the error is, in its norm,
//! no smaller than that energy. Entries are so where a host has summed many terms to each, and what such a host's
//! condensation leaves is known ([`CONDENSATION`]). A soft spring adds energy to every motion and shows nothing of the
//! kind: a matrix that is semi-definite as it stands is taken at its word, however soft.
//!
//! The motion is looked for where rounding shows: among those that `K` does not resist. The products of rounding with
//! `k` of them form a matrix whose signs are those of chance, so that all its eigenvalues are positive with a
//! probability of 1/2, .15, .03 and less for `k = 1, 2, 3, ...`: then nothing is shown.

use super::measure::energy;
use crate::linalg::eigen::eigenvectors;
use crate::linalg::tolerances::{CONDENSATION, FREE};
use crate::linalg::vector::dot;
use crate::problem::{ContactProblem, FreeBlock};

/// The energy that counts as rounding, relative as that of [`energy`], of a motion that has the energy `own`.
pub fn rounding_of_energy(problem: &ContactProblem<'_>, own: f64) -> f64 {
    let (stated, condensed) = (problem.rounding_of_energy(), FREE * CONDENSATION);
    let matters = own > stated && own <= condensed;
    if matters && shows_condensation(problem) { condensed } else { stated }
}

/// True if some motion has an energy further below zero than rounding of the entries of `K` explains.
fn shows_condensation(problem: &ContactProblem<'_>) -> bool {
    let all = (0..problem.unknowns()).collect();
    let Some(block) = FreeBlock::of_problem(problem, all) else { return false };
    let motions: Vec<Vec<f64>> = block.null_vectors().collect();
    let forces: Vec<Vec<f64>> = motions.iter().map(|r| problem.internal_force(r)).collect();
    let product = |i: usize, j: usize| dot(&motions[i], &forces[j]) + dot(&motions[j], &forces[i]);
    let Some(directions) = eigenvectors(motions.len(), product) else { return false };
    directions.first().is_some_and(|shares| {
        let mut least = vec![0.0; problem.unknowns()];
        for (share, motion) in shares.iter().zip(&motions) {
            least.iter_mut().zip(motion).for_each(|(least, r)| *least += share * r);
        }
        let internal = problem.internal_force(&least);
        energy(problem.relation(), &least, &internal) < -problem.rounding_of_energy()
    })
}
