//! Most bytes of work on dense matrices, known before it begins.

/// Vectors with a number for each unknown.
const VECTORS: f64 = 100.0;

/// Bytes that any work takes, however small.
const ALWAYS: f64 = 262_144.0;

/// Most bytes of work that holds so many square matrices of `size` rows at a time.
pub fn of_matrices(matrices: f64, size: usize) -> u64 {
    let n = size as f64;
    ((matrices * n * n + VECTORS * n) * size_of::<f64>() as f64 + ALWAYS) as u64
}
