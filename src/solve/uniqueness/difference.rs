//! When two solutions count as different.

use crate::law::Contact;
use crate::linalg::vector::largest_of;

/// What is proved must be true by more than this, relatively: the rounding of systems with condition
/// numbers up to 1e9 or 1e10, the largest that are certified, stays below it.
pub const MARGIN: f64 = 1e-6;

/// Whether two displacements, solutions to rounding, are different ones: by their branches, and by
/// more than rounding.
pub fn are_different(contact: &Contact<'_>, one: &[f64], two: &[f64]) -> bool {
    let problem = contact.problem();
    let root = problem.unit_roots();
    let scaled = |d: &[f64]| largest_of(d.iter().zip(&root).map(|(d, root)| d * root));
    // Scale also by the displacement that the loads can induce, so that two solutions of rounding's
    // size compare equal.
    let loads = largest_of(contact.shifted_load().iter().zip(&root).map(|(f, root)| f / root));
    let size = loads.max(scaled(one)).max(scaled(two));
    let difference: Vec<f64> = one.iter().zip(two).map(|(one, two)| one - two).collect();
    let branches = |d: &[f64]| contact.branches(d, &problem.force(d));
    scaled(&difference) > MARGIN * size && branches(one) != branches(two)
}
