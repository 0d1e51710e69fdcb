//! Contact forces that grow without end, and what they show.

use crate::error::{MOST_NAMED, index};
use crate::law::{COUNTS, bounded, exceed_gaps};
use crate::linalg::vector::{norm, norm_inf};
use crate::problem::{ContactProblem, Redundant};

/// So many rounds that add the same forces are enough to see that they do not end, and so many after the first solution for
/// forces to settle: `eta` feels an error in a pattern of forces by its flexibility alone, and is small before forces of
/// nearly redundant pairs are right. A flexibility of `1e-8` beside that of the pairs takes five.
pub const ENOUGH: usize = 8;

/// Forces added by two rounds are the same if they differ by less than this part: rounds that still tend to
/// something at such a rate would take thousands.
const SAME: f64 = 1e-4;

/// True if forces grow by the same pattern round by round.
#[derive(Default)]
pub struct Growth {
    last: Option<Vec<f64>>,
    same: usize,
}

impl Growth {
    /// Takes note of the forces that a round has added.
    pub fn add(&mut self, change: Vec<f64>) {
        let is_same = |last: &Vec<f64>| {
            let apart: Vec<f64> = last.iter().zip(&change).map(|(a, b)| a - b).collect();
            norm(&change) > 0.0 && norm(&apart) <= SAME * norm(&change)
        };
        self.same = if self.last.as_ref().is_some_and(is_same) { self.same + 1 } else { 0 };
        self.last = Some(change);
    }

    /// True if the last two rounds have added the same forces.
    pub fn is_steady(&self) -> bool {
        self.same > 0
    }

    /// The forces that each of the last rounds has added, if they go on and on.
    pub fn pattern(&self) -> Option<&[f64]> {
        self.last.as_deref().filter(|_| self.same >= ENOUGH)
    }
}

/// The forces of a pattern which prove that no displacements meet all gaps, if they do: all of them, or those that carry, as others
/// may still tend to something.
pub fn proof_in<R: Redundant>(
    problem: &ContactProblem<'_, R>,
    pattern: &[f64],
) -> Option<Vec<f64>> {
    let relation = problem.relation();
    let forces = bounded(problem, pattern);
    let least = COUNTS * norm_inf(&forces);
    let carry = forces.iter().map(|force| if force.abs() > least { *force } else { 0.0 }).collect();
    [forces, carry].into_iter().find(|forces| {
        relation.balance_each_other(forces, 0.0) && exceed_gaps(problem, forces, relation.offset())
    })
}

/// Why there is no solution: the pattern in which forces grow, and whether it is `proved` that gaps contradict each
/// other. `number` tells which pair of the host a pair is.
pub fn sentence<R: Redundant>(
    problem: &ContactProblem<'_, R>,
    pattern: &[f64],
    proved: bool,
    number: &dyn Fn(usize) -> usize,
) -> String {
    let dim = problem.dim();
    let least = COUNTS * norm_inf(pattern);
    let carries = |pair: &usize| norm_inf(&pattern[dim * pair..dim * (pair + 1)]) > least;
    let pairs: Vec<usize> = (0..problem.pairs()).filter(carries).collect();
    let named = named(&pairs.iter().copied().map(number).collect::<Vec<_>>());
    if proved && pairs.iter().any(|&pair| problem.is_tied(pair)) {
        return format!(
            "no solution exists: the gaps or slips of pairs {named} contradict each other, as ties prescribe them \
             and the bodies cannot have both"
        );
    }
    if proved {
        return format!(
            "no solution exists: the gaps of pairs {named} contradict each other, as bodies cannot leave \
             one without entering another"
        );
    }
    // The pattern is known as well as two rounds agree.
    let balance = problem.relation().balance_each_other(pattern, SAME);
    let how = if balance { " and balance each other, as those of a wedge" } else { "" };
    format!("no solution was found: the forces of pairs {named} grow without end{how}")
}

/// The numbers of the first few pairs.
pub fn named(pairs: &[usize]) -> String {
    let named: Vec<String> = pairs.iter().take(MOST_NAMED).map(index).collect();
    let more = if pairs.len() > MOST_NAMED { ", ..." } else { "" };
    format!("{}{more}", named.join(", "))
}
