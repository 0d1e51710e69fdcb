//! Most bytes that a solution on an operator takes, known before work begins.

use super::directions::{self, MOST_DIRECTIONS, most_kept};
use crate::solve::result::memory as memory_of_dense;

/// Other vectors of all unknowns.
const VECTORS: usize = 60;

/// Bytes that are little beside what any program takes.
const LITTLE: u64 = 1 << 27;

/// Most bytes that a load case takes for so many components of pairs and, in full space, inner unknowns, beside what the
/// bodies take.
pub fn memory_of_case(inner: Option<usize>, components: usize) -> u64 {
    match inner {
        Some(inner) => room(inner, components) + vectors(VECTORS, inner + components),
        None => memory_of_dense(components),
    }
}

/// Bytes that the directions of a step take, and then, for itself, a dense problem of some of the components.
pub fn room(inner: usize, components: usize) -> u64 {
    let unknowns = inner + components;
    let directions = MOST_DIRECTIONS + most_kept(unknowns);
    vectors(directions::VECTORS * directions, unknowns)
        .max(LITTLE.min(memory_of_components(components)))
}

/// Bytes that a dense problem of so many components takes.
pub fn memory_of_components(components: usize) -> u64 {
    vectors(components, components) + memory_of_dense(components)
}

fn vectors(count: usize, unknowns: usize) -> u64 {
    (count * size_of::<f64>() * unknowns) as u64
}
