//! When two solutions count as different.
//!
//! Whatever the tolerance, two answers are two solutions only if they are further apart than both are from the
//! solutions next to them. So both are refined to the last digits, and Newton's next step tells how far each still
//! is from its solution; where a system is singular nothing is said.

use crate::law::Contact;
use crate::linalg::vector::{largest_of, norm_inf};
use crate::solve::newton::{FullyRefined, ROUNDING_OF_ETA};

/// Relative margin by which a statement must be true to count as proved: the rounding of systems with condition
/// numbers up to 1e9 or 1e10, the largest that are certified, stays below it.
pub const MARGIN: f64 = 1e-6;

/// How many times further apart than their errors two solutions are: the step is an estimate to first order.
const PARTED: f64 = 1e3;

/// True if two refined answers are next to two solutions. Their `eta` is at its rounding then: displacements are two
/// doubles each, and forces are rounded once. An answer on pieces whose solution is not on them keeps a residual, which
/// may be as small as the force of the softest spring: 7e-13 of the loads was seen, 1.5e-16 at solutions. One at which
/// pieces meet up to rounding, as where a pair grazes its obstacle, may be next to a solution or to none.
pub fn are_parted(contact: &Contact<'_>, one: &FullyRefined, two: &FullyRefined) -> bool {
    let is_solution = |answer: &FullyRefined| {
        let certificate = answer.candidate.certificate(contact);
        certificate.eta <= ROUNDING_OF_ETA
            && certificate.holds(MARGIN)
            && is_strict(contact, answer.candidate.d())
    };
    if !is_solution(one) || !is_solution(two) {
        return false;
    }
    let (first, second) = (one.candidate.d(), two.candidate.d());
    let root = contact.problem().unit_roots();
    let apart: Vec<f64> = first.iter().zip(second).map(|(one, two)| one - two).collect();
    let error = scaled(&root, &one.error) + scaled(&root, &two.error);
    are_different(contact, first, second) && scaled(&root, &apart) > PARTED * error
}

/// True if a refined answer is so near to its solution that this has what the answer has by [`MARGIN`].
pub fn is_sharp(contact: &Contact<'_>, answer: &FullyRefined) -> bool {
    let root = contact.problem().unit_roots();
    PARTED * scaled(&root, &answer.error) <= MARGIN * size(contact, answer.candidate.d())
}

fn scaled(root: &[f64], d: &[f64]) -> f64 {
    largest_of(d.iter().zip(root).map(|(d, root)| d * root))
}

/// The size of displacements, at least those that the loads can induce, so that two solutions of rounding's
/// size compare equal.
fn size(contact: &Contact<'_>, d: &[f64]) -> f64 {
    let root = contact.problem().unit_roots();
    let loads = largest_of(contact.load_with_tension().iter().zip(&root).map(|(f, root)| f / root));
    loads.max(scaled(&root, d))
}

/// True if two displacements, solutions to rounding, are different ones: by more than rounding, and in the
/// plane by their pieces. In space a piece has the direction of its slip, which rounding changes.
pub fn are_different(contact: &Contact<'_>, one: &[f64], two: &[f64]) -> bool {
    let problem = contact.problem();
    let root = problem.unit_roots();
    let size = size(contact, one).max(size(contact, two));
    let difference: Vec<f64> = one.iter().zip(two).map(|(one, two)| one - two).collect();
    let pieces = |d: &[f64]| contact.pieces(d, &problem.force(d));
    scaled(&root, &difference) > MARGIN * size && (contact.dim() > 2 || pieces(one) != pieces(two))
}

/// True if no pair is where pieces meet: forces and displacements are clear of all bounds.
pub fn is_strict(contact: &Contact<'_>, d: &[f64]) -> bool {
    let force = contact.problem().force(d);
    let unit = norm_inf(&force).max(norm_inf(contact.load_with_tension()));
    contact
        .each(d, &force)
        .all(|(law, d, force)| law.distance_to_kink(&law.trial(d, force)) > MARGIN * unit)
}
