//! Gaps that no displacements meet: a proof by normal forces alone.
//!
//! Where normal forces `p >= 0` balance each other in all that the rows allow, `sum p d_n` is the same `sum p o_n`
//! for all displacements, `o` those of fixed values. Every `d_n <= gap` would make it at most `sum p gap`. If that
//! is less, the gaps contradict each other, whatever the friction.

use crate::problem::{ContactProblem, FrictionLaw, Relation};

/// Part of the sum's terms by which it must be negative: rounding of the forces is far below.
const LEAST: f64 = 1e-6;

/// The pressing normal forces of a pattern, all other components zero.
pub fn pressing(dim: usize, pattern: &[f64]) -> Vec<f64> {
    let part = |(i, force): (usize, &f64)| if i % dim == 0 { force.min(0.0) } else { 0.0 };
    pattern.iter().enumerate().map(part).collect()
}

/// Returns `true` if pressing forces that balance each other prove that the gaps contradict each other; `offset` is `o`.
pub fn exceed_gaps<R: Relation>(
    problem: &ContactProblem<'_, R>,
    pressing: &[f64],
    offset: &[f64],
) -> bool {
    let dim = problem.dim();
    let term = |pair: usize| {
        let p = -pressing[dim * pair];
        if p > 0.0 { p * (problem.gap(pair) - offset[dim * pair]) } else { 0.0 }
    };
    let (sum, size) = (0..problem.pairs())
        .map(term)
        .fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
    sum < -LEAST * size
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

/// The first of some pairs whose gap is a penetration, with its gap.
pub fn first_penetration(gaps: &[f64], pairs: impl Iterator<Item = usize>) -> Option<(usize, f64)> {
    pairs.filter_map(|pair| Some((pair, *gaps.get(pair)?))).find(|&(_, gap)| gap < 0.0)
}
