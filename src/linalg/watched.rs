//! Long works on dense matrices, by blocks of columns between which it is asked if they go on.

use faer::MatMut;

use super::columns::Columns;
use crate::workers::{each_while, reading};

/// Columns of a block, which stays in a cache: between two of them a long work asks if it goes on.
pub const BLOCK: usize = 64;

/// Rows or columns of a part of a product, which a thread does at once: products of so many are fast.
pub const SIDE: usize = 256;

/// Additions and multiplications between two questions: some ten milliseconds.
pub const WORK: usize = 1 << 28;

/// Columns of a block where each takes so many additions and multiplications.
pub fn block(work: usize) -> usize {
    (WORK / work.max(1)).clamp(1, BLOCK)
}

/// Rows up to which a matrix is factorised in one go: a few milliseconds.
pub const SHORT: usize = 512;

/// Is asked whether a work goes on.
pub type GoesOn<'a> = &'a mut dyn FnMut() -> bool;

/// The result of a work that ends early only where `goes_on` says no, and that nobody ends.
pub fn unended<T>(work: impl FnOnce(GoesOn<'_>) -> Option<T>) -> T {
    work(&mut || true).expect("nobody ends it")
}

/// The columns of a matrix, at most so many at a time.
pub fn blocks_of_columns(
    matrix: MatMut<'_, f64>,
    most: usize,
) -> impl Iterator<Item = MatMut<'_, f64>> {
    let mut left = Some(matrix);
    std::iter::from_fn(move || {
        let all = left.take().filter(|all| all.ncols() > 0)?;
        let count = most.min(all.ncols());
        let (first, others) = all.split_at_col_mut(count);
        left = Some(others);
        Some(first)
    })
}

/// The columns of a block of a matrix whose columns are contiguous.
pub fn columns_of(block: MatMut<'_, f64>) -> impl Iterator<Item = &mut [f64]> {
    block
        .col_iter_mut()
        .map(|column| column.try_as_col_major_mut().expect("columns are contiguous").as_slice_mut())
}

/// The matrix of so many rows and columns whose columns `fill(j, column)` writes; `None` where `goes_on` says no.
pub fn filled(
    (rows, columns): (usize, usize),
    fill: impl Fn(usize, &mut [f64]) + Sync,
    goes_on: GoesOn<'_>,
) -> Option<Columns> {
    let mut matrix = Columns::zeros(rows, columns);
    let (values, ld) = matrix.values_mut();
    fill_columns(values, ld, |j, column| fill(j, &mut column[..rows]), goes_on).then_some(matrix)
}

/// Writes each of the contiguous columns of so many rows by `fill(j, column)`; `false` where `goes_on` says no.
pub fn fill_columns(
    values: &mut [f64],
    rows: usize,
    fill: impl Fn(usize, &mut [f64]) + Sync,
    goes_on: GoesOn<'_>,
) -> bool {
    let (work, is_long) = (reading(values.len()), values.len() > SHORT * SHORT);
    // So many numbers take far longer than to hand the part out.
    let at_once = (BLOCK * SIDE / rows.max(1)).clamp(1, BLOCK);
    let blocks = values.chunks_mut((rows * at_once).max(1)).enumerate();
    let fill = |(block, columns): (usize, &mut [f64])| {
        let columns = columns.chunks_exact_mut(rows).zip(at_once * block..);
        columns.for_each(|(column, j)| fill(j, column));
    };
    each_while(blocks, work, fill, &mut || !is_long || goes_on())
}

/// The contiguous columns of so many rows that `fill(j, column)` writes, in `memory` if there is any.
pub fn written(
    mut memory: Vec<f64>,
    (rows, columns): (usize, usize),
    fill: impl Fn(usize, &mut [f64]) + Sync,
) -> Vec<f64> {
    let length = rows * columns;
    match memory.is_empty() {
        true => memory = vec![0.0; length],
        false => memory.resize(length, 0.0),
    }
    fill_columns(&mut memory, rows, fill, &mut || true);
    memory
}

/// The lower triangle `entry(i, j)` of an `n x n` matrix; `None` where `goes_on` says no.
pub fn lower_triangle(
    n: usize,
    entry: impl Fn(usize, usize) -> f64 + Sync,
    goes_on: GoesOn<'_>,
) -> Option<Columns> {
    let fill = |j: usize, column: &mut [f64]| (j..n).for_each(|i| column[i] = entry(i, j));
    filled((n, n), fill, goes_on)
}
