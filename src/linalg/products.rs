//! Working memory of matrix products.

use std::hint::black_box;

use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

use super::sparse_matrix::OutOfMemory;
use crate::shortage;

/// Most bytes of the working memory that a thread keeps for matrix products: twice its share of the last cache,
/// which is at most 32 MiB on the processors of today, and small change.
pub const MOST: usize = 72 << 20;

/// Rows and columns from which on faer uses that memory.
const SIZE: usize = 64;

static FACTOR: [f64; SIZE * SIZE] = [0.0; SIZE * SIZE];

/// Makes the calling thread obtain that memory, which it otherwise does at its first product.
pub fn prepare() -> Result<(), OutOfMemory> {
    let mut product: Vec<f64> = Vec::new();
    product.try_reserve_exact(SIZE * SIZE).map_err(|_| OutOfMemory)?;
    if shortage::is_noted() {
        return Err(OutOfMemory);
    }
    product.resize(SIZE * SIZE, 0.0);
    let factor = MatRef::from_column_major_slice(black_box(&FACTOR[..]), SIZE, SIZE);
    let target = MatMut::from_column_major_slice_mut(&mut product, SIZE, SIZE);
    matmul(target, Accum::Replace, factor, factor, 1.0, Par::Seq);
    black_box(product);
    Ok(())
}
