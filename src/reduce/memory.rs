//! Most bytes that a dense reduction takes, known before work begins. `tests/memory/estimate.rs` counts.

/// Matrices of the size of `K`: the one that is kept, and those of two bodies while they are worked out.
const MATRICES: f64 = 4.5;

/// Vectors with a number for each unknown.
const VECTORS: f64 = 100.0;

/// Whatever the size.
const ALWAYS: f64 = 262_144.0;

/// Most bytes that [`Model::condensed`](crate::Model::condensed) and
/// [`Model::two_body`](crate::Model::two_body) take for so many unknowns, what they return among
/// them.
pub fn memory(unknowns: usize) -> u64 {
    let n = unknowns as f64;
    ((MATRICES * n * n + VECTORS * n) * size_of::<f64>() as f64 + ALWAYS) as u64
}
