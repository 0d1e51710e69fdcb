//! Data that are legal and look like a mistake of the host; pairs that touch.

use super::{Contact, State};
use crate::linalg::tolerances::{NEGLIGIBLE, ROUNDING};
use crate::linalg::vector::{largest_of, norm_inf};
use crate::problem::{ContactProblem, FrictionLaw, Parameter, Relation};

/// Coefficients of friction above this are rather percent, or another array: rubber on dry concrete has
/// about 1.
const LARGE_FRICTION: f64 = 10.0;

/// The deepest gap, if every finite one is negative, and there is one. Ties prescribe theirs.
pub fn deepest_of_negative_gaps<R: Relation>(problem: &ContactProblem<'_, R>) -> Option<f64> {
    let gaps = (0..problem.pairs()).filter(|&pair| !problem.is_tied(pair));
    let gaps = gaps.map(|pair| problem.gap(pair)).filter(|gap| gap.is_finite());
    let largest = gaps.clone().fold(f64::NEG_INFINITY, f64::max);
    (largest < 0.0 && largest.is_finite()).then(|| -gaps.fold(0.0, f64::min))
}

/// The largest gap or normal displacement of a pair with an obstacle. 0 where all gaps are no more than rounding beside
/// the displacements: without gaps nothing is passed, as displacements that are small beside what the loads would do are as
/// good as none, and none obeys the law.
pub fn size_of_gaps<R: Relation>(problem: &ContactProblem<'_, R>, d: &[f64]) -> f64 {
    let pairs = || (0..problem.pairs()).filter(|&pair| problem.gap(pair).is_finite());
    let gap = largest_of(pairs().map(|pair| problem.gap(pair).abs()));
    let normal = largest_of(pairs().map(|pair| d[problem.dim() * pair].abs()));
    if gap > NEGLIGIBLE * norm_inf(d) { gap.max(normal) } else { 0.0 }
}

/// True if the penetration of `d` is more than the square root of the tolerance beside the size of the gaps, and more than
/// rounding of displacements. `eta` takes a penetration as a force beside the loads: such gaps ask for more digits than it
/// has, and forces may be those of other gaps. A solution has less where the loads would move the bodies by less than the
/// gaps over that root.
pub fn passes_gaps<R: Relation>(
    problem: &ContactProblem<'_, R>,
    (d, penetration): (&[f64], f64),
    tolerance: f64,
) -> bool {
    let size = size_of_gaps(problem, d);
    let least = (tolerance.sqrt() * size).max(ROUNDING * norm_inf(d));
    size > 0.0 && penetration > least
}

/// Returns `true` if a coefficient of friction is large.
pub fn friction_is_large(law: FrictionLaw<'_>) -> bool {
    law.each().any(|(meaning, value)| {
        matches!(meaning, Parameter::Coefficient | Parameter::Axis) && value > LARGE_FRICTION
    })
}

/// The pairs that touch at `d`, whether they press or not.
pub fn touching<'c>(
    contact: &'c Contact<'_>,
    d: &'c [f64],
    states: &'c [State],
) -> impl Iterator<Item = usize> + 'c {
    let near = NEGLIGIBLE * norm_inf(d);
    (0..contact.pairs().len()).filter(move |&pair| {
        let gap = contact.problem().gap(pair);
        states[pair] != State::Open || gap - d[contact.dim() * pair] <= near
    })
}
