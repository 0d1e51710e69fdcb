//! A solution that moves no further than it must.
//!
//! A body on few points may turn off one of them without any force: each lift is a solution, and rounding of a
//! load decides how far a method goes. A host's residual then loses the digits that the displacements
//! have more than the loads ask for. So where displacements are that large, the rigid motion is taken away
//! that moves no pair with a force.

use std::cell::OnceCell;

use super::motions::RigidMotions;
use crate::law::{Contact, State, touching};
use crate::linalg::tolerances::{CONDENSATION, HELD, NEGLIGIBLE};
use crate::linalg::vector::{dot, largest_of, norm_inf};
use crate::monitor::Watch;
use crate::problem::FreeBlock;
use crate::solve::result::{Call, Candidate};

/// Displacements are large if rounding them costs this part of the forces: below, a host's residual keeps ten
/// digits.
const LARGE: f64 = 1e-10 / f64::EPSILON;

/// Takes such a motion from a candidate, if there is time to find it, and if it is a solution then. What moves with it is
/// brought into equilibrium again, without the rounding of the way back.
pub fn leave_idle_motion(call: &Call<'_>, candidate: &mut Candidate) {
    let (contact, problem) = (call.contact, call.contact.problem());
    if !is_far(contact, candidate.d(), candidate.force(), |i| problem.unit(i)) {
        return;
    }
    let others = without_force(contact, candidate.force());
    let block = FreeBlock::of_problem(problem, others, &mut call.monitor.asking());
    let Some(block) = block else { return };
    let motion = RigidMotions::of_block(problem, &block).part(candidate.d());
    let part = contact.admissible_part(candidate.d(), &motion);
    let parts = candidate.d().iter().zip(&motion);
    let mut d: Vec<f64> = parts.map(|(d, motion)| d - part * motion).collect();
    block.equilibrate(problem.load(), &mut d);
    let force = problem.force(&d);
    let moved = candidate.clone().moved_to(d, Vec::new(), force);
    if moved.certificate(contact).holds(call.settings.tolerance) {
        *candidate = moved;
    }
}

/// The components of the pairs on which no force acts. The block of these resists a rigid motion of theirs alone no more
/// than `K` does, as `r . K r = 0` means `K r = 0`.
fn without_force(contact: &Contact<'_>, force: &[f64]) -> Vec<usize> {
    let dim = contact.dim();
    let forces = norm_inf(contact.load_with_tension()).max(norm_inf(force));
    let parts = force.chunks_exact(dim).enumerate();
    let free = parts.filter(|(_, force)| norm_inf(force) <= NEGLIGIBLE * forces);
    free.flat_map(|(pair, _)| dim * pair..dim * (pair + 1)).collect()
}

/// True if displacements, of components with these units, are large beside what loads, forces and obstacles ask for.
fn is_far(contact: &Contact<'_>, d: &[f64], force: &[f64], unit: impl Fn(usize) -> f64) -> bool {
    let forces = norm_inf(contact.load_with_tension()).max(norm_inf(force));
    // No unit exceeds the largest diagonal entry: nearly all displacements are told by it.
    if norm_inf(d) * contact.problem().relation().largest <= LARGE * forces {
        return false;
    }
    let pairs = contact.each(d, force).enumerate();
    let prescribed =
        pairs.map(|(pair, (law, d, _))| unit(contact.dim() * pair) * law.prescribed(d[0]));
    let largest = largest_of(d.iter().enumerate().map(|(i, d)| d * unit(i)));
    largest.is_finite() && largest > LARGE * forces.max(largest_of(prescribed))
}

/// True if displacements are that large, and `K` resists them with no more energy than the rounding of a host's
/// condensation leaves: another rounding would hold the bodies elsewhere, or not at all. Energies below [`HELD`] times that
/// rounding cannot be told from it.
///
/// The units are those beside which a condensation has rounded: a diagonal entry that is rounding itself would be its own
/// measure.
pub fn is_held_by_rounding(contact: &Contact<'_>, d: &[f64], force: &[f64]) -> bool {
    let problem = contact.problem();
    let units = OnceCell::new();
    let units = || units.get_or_init(|| problem.units_of_condensation());
    if !is_far(contact, d, force, |i| units()[i]) {
        return false;
    }
    let of_units: f64 = d.iter().zip(units()).map(|(d, unit)| unit * d * d).sum();
    dot(d, &problem.internal_force(d)) <= HELD * CONDENSATION * of_units
}

/// True if a frictionless solution may move by some motion without internal force: one that does not move the
/// pairs that touch along their normals, pressed or not. No, if there is no time for the question.
///
/// Such a motion is one that the block of all other components does not resist, which is smaller than `K`, and which what
/// is held makes regular where nothing moves freely. The block is not factorised if it is a part of one that is known to be
/// `definite` beyond doubt, and each component has its own diagonal entry as its unit: no pivot of a part is smaller than
/// that of the whole.
pub fn moves_freely(
    contact: &Contact<'_>,
    (d, states): (&[f64], &[State]),
    definite: &[bool],
    monitor: &dyn Watch,
) -> bool {
    let problem = contact.problem();
    let mut is_held = vec![false; contact.unknowns()];
    touching(contact, d, states).for_each(|pair| is_held[contact.dim() * pair] = true);
    let others: Vec<usize> = (0..is_held.len()).filter(|&i| !is_held[i]).collect();
    let is_definite = |&i: &usize| {
        definite.get(i) == Some(&true) && problem.unit(i) == problem.stiffness().at(i, i)
    };
    if others.iter().all(is_definite) {
        return false;
    }
    let block = FreeBlock::of_problem(problem, others, &mut monitor.asking());
    block.is_some_and(|block| block.dependent().next().is_some())
}
