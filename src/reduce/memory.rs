//! Most bytes that a dense reduction takes, known before work begins. `tests/memory/estimate.rs` counts.

use crate::linalg::memory::of_matrices;

/// Matrices of the size of `K`: the one that is kept, and those of two bodies while they are worked out.
const MATRICES: f64 = 4.5;

/// Most bytes that [`Model::condensed`](crate::Model::condensed) and
/// [`Model::two_body`](crate::Model::two_body) take for so many unknowns, what they return among
/// them.
pub fn memory(unknowns: usize) -> u64 {
    of_matrices(MATRICES, unknowns)
}

/// Bytes of [`memory`] without matrices.
pub fn memory_of_vectors(unknowns: usize) -> u64 {
    of_matrices(0.0, unknowns)
}
