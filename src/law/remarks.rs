//! Data that are legal and look like a mistake of the host; pairs that touch.

use super::{Contact, State};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;
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
