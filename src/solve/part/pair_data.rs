//! The data of a contact problem on some of the pairs, beside its relation.

use crate::problem::{ContactProblem, Relation};

/// Gaps, parameters of the law and reference slips of some pairs.
pub struct PairData {
    pub gap: Vec<f64>,
    pub parameters: Vec<f64>,
    pub slip: Vec<f64>,
}

impl PairData {
    /// The data of these pairs of a problem.
    pub fn of<R: Relation>(problem: &ContactProblem<'_, R>, pairs: &[usize]) -> Self {
        let parameters = |pair: &usize| problem.law().numbers(*pair).iter().copied();
        let slips =
            |&pair: &usize| (1..problem.dim()).map(move |c| problem.reference_slip(pair, c - 1));
        PairData {
            gap: pairs.iter().map(|&pair| problem.gap(pair)).collect(),
            parameters: pairs.iter().flat_map(parameters).collect(),
            slip: pairs.iter().flat_map(slips).collect(),
        }
    }
}
