//! Most bytes that a solution takes beside its data, known before work begins.
//!
//! Matrices of the size of `K` decide. Their greatest number at a time was counted over all methods, laws and
//! questions; `tests/memory/estimate.rs` and `tests/memory/peaks.rs` count again.

use crate::error::{Error, Limit};
use crate::linalg::memory::of_matrices;
use crate::problem::{FlexibilityForm, FlexibilityProblem};
use crate::settings::Settings;

/// Matrices of the size of `K` that a method holds at most: with springs on bodies that contact alone holds, and an
/// elimination and its systems beside them. The tableau of Lemke's method with friction is 9/4 alone.
const MATRICES: f64 = 4.25;

/// Vectors with a number for each unknown of all islands.
const VECTORS_OF_WHOLE: f64 = 32.0;

/// Refuses what needs more bytes than the settings allow.
pub fn check_limit(needed: u64, settings: &Settings) -> Result<(), Error> {
    let limit = settings.memory_limit;
    if limit == 0 || needed <= limit {
        return Ok(());
    }
    let [needed, most] = [needed, limit].map(|bytes| bytes as f64 / 1e6);
    let message = format!(
        "the solution may need {needed:.1} MB, settings: memory_limit allows {limit} bytes ({most:.1} MB); \
         nothing was done"
    );
    Err(Error::stopped(Limit::Memory, message))
}

/// Most bytes that [`solve`](crate::solve::solve()) and [`solve_lcp`](crate::solve::solve_lcp()) take for so many unknowns,
/// beside the problem itself, whatever the method, the law and the questions. The working memory of matrix
/// products, 4 MiB that a thread keeps, is not counted.
pub fn memory(unknowns: usize) -> u64 {
    of_matrices(MATRICES, unknowns)
}

/// Bytes of [`solve_flexibility`](crate::solve::solve_flexibility), which holds the stiffness of bodies and springs
/// besides. Of a sparse `W` those of its largest island as a dense problem, of which the matrix is made, and of the
/// problem itself, which has a copy of the host's matrix.
pub fn memory_flexibility(problem: &FlexibilityProblem<'_>) -> u64 {
    memory_of_flexibility(&problem.relation().form)
}

/// As [`memory_flexibility`], from the matrix alone.
pub fn memory_of_flexibility(form: &FlexibilityForm<'_>) -> u64 {
    let square = |n: usize| (n as f64).powi(2) * size_of::<f64>() as f64;
    let dense = |n: usize| memory(n) + square(n) as u64;
    match form {
        FlexibilityForm::Dense(matrix) => dense(matrix.size()),
        FlexibilityForm::Sparse(matrix) => {
            let largest = matrix.largest_part();
            let vectors = VECTORS_OF_WHOLE * (matrix.size() * size_of::<f64>()) as f64;
            let copy = matrix.entries() as f64 * (size_of::<usize>() + size_of::<f64>()) as f64;
            dense(largest) + (square(largest) + vectors + copy) as u64
        }
    }
}
