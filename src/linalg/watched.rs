//! Long works on dense matrices, by blocks of columns between which it is asked if they go on.

use faer::Mat;

/// Columns of a block, which stays in a cache: between two of them a long work asks if it goes on.
pub const BLOCK: usize = 64;

/// Additions and multiplications between two questions: some ten milliseconds.
const WORK: usize = 1 << 28;

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

/// The matrix of so many rows and columns whose columns `fill(j, column)` writes; `None` where `goes_on` says no.
pub fn filled(
    (rows, columns): (usize, usize),
    mut fill: impl FnMut(usize, &mut [f64]),
    goes_on: GoesOn<'_>,
) -> Option<Mat<f64>> {
    let mut matrix = Mat::zeros(rows, columns);
    let is_long = rows * columns > SHORT * SHORT;
    for j in 0..columns {
        if is_long && j % BLOCK == 0 && !goes_on() {
            return None;
        }
        fill(j, matrix.col_as_slice_mut(j));
    }
    Some(matrix)
}

/// The lower triangle `entry(i, j)` of an `n x n` matrix; `None` where `goes_on` says no.
pub fn lower_triangle(
    n: usize,
    entry: impl Fn(usize, usize) -> f64,
    goes_on: GoesOn<'_>,
) -> Option<Mat<f64>> {
    let fill = |j: usize, column: &mut [f64]| (j..n).for_each(|i| column[i] = entry(i, j));
    filled((n, n), fill, goes_on)
}
