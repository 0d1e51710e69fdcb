//! A solution that moves no further than it must.
//!
//! A body on few points may turn off one of them without any force: each lift is a solution, and rounding of a
//! load decides how far a method goes. A host's residual then loses the digits that the displacements
//! have more than the loads ask for. So where displacements are that large, the rigid motion is taken away
//! that moves no pair with a force, and that the loads do not drive.

use super::motions::RigidMotions;
use crate::law::{Contact, State, touching};
use crate::linalg::tolerances::{CONDENSATION, HELD, NEGLIGIBLE, ROUNDING_OF_SUM};
use crate::linalg::vector::{combination, dot, largest_of, norm, norm_inf};
use crate::monitor::Monitor;
use crate::problem::FreeBlock;
use crate::solve::result::Candidate;

/// Displacements are large if rounding them costs this part of the forces: below, a host's residual keeps ten
/// digits.
const LARGE: f64 = 1e-10 / f64::EPSILON;

/// The candidate without such a motion, if there is time to find it.
pub fn without_idle_motion(
    contact: &Contact<'_>,
    candidate: Candidate,
    monitor: &mut Monitor<'_>,
) -> Candidate {
    let unit = |i: usize| contact.problem().unit(i);
    if !is_far(contact, candidate.d(), candidate.force(), unit) {
        return candidate;
    }
    let Some(rigid) = RigidMotions::of(contact.problem(), monitor) else { return candidate };
    let motion = idle(contact, &candidate, rigid).part(candidate.d());
    let driven = dot(contact.load_with_tension(), &motion).abs();
    let could = norm_inf(contact.load_with_tension()) * norm_inf(&motion);
    if norm(&motion) == 0.0 || driven > ROUNDING_OF_SUM * could {
        return candidate;
    }
    let part = contact.admissible_part(candidate.d(), &motion);
    let parts = candidate.d().iter().zip(&motion);
    let d: Vec<f64> = parts.map(|(d, motion)| d - part * motion).collect();
    let force = contact.problem().force(&d);
    candidate.moved_to(d, Vec::new(), force)
}

/// True if displacements, of components with these units, are large beside what loads, forces and obstacles ask for.
fn is_far(contact: &Contact<'_>, d: &[f64], force: &[f64], unit: impl Fn(usize) -> f64) -> bool {
    let forces = norm_inf(contact.load_with_tension()).max(norm_inf(force));
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
    let units = problem.units_of_condensation();
    if !is_far(contact, d, force, |i| units[i]) {
        return false;
    }
    let largest = norm_inf(d);
    let motion: Vec<f64> = d.iter().map(|d| d / largest).collect();
    let of_units: f64 = motion.iter().zip(&units).map(|(d, unit)| unit * d * d).sum();
    dot(&motion, &problem.internal_force(&motion)) <= HELD * CONDENSATION * of_units
}

/// True if a frictionless solution may move by some motion without internal force: one that does not move the
/// pairs that touch along their normals, pressed or not. No, if there is no time for the question.
///
/// Such a motion is one that the block of all other components does not resist, as `r . K r = 0` means `K r = 0`. That
/// block is smaller than `K`, and what is held makes it regular where nothing moves freely.
pub fn moves_freely(
    contact: &Contact<'_>,
    d: &[f64],
    states: &[State],
    monitor: &mut Monitor<'_>,
) -> bool {
    let mut is_held = vec![false; contact.unknowns()];
    touching(contact, d, states).for_each(|pair| is_held[contact.dim() * pair] = true);
    let others: Vec<usize> = (0..is_held.len()).filter(|&i| !is_held[i]).collect();
    let block = FreeBlock::of_problem(contact.problem(), others, &mut monitor.asking());
    block.is_some_and(|block| block.dependent().next().is_some())
}

/// The rigid motions that move no pair on which a force acts.
fn idle(contact: &Contact<'_>, candidate: &Candidate, rigid: RigidMotions) -> RigidMotions {
    let forces = norm_inf(contact.load_with_tension()).max(norm_inf(candidate.force()));
    let dim = contact.dim();
    let parts = candidate.force().chunks_exact(dim).enumerate();
    let held = parts.filter(|(_, force)| norm_inf(force) > NEGLIGIBLE * forces);
    let held = held.flat_map(|(pair, _)| dim * pair..dim * (pair + 1)).collect();
    RigidMotions { basis: not_moving(held, rigid.basis), ..rigid }
}

/// An orthonormal basis of those motions of a `basis` that do not move the `held` components.
fn not_moving(mut held: Vec<usize>, mut basis: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    // Each component that is held takes one motion away: the others are combined with it so that they do
    // not move it.
    while let Some((place, most)) = held
        .iter()
        .map(|&i| norm(&basis.iter().map(|v| v[i]).collect::<Vec<f64>>()))
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(&b.1))
        && most > HELD_STILL
    {
        let component = held.swap_remove(place);
        let shares: Vec<f64> = basis.iter().map(|v| v[component] / most).collect();
        basis = complement(&basis, &shares);
    }
    basis
}

/// Components below this part of a motion of length 1 are rounding.
const HELD_STILL: f64 = 1e-8;

/// The combinations of orthonormal vectors that are orthogonal to the one with the `shares`, of length 1 (a
/// Householder reflection that turns it into the first).
fn complement(basis: &[Vec<f64>], shares: &[f64]) -> Vec<Vec<f64>> {
    let mut w = shares.to_vec();
    w[0] += w[0].signum();
    let along = combination(basis[0].len(), w.iter().copied().zip(basis));
    let factor = 2.0 / dot(&w, &w);
    let reflected = basis
        .iter()
        .zip(&w)
        .skip(1)
        .map(|(v, w)| v.iter().zip(&along).map(|(v, along)| v - factor * w * along).collect());
    reflected.collect()
}
