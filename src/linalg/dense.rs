//! Dense kernels of factorisations, by faer on the calling thread.

use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::{
    LltError, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par, Spec};

use super::matrix::{TILE, tiles};
use super::watched::{BLOCK, GoesOn};

/// Subtracts the products `a bᵀ` from the entries `(row(i), column(j))` of a matrix, `i < rows` and `j < columns`; of
/// a `square` one, `a = b`, the lower triangle. Rows and columns ascend. `work` holds a product.
pub fn subtract_products<'a>(
    mut target: MatMut<'_, f64>,
    products: impl Iterator<Item = (MatRef<'a, f64>, MatRef<'a, f64>)>,
    (rows, row): (usize, impl Fn(usize) -> usize),
    (columns, column): (usize, impl Fn(usize) -> usize),
    square: bool,
    work: &mut [f64],
) {
    let follow = |count: usize, first: usize, last: usize| last + 1 - first == count;
    if follow(rows, row(0), row(rows - 1)) && follow(columns, column(0), column(columns - 1)) {
        let mut target = target.submatrix_mut(row(0), column(0), rows, columns);
        products.for_each(|(a, b)| add_product(target.as_mut(), Accum::Add, (a, b), -1.0, square));
        return;
    }
    let work = &mut work[..rows * columns];
    for (k, factors) in products.enumerate() {
        let accum = if k == 0 { Accum::Replace } else { Accum::Add };
        let sum = MatMut::from_column_major_slice_mut(work, rows, columns);
        add_product(sum, accum, factors, 1.0, square);
    }
    scatter(target.as_mut(), work, (rows, row), column, square);
}

/// Subtracts the lower triangle of `l lᵀ`.
pub fn subtract_square(target: MatMut<'_, f64>, l: MatRef<'_, f64>) {
    add_product(target, Accum::Add, (l, l), -1.0, true);
}

/// Adds `factor a bᵀ`, or writes it; of a `square`, `a = b`, the lower triangle.
fn add_product(
    target: MatMut<'_, f64>,
    accum: Accum,
    (a, b): (MatRef<'_, f64>, MatRef<'_, f64>),
    factor: f64,
    square: bool,
) {
    if !square {
        return matmul(target, accum, a, b.transpose(), factor, Par::Seq);
    }
    triangular::matmul(
        target,
        BlockStructure::TriangularLower,
        accum,
        a,
        BlockStructure::Rectangular,
        b.transpose(),
        BlockStructure::Rectangular,
        factor,
        Par::Seq,
    );
}

/// Subtracts a product, column-major, from the entries `(row(i), column(j))` of a matrix; of a `square` one the lower
/// triangle.
fn scatter(
    mut target: MatMut<'_, f64>,
    product: &[f64],
    (count, row): (usize, impl Fn(usize) -> usize),
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

/// `C - X Xᵀ` from the lower triangle of the symmetric `C`, both triangles; column-major. `X = B L⁻ᵀ` takes the place of
/// `B`. `None` where `goes_on` says no, which is asked between blocks of rows.
pub fn subtract_coupling(
    c: &mut [f64],
    lower: MatRef<'_, f64>,
    mut b: MatMut<'_, f64>,
    goes_on: GoesOn<'_>,
) -> Option<()> {
    let m = b.nrows();
    let mut left = MatMut::from_column_major_slice_mut(c, m, m);
    for begin in (0..m).step_by(BLOCK) {
        if !goes_on() {
            return None;
        }
        let count = BLOCK.min(m - begin);
        let (before, rows) = b.as_mut().split_at_row_mut(begin);
        let mut rows = rows.subrows_mut(0, count);
        divide(lower, rows.as_mut());
        let mut target = left.as_mut().subrows_mut(begin, count);
        let (earlier, own) = target.as_mut().split_at_col_mut(begin);
        matmul(earlier, Accum::Add, rows.as_ref(), before.transpose(), -1.0, Par::Seq);
        subtract_square(own.subcols_mut(0, count), rows.as_ref());
    }
    mirror(c, m);
    Some(())
}

/// Copies the lower triangle to the upper one.
pub fn mirror(matrix: &mut [f64], size: usize) {
    for (columns, rows) in tiles(size, TILE) {
        for j in columns {
            for i in rows.start.max(j + 1)..rows.end {
                matrix[j + size * i] = matrix[i + size * j];
            }
        }
    }
}
