//! Most bytes that a solution takes beside its data, known before work begins.
//!
//! Matrices of the size of `K` decide. Their greatest number at a time was counted over all methods, laws and
//! endings; `tests/memory.rs` counts again, and keeps the estimate above what is taken and below three
//! times of it.

use crate::settings::{Search, Settings};

/// Matrices of the size of `K` that a method holds at most.
const MATRICES: f64 = 4.0;

/// Further ones while other solutions are looked for, the first solution being there.
const FOR_OTHERS: f64 = 1.0;

/// Further ones while existence is proved.
const FOR_PROOF: f64 = 1.0;

/// Vectors of the size of a load, each a number of 8 bytes for each unknown.
const VECTORS: f64 = 200.0;

/// Whatever the size: blocks of matrix products among it.
const ALWAYS: f64 = 262_144.0;

/// Most bytes that [`solve`](super::solve()) takes for so many unknowns, beside the problem itself.
pub fn memory(unknowns: usize, settings: &Settings) -> u64 {
    let n = unknowns as f64;
    let others = if settings.search == Search::Others { FOR_OTHERS } else { 0.0 };
    let proof = if settings.proof { FOR_PROOF } else { 0.0 };
    let numbers = (MATRICES + others + proof) * n * n + VECTORS * n;
    (numbers * size_of::<f64>() as f64 + ALWAYS) as u64
}
