//! Dense kernels of the factorisation.

use faer::dyn_stack::MemStack;
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization, cholesky_in_place};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par, Spec};

/// The first `many` columns of `factor * L Lᵀ` on and below the diagonal.
pub fn trapezoid(
    target: MatMut<'_, f64>,
    accum: Accum,
    l: MatRef<'_, f64>,
    many: usize,
    factor: f64,
) {
    let (top, bottom) = target.split_at_row_mut(many);
    let (upper, lower) = l.split_at_row(many);
    triangular::matmul(
        top,
        BlockStructure::TriangularLower,
        accum,
        upper,
        BlockStructure::Rectangular,
        upper.transpose(),
        BlockStructure::Rectangular,
        factor,
        Par::Seq,
    );
    let below = lower.nrows();
    if below > 0 {
        matmul(bottom, accum, lower, upper.transpose(), factor, Par::Seq);
    }
}

/// Factorises the diagonal block of a panel and divides its rows by it. Returns the column of a pivot that
/// is not positive.
pub fn eliminate(panel: &mut [f64], width: usize, stack: &mut MemStack) -> Result<(), usize> {
    let stride = panel.len() / width;
    let panel = MatMut::from_column_major_slice_mut(panel, stride, width);
    let (mut top, mut rows) = panel.split_at_row_mut(width);
    let regularization = LltRegularization::default();
    match cholesky_in_place(top.as_mut(), regularization, Par::Seq, stack, Spec::default()) {
        Ok(_) => {}
        Err(LltError::NonPositivePivot { index }) => return Err(index),
    }
    solve_lower_triangular_in_place(top.as_ref(), rows.as_mut().transpose_mut(), Par::Seq);
    Ok(())
}

/// Copies the lower triangle to the upper one.
pub fn mirror(matrix: &mut [f64], size: usize) {
    /// Columns and rows of a block: both triangles of it stay in the cache.
    const BLOCK: usize = 32;
    for begin in (0..size).step_by(BLOCK) {
        for across in (begin..size).step_by(BLOCK) {
            for j in begin..size.min(begin + BLOCK) {
                for i in across.max(j + 1)..size.min(across + BLOCK) {
                    matrix[j + size * i] = matrix[i + size * j];
                }
            }
        }
    }
}
