//! Products of small matrices on a small stack.
//!
//! faer copies the operands of a small product to 64 KiB of the stack where the left one does not lie by columns, as
//! in `L⁻ᵀ B` and its parts. Calls of the library have no more stack than that altogether. Where `B` and the result
//! lie by rows, faer takes the product for its transpose, and copies nothing.

use faer::MatMut;

use super::watched::{SIDE, blocks_of_columns};
use crate::workers::{each, reading};

/// Most multiplications of a product that faer takes for a small one (`NANO_GEMM_THRESHOLD` in its sources).
pub const SMALL_PRODUCT: usize = 16 * 16 * 16;

/// Hands `block` over by rows, and takes it back; threads share both copies. `work` is overwritten.
pub fn by_rows(
    mut block: MatMut<'_, f64>,
    work: &mut Vec<f64>,
    change: impl FnOnce(MatMut<'_, f64>),
) {
    let (rows, columns) = block.shape();
    // faer has routines of their own for one column.
    if columns == 1 {
        return change(block);
    }
    work.clear();
    work.resize(rows * columns, 0.0);
    let mut copy = MatMut::from_row_major_slice_mut(work, rows, columns);
    copy_rows(copy.as_mut(), block.as_mut());
    change(copy.as_mut());
    copy_rows(block, copy);
}

/// Copies a matrix to another one.
fn copy_rows(to: MatMut<'_, f64>, from: MatMut<'_, f64>) {
    let numbers = from.nrows() * from.ncols();
    let blocks = |all| blocks_of_columns(MatMut::transpose_mut(all), SIDE);
    each(blocks(to).zip(blocks(from)), reading(numbers), |(mut to, from)| to.copy_from(from));
}
