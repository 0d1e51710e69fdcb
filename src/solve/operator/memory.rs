//! Most bytes that a solution on an operator takes, known before work begins.

use super::directions::{self, MOST_DIRECTIONS, most_kept};
use crate::solve::result::memory as memory_of_dense;

/// Other vectors of all unknowns.
const VECTORS: usize = 60;

/// Bytes that are little beside what any program takes.
const LITTLE: u64 = 1 << 27;

/// Most bytes that a solution takes for so many unknowns, beside what the bodies take.
pub fn memory(unknowns: usize) -> u64 {
    room(unknowns) + vectors(VECTORS, unknowns)
}

/// Bytes that the directions of a step take, and then, for itself, a dense problem of some components.
pub fn room(unknowns: usize) -> u64 {
    let directions = MOST_DIRECTIONS + most_kept(unknowns);
    vectors(directions::VECTORS * directions, unknowns)
        .max(LITTLE.min(memory_of_components(unknowns)))
}

/// Bytes that a dense problem of so many components takes.
pub fn memory_of_components(components: usize) -> u64 {
    vectors(components, components) + memory_of_dense(components)
}

fn vectors(count: usize, unknowns: usize) -> u64 {
    (count * size_of::<f64>() * unknowns) as u64
}
