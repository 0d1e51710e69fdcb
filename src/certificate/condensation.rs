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

use super::measure::{energy, terms};
use crate::linalg::eigen::eigenvectors;
use crate::linalg::tolerances::{CONDENSATION, FREE, NEGLIGIBLE};
use crate::linalg::vector::{combination, dot, largest_of};
use crate::problem::{ContactProblem, FreeBlock};

/// True if `K r = 0` up to rounding, in the energy and in each force: rounding of the entries of `K`, each beside its own
/// size, or what `K` shows to be the rounding of a condensation.
///
/// A condensation rounds in the norm. So a diagonal entry that is rounding itself is no measure, and the largest of each
/// pair stands for its components.
pub fn is_free(problem: &ContactProblem<'_>, r: &[f64]) -> bool {
    let internal = problem.internal_force(r);
    let (stated, condensed) = (problem.relation().rounding, FREE * CONDENSATION);
    let own = energy(problem.relation(), r, &internal);
    if own <= stated && has_no_forces(r, &internal, stated, &problem.unit_roots()) {
        return true;
    }
    let units = problem.units_of_condensation();
    let root: Vec<f64> = units.iter().map(|unit| unit.sqrt()).collect();
    let of_units: f64 = r.iter().zip(&units).map(|(r, unit)| unit * r * r).sum();
    (own <= condensed || dot(r, &internal) <= condensed * of_units)
        && has_no_forces(r, &internal, condensed, &root)
        && (stated >= condensed || shows_condensation(problem))
}

/// True if internal forces are no more than rounding of the entries of `K`, each in the roots of two units, or than what
/// is negligible beside the motion.
pub fn has_no_forces(r: &[f64], internal: &[f64], rounding: f64, root: &[f64]) -> bool {
    let scaled = || r.iter().zip(root).map(|(r, root)| (r * root).abs());
    let strained = (NEGLIGIBLE * largest_of(scaled())).max(rounding * scaled().sum::<f64>());
    internal.iter().zip(root).all(|(k, root)| k.abs() <= strained * root)
}

/// True if some motion has an energy further below zero than rounding of the entries of `K` explains.
///
/// It is looked for with each motion in the unit in which its terms `|r| . |K| |r|` are 1: their rounding is that of its
/// energy.
fn shows_condensation(problem: &ContactProblem<'_>) -> bool {
    let all = (0..problem.unknowns()).collect();
    let Some(block) = FreeBlock::of_problem(problem, all, &mut || true) else { return false };
    let mut motions: Vec<Vec<f64>> = block.null_vectors().collect();
    for motion in &mut motions {
        let unit = terms(problem.relation(), motion).sqrt();
        motion.iter_mut().for_each(|r| *r /= unit);
    }
    let forces: Vec<Vec<f64>> = motions.iter().map(|r| problem.internal_force(r)).collect();
    let product = |i: usize, j: usize| dot(&motions[i], &forces[j]) + dot(&motions[j], &forces[i]);
    let Some(directions) = eigenvectors(motions.len(), product) else { return false };
    directions.first().is_some_and(|shares| {
        let parts = shares.iter().copied().zip(&motions);
        let least = combination(problem.unknowns(), parts);
        let internal = problem.internal_force(&least);
        energy(problem.relation(), &least, &internal) < -problem.relation().rounding
    })
}
