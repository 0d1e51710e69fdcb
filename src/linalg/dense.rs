//! Dense kernels of factorisations, by faer on the calling thread.

use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::{
    LltError, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par, Spec};

use super::matrix::TILE;

/// Writes `a bᵀ`, column-major, or adds it.
pub fn product(target: &mut [f64], accum: Accum, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    let target = MatMut::from_column_major_slice_mut(target, a.nrows(), b.nrows());
    matmul(target, accum, a, b.transpose(), 1.0, Par::Seq);
}

/// Subtracts `a bᵀ`.
pub fn subtract_product(target: MatMut<'_, f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    matmul(target, Accum::Add, a, b.transpose(), -1.0, Par::Seq);
}

/// Writes the lower triangle of `l lᵀ`, column-major, or adds it.
pub fn square(target: &mut [f64], accum: Accum, l: MatRef<'_, f64>) {
    let target = MatMut::from_column_major_slice_mut(target, l.nrows(), l.nrows());
    lower_square(target, accum, l, 1.0);
}

/// Subtracts the lower triangle of `l lᵀ`.
pub fn subtract_square(target: MatMut<'_, f64>, l: MatRef<'_, f64>) {
    lower_square(target, Accum::Add, l, -1.0);
}

fn lower_square(target: MatMut<'_, f64>, accum: Accum, l: MatRef<'_, f64>, factor: f64) {
    triangular::matmul(
        target,
        BlockStructure::TriangularLower,
        accum,
        l,
        BlockStructure::Rectangular,
        l.transpose(),
        BlockStructure::Rectangular,
        factor,
        Par::Seq,
    );
}

/// Subtracts a product, column-major with `count` rows, from the entries `(row(i), column(j))` of a matrix; of a
/// `square` one the lower triangle. Rows ascend.
pub fn scattered(
    mut target: MatMut<'_, f64>,
    product: &[f64],
    count: usize,
    row: impl Fn(usize) -> usize,
    column: impl Fn(usize) -> usize,
    square: bool,
) {
    let runs = runs(count, row);
    for (j, product) in product.chunks_exact(count).enumerate() {
        let first = if square { j } else { 0 };
        let target = target.as_mut().col_mut(column(j)).try_as_col_major_mut();
        let target = target.expect("columns are contiguous").as_slice_mut();
        for RowRun { from, end, to } in &runs[runs.partition_point(|run| run.end <= first)..] {
            let begin = first.max(*from);
            let target = &mut target[to + begin - from..to + end - from];
            target.iter_mut().zip(&product[begin..*end]).for_each(|(t, product)| *t -= product);
        }
    }
}

/// Consecutive rows of a product, up to `end`, that go to consecutive ones from `to` on.
struct RowRun {
    from: usize,
    end: usize,
    to: usize,
}

fn runs(count: usize, row: impl Fn(usize) -> usize) -> Vec<RowRun> {
    let mut runs: Vec<RowRun> = Vec::new();
    for i in 0..count {
        match runs.last_mut() {
            Some(run) if row(i) == run.to + i - run.from => run.end = i + 1,
            _ => runs.push(RowRun { from: i, end: i + 1, to: row(i) }),
        }
    }
    runs
}

/// Working memory of [`root`].
pub fn scratch(width: usize) -> StackReq {
    cholesky_in_place_scratch::<f64>(width, Par::Seq, Spec::default())
}

/// Factorises a diagonal block. Returns the column of a pivot that is not positive.
pub fn root(block: MatMut<'_, f64>, stack: &mut MemStack) -> Result<(), usize> {
    let regularization = LltRegularization::default();
    match cholesky_in_place(block, regularization, Par::Seq, stack, Spec::default()) {
        Ok(_) => Ok(()),
        Err(LltError::NonPositivePivot { index }) => Err(index),
    }
}

/// Divides rows by the factor of their diagonal block.
pub fn divide(factor: MatRef<'_, f64>, rows: MatMut<'_, f64>) {
    solve_lower_triangular_in_place(factor, rows.transpose_mut(), Par::Seq);
}

/// Copies the lower triangle to the upper one.
pub fn mirror(matrix: &mut [f64], size: usize) {
    for begin in (0..size).step_by(TILE) {
        for across in (begin..size).step_by(TILE) {
            for j in begin..size.min(begin + TILE) {
                for i in across.max(j + 1)..size.min(across + TILE) {
                    matrix[j + size * i] = matrix[i + size * j];
                }
            }
        }
    }
}
