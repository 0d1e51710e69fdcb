//! Dense kernels of factorisations, by faer. Threads share what has many rows or columns, by blocks.

use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::{
    LltError, LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_unit_lower_triangular_in_place,
    solve_upper_triangular_in_place,
};
use faer::{Accum, MatMut, MatRef, Par, Spec};

use super::columns::Columns;
use super::small_products::SMALL_PRODUCT;
use super::vector::dot;
use super::watched::{BLOCK, GoesOn, SIDE, blocks_of_columns, fill_columns, filled};
use crate::workers::{each, each_while, reading};

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

/// Subtracts the lower triangle of `l lᵀ`; `None` where `goes_on` says no.
pub fn subtract_square(
    target: MatMut<'_, f64>,
    l: MatRef<'_, f64>,
    goes_on: GoesOn<'_>,
) -> Option<()> {
    let multiplications = (l.nrows() * l.nrows() * l.ncols()) as f64 / 2.0;
    let blocks = blocks_of_columns(target, SIDE).enumerate();
    let subtract = |(block, columns): (usize, MatMut<'_, f64>)| {
        let count = columns.ncols();
        let (_, rows) = columns.split_at_row_mut(SIDE * block);
        let (own, below) = rows.split_at_row_mut(count);
        let (across, others) = l.get(SIDE * block.., ..).split_at_row(count);
        add_product(own, Accum::Add, (across, across), -1.0, true);
        add_product(below, Accum::Add, (others, across), -1.0, false);
    };
    each_while(blocks, multiplications, subtract, goes_on).then_some(())
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
    let multiplications = (factor.nrows() * factor.nrows() * rows.nrows()) as f64 / 2.0;
    each(blocks_of_columns(rows.transpose_mut(), SIDE), multiplications, |rows| {
        solve_lower_triangular_in_place(factor, rows, Par::Seq);
    });
}

/// A solution by one thread.
type Solution = fn(MatRef<'_, f64>, MatMut<'_, f64>, Par);

/// The kind of a triangular matrix.
#[derive(Clone, Copy)]
pub enum Triangle {
    Lower,
    UnitLower,
    Upper,
}

impl Triangle {
    /// Overwrites `x` with `T⁻¹ x`, `T` this triangle of `matrix`, by blocks of rows. Few columns are too few to be shared at
    /// the corner of a block: one thread is at the next corner while others are at the rows beyond it.
    pub fn solve(self, matrix: MatRef<'_, f64>, mut x: MatMut<'_, f64>) {
        let (n, columns) = x.shape();
        let (blocks, are_few) = (n.div_ceil(SIDE), columns <= BLOCK / 2);
        let is_upper = matches!(self, Triangle::Upper);
        for step in 0..blocks {
            let block = if is_upper { blocks - 1 - step } else { step };
            let (begin, end) = (SIDE * block, n.min(SIDE * (block + 1)));
            let (above, from) = x.as_mut().split_at_row_mut(begin);
            let (mut own, below) = from.split_at_row_mut(end - begin);
            if step == 0 || !are_few {
                self.solve_corner(matrix, begin, own.as_mut());
            }
            let (others, first) = if is_upper { (above, 0) } else { (below, end) };
            let numbers = others.nrows() * (end - begin);
            let multiplications = reading(numbers).max((numbers * columns) as f64);
            let starts = (first..).step_by(SIDE);
            let mut parts: Vec<_> =
                starts.zip(blocks_of_columns(others.transpose_mut(), SIDE)).collect();
            if is_upper {
                parts.reverse();
            }
            each(parts.into_iter().enumerate(), multiplications, |(place, (first, others))| {
                let mut others = others.transpose_mut();
                let rows = matrix.get(first..first + others.nrows(), begin..end);
                matmul(others.as_mut(), Accum::Add, rows, own.as_ref(), -1.0, Par::Seq);
                if place == 0 && are_few {
                    self.solve_corner(matrix, first, others);
                }
            });
        }
    }

    /// [`Self::solve`] with the block on the diagonal from row `first` on, for its rows of `x`.
    fn solve_corner(self, matrix: MatRef<'_, f64>, first: usize, x: MatMut<'_, f64>) {
        let rows = first..first + x.nrows();
        let corner = matrix.get(rows.clone(), rows);
        let solved: Solution = match self {
            Triangle::Lower => solve_lower_triangular_in_place,
            Triangle::UnitLower => solve_unit_lower_triangular_in_place,
            Triangle::Upper => solve_upper_triangular_in_place,
        };
        let multiplications = (corner.nrows() * corner.nrows() * x.ncols()) as f64 / 2.0;
        each(blocks_of_columns(x, BLOCK / 2), multiplications, |x| solved(corner, x, Par::Seq));
    }
}

