//! Gaps that no displacements meet: a proof by forces alone.
//!
//! Where forces `p` balance each other in all that the rows allow, `sum p d` is the same `sum p o` for all displacements,
//! `o` those of fixed values. Every `d_n <= gap` would make the part of a pressing normal force at most `p gap`, and a tie
//! makes that of any force `p` times what it prescribes. If the sum of these is less than `sum p o`, the gaps contradict each
//! other, whatever the friction.

use crate::problem::{ContactProblem, FrictionLaw, Law, Relation};

/// Part of the largest force that a force must have to count, and of the sum's terms by which it must be negative: rounding of
/// the forces is far below.
pub const COUNTS: f64 = 1e-6;

/// The forces of a pattern whose work the law bounds: pressing normal forces, and all forces of ties. Other components are zero.
pub fn bounded<R: Relation>(problem: &ContactProblem<'_, R>, pattern: &[f64]) -> Vec<f64> {
    let dim = problem.dim();
    let part = |(i, &force): (usize, &f64)| match i % dim {
        _ if problem.is_tied(i / dim) => force,
        0 => force.min(0.0),
        _ => 0.0,
    };
    pattern.iter().enumerate().map(part).collect()
}

/// Returns `true` if bounded forces that balance each other prove that the gaps contradict each other; `offset` is `o`.
pub fn exceed_gaps<R: Relation>(
    problem: &ContactProblem<'_, R>,
    bounded: &[f64],
    offset: &[f64],
) -> bool {
    let dim = problem.dim();
    let prescribed = |i: usize| match i % dim {
        0 => problem.gap(i / dim),
        component => problem.reference_slip(i / dim, component - 1),
    };
    let works = bounded.iter().zip(offset).enumerate().filter(|(_, (force, _))| **force != 0.0);
    let (sum, size) = works
        .map(|(i, (force, offset))| -force * (prescribed(i) - offset))
        .fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
    sum < -COUNTS * size
}

/// Copies the problem without its friction.
pub fn without_friction<'a, R: Clone + Relation>(
    problem: &ContactProblem<'a, R>,
) -> ContactProblem<'a, R> {
    problem.with_law(FrictionLaw::Frictionless)
}

/// The first of some pairs that is tied with a gap that is not 0, with its gap; none where numbers of pairs are missing.
pub fn first_open_tie(
    (gaps, law): (&[f64], FrictionLaw<'_>),
    mut pairs: impl Iterator<Item = usize>,
) -> Option<(usize, f64)> {
    if !law.has_ties() || law.values().len() < law.parameters() * gaps.len() {
        return None;
    }
    let open = |pair: usize| {
        let gap = *gaps.get(pair)?;
        (law.is_tied(pair, gap) && gap != 0.0).then_some((pair, gap))
    };
    pairs.find_map(open)
}

/// The first of some pairs whose law has a tension, with the tension; none where numbers of pairs are missing.
pub fn first_tension(
    (gaps, law): (&[f64], FrictionLaw<'_>),
    mut pairs: impl Iterator<Item = usize>,
) -> Option<(usize, f64)> {
    if law.values().len() < law.parameters() * gaps.len() {
        return None;
    }
    pairs.find_map(|pair| match law.of_pair(pair) {
        (Law::Cohesive, &[_, _, tension]) if tension > 0.0 => Some((pair, tension)),
        _ => None,
    })
}

/// The first of some pairs whose gap is a penetration, with its gap.
pub fn first_penetration(gaps: &[f64], pairs: impl Iterator<Item = usize>) -> Option<(usize, f64)> {
    pairs.filter_map(|pair| Some((pair, *gaps.get(pair)?))).find(|&(_, gap)| gap < 0.0)
}
