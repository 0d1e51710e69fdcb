//! The proof that no equilibrium exists: a rigid motion on which the loads do more work than contact
//! can take (a recession direction of the energy). What a pair must satisfy stands in
//! `law::recession`.

use super::condensation::is_free;
use crate::law::{Contact, Recession};
use crate::linalg::tolerances::{FREE, LEAST_WORK, NEGLIGIBLE};
use crate::linalg::vector::{dot, largest_of, norm, norm_inf};
use crate::problem::{ContactProblem, Relation};

/// True if the rigid motion `r` proves that no equilibrium exists.
///
/// `K r = 0` up to rounding, with no more energy than rounding of the entries of `K` explains, or what `K` shows to be
/// the rounding of a condensation, and for every
/// pair that has an obstacle `-r_n >= mu |r_t|`: then the contact forces can only do non-negative work
/// `F . r >= sum |F_n| (|r_n| - mu |r_t|)`, while equilibrium asks for `F . r = -f . r`. So `f . r > 0`
/// excludes it. With given thresholds the condition is `r_n <= 0` and `f . r > sum g |r_t|`. The tension of
/// pairs counts as a load; for all laws see `law::recession`.
pub fn is_escape(problem: &ContactProblem<'_>, r: &[f64]) -> bool {
    is_escape_of(&Contact::new(problem), r)
}

/// [`is_escape`], on a problem whose laws are worked out.
pub(crate) fn is_escape_of(contact: &Contact<'_>, r: &[f64]) -> bool {
    let problem = contact.problem();
    let r = of_size_one(r);
    // On a motion that only Kᵀ resists internal forces do work.
    let rounding = problem.relation().rounding_of_load * norm(&r);
    problem.is_symmetric() && outworks_contact(contact, &r, rounding) && is_free(problem, &r)
}

/// A motion with the largest component 1: its length says nothing, and products of it might overflow, or vanish and with
/// them its energy. Components of one that has no length, or none that is finite, are no numbers.
pub(super) fn of_size_one(r: &[f64]) -> Vec<f64> {
    let largest = norm_inf(r);
    r.iter().map(|r| r / largest).collect()
}

/// True if contact stops a motion `r` of the pairs nowhere, and takes less work than the loads do, whose own work is known up to some
/// `rounding`. The work of a motion that is no number is none, and more than nothing is asked for.
pub(super) fn outworks_contact<R: Relation>(
    contact: &Contact<'_, R>,
    r: &[f64],
    rounding: f64,
) -> bool {
    let root = contact.problem().unit_roots();
    let size = largest_of(r.iter().zip(&root).map(|(r, root)| r * root));
    let negligible = NEGLIGIBLE * size;
    let motions = recessions(contact, r);
    let normals = root.iter().step_by(contact.dim());
    if motions.iter().zip(normals).any(|(motion, root)| motion.approach * root > negligible) {
        return false;
    }
    let resisted: f64 = motions.iter().map(|motion| motion.resisted).sum();
    let load = contact.load_with_tension();
    let scale: f64 = load.iter().zip(&root).map(|(f, root)| size * (f / root).abs()).sum();
    dot(load, r) - resisted > (LEAST_WORK * scale).max(FREE * rounding)
}

/// By how much each pair must be lifted in the motion `r` so that contact forces do no negative work.
pub(crate) fn lifts(contact: &Contact<'_>, r: &[f64]) -> Vec<f64> {
    recessions(contact, r).iter().map(|motion| motion.lift).collect()
}

fn recessions<R: Relation>(contact: &Contact<'_, R>, r: &[f64]) -> Vec<Recession> {
    let parts = r.chunks_exact(contact.dim());
    contact.pairs().iter().zip(parts).map(|(law, r)| law.recession(r)).collect()
}