/// `X = B L⁻ᵀ` and `C - X Xᵀ`, both triangles, column-major, from a factor `L`; `coupling` writes a column of `B`, and
/// `corner` one of the symmetric `C` from the diagonal on, of `m` rows. `None` where `goes_on` says no, which is asked between
/// blocks.
pub fn schur_complement(
    lower: MatRef<'_, f64>,
    m: usize,
    coupling: impl Fn(usize, &mut [f64]) + Sync,
    corner: impl Fn(usize, &mut [f64]) + Sync,
    goes_on: GoesOn<'_>,
) -> Option<(Columns, Vec<f64>)> {
    let mut half = filled((m, lower.nrows()), coupling, goes_on)?;
    let mut schur = vec![0.0; m * m];
    fill_columns(&mut schur, m, |j, column| corner(j, &mut column[j..]), &mut || true);
    let multiplications = (lower.nrows() * lower.nrows() * m) as f64 / 2.0;
    let rows = blocks_of_columns(half.as_mut().transpose_mut(), BLOCK);
    let divided =
        each_while(rows, multiplications, |rows| divide(lower, rows.transpose_mut()), goes_on);
    let left = MatMut::from_column_major_slice_mut(&mut schur, m, m);
    divided.then(|| subtract_square(left, half.as_ref(), goes_on)).flatten()?;
    mirror(&mut schur, m);
    Some((half, schur))
}

/// Copies the lower triangle to the upper one.
pub fn mirror(matrix: &mut [f64], size: usize) {
    let columns = matrix.chunks_exact_mut(size.max(1)).enumerate();
    let halves = columns.map(|(j, column)| column.split_at_mut(j));
    let (mut above, from_diagonal): (Vec<_>, Vec<_>) = halves.unzip();
    let from_diagonal: Vec<&[f64]> = from_diagonal.into_iter().map(|column| &*column).collect();
    let blocks = above.chunks_mut(BLOCK).enumerate();
    each(blocks, reading(size * size), |(block, above)| {
        let first = BLOCK * block;
        for rows in (0..first + above.len()).step_by(BLOCK) {
            for (above, i) in above.iter_mut().zip(first..) {
                for j in rows..i.min(rows + BLOCK) {
                    above[j] = from_diagonal[j][i - j];
                }
            }
        }
    });
}

/// `target - Aᵀ B`, contiguous column-major matrices of `n` rows; `target` has a row for each
/// column of `A` and a column for each of `B`.
pub fn subtract_product(target: &mut [f64], a: &[f64], b: &[f64], n: usize) {
    if n == 0 || target.is_empty() {
        return;
    }
    let (rows, columns) = (a.len() / n, b.len() / n);
    if rows * columns * n <= SMALL_PRODUCT {
        for (target, b) in target.chunks_exact_mut(rows).zip(b.chunks_exact(n)) {
            target.iter_mut().zip(a.chunks_exact(n)).for_each(|(entry, a)| *entry -= dot(a, b));
        }
        return;
    }
    let target = MatMut::from_column_major_slice_mut(target, rows, columns);
    let (a, b) = (
        MatRef::from_column_major_slice(a, n, rows),
        MatRef::from_column_major_slice(b, n, columns),
    );
    // Blocks of the longer side, all about as long.
    let (target, a, b) = match columns > rows {
        true => (target, a, b),
        false => (target.transpose_mut(), b, a),
    };
    let length = b.ncols().div_ceil(b.ncols().div_ceil(SIDE));
    let blocks = blocks_of_columns(target, length).enumerate();
    each(blocks, reading(n * b.ncols()).max((rows * n * columns) as f64), |(block, target)| {
        let own = b.subcols(length * block, target.ncols());
        matmul(target, Accum::Add, a.transpose(), own, -1.0, Par::Seq);
    });
}

/// `target - sum_k x_k y_kᵀ` for a matrix of `shape` with leading dimension `ld`; the `x_k` and the
/// `y_k` are contiguous, one after the other.
pub fn subtract_outer(
    target: &mut [f64],
    (rows, columns): (usize, usize),
    ld: usize,
    x: &[f64],
    y: &[f64],
) {
    if x.is_empty() {
        return;
    }
    let count = x.len() / rows;
    matmul(
        MatMut::from_column_major_slice_with_stride_mut(target, rows, columns, ld),
        Accum::Add,
        MatRef::from_column_major_slice(x, rows, count),
        MatRef::from_column_major_slice(y, columns, count).transpose(),
        -1.0,
        Par::Seq,
    );
}
