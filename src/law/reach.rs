//! Which obstacles are out of reach: their gaps are so large beside all that moves the pairs that they
//! only take digits from it.
//!
//! Lengths of pairs are compared after they are multiplied by `sqrt(K_ii)`, loads after they are divided by
//! it: roots of energies, whatever the units.

use super::Contact;
use crate::problem::Relation;

/// The gaps, those that are out of reach `+inf`; `None` if there are none. Out of reach is what is more than
/// `far` times longer than what loads on their own components, slips and nearer gaps make pairs move, and
/// than `moved`, displacements that are known to occur.
pub fn gaps_within_reach<R: Relation>(
    contact: &Contact<'_, R>,
    moved: &[f64],
    far: f64,
) -> Option<Vec<f64>> {
    let relation = contact.problem().relation();
    let dim = contact.dim();
    let root = |i: usize| relation.block(i, i).sqrt();
    let loads = relation.load().iter().enumerate().map(|(i, f)| f.abs() / root(i));
    let moved = moved.iter().enumerate().map(|(i, d)| d.abs() * root(i));
    let mut reach = loads.chain(moved).fold(0.0, f64::max);
    // The reach only grows from here: nothing is far beside it if the longest gap is not.
    let longest = contact.pairs().iter().enumerate().filter(|(_, law)| law.has_obstacle());
    let longest = longest.map(|(pair, law)| law.gap * root(dim * pair)).fold(0.0, f64::max);
    if longest <= far * reach {
        return None;
    }
    let mut gaps: Vec<f64> = Vec::with_capacity(contact.pairs().len());
    let mut lengths = Vec::with_capacity(gaps.capacity());
    for (pair, law) in contact.pairs().iter().enumerate() {
        gaps.push(law.gap);
        let first = dim * pair;
        for (c, slip) in law.slip0[..dim - 1].iter().enumerate() {
            reach = reach.max(slip.abs() * root(first + 1 + c));
        }
        let length = law.gap.abs() * root(first);
        if law.gap < 0.0 || law.tied {
            reach = reach.max(length);
        } else if law.has_obstacle() {
            lengths.push((length, pair));
        }
    }
    // Nothing moves, or nothing can be told.
    if !(reach > 0.0 && reach.is_finite()) {
        return None;
    }
    lengths.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut near = 0;
    while near < lengths.len() && lengths[near].0 <= far * reach {
        reach = reach.max(lengths[near].0);
        near += 1;
    }
    for &(_, pair) in &lengths[near..] {
        gaps[pair] = f64::INFINITY;
    }
    (near < lengths.len()).then_some(gaps)
}
