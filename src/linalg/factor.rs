//! Dense factors of square systems, by faer.

use std::mem::MaybeUninit;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::lu::partial_pivoting;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_unit_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};

use super::columns::Columns;
use super::dense::{self, Triangle};
use super::small_products::by_rows;
use super::watched::{
    BLOCK, GoesOn, SHORT, SIDE, blocks_of_columns, columns_of, filled, lower_triangle,
};
use crate::workers::each;

/// Operations of a Cholesky factorisation of `n` rows.
pub fn cholesky_work(n: usize) -> f64 {
    (n as f64).powi(3) / 3.0
}

/// Operations of an `LU` factorisation of `n` rows; of the inverse by Cholesky's factor, [`Factor::inverse`], too.
pub fn lu_work(n: usize) -> f64 {
    2.0 * cholesky_work(n)
}

/// Factors of a square matrix whose entries are of size one: Cholesky's or `LU`.
pub struct Factor {
    factors: Columns,
    kind: Kind,
    /// The least pivot of Cholesky's method, 1 if there is none; 0 of other factors.
    pub least_pivot: f64,
    /// Sign of the determinant.
    pub sign: i8,
}

enum Kind {
    Cholesky,
    Lu(RowOrder),
}

/// The order in which an elimination with row pivots takes the rows.
pub struct RowOrder {
    /// The row that comes to each place.
    pub order: Vec<usize>,
    /// True if its permutation is odd.
    odd: bool,
}

impl Factor {
    /// Factorises the `n x n` matrix whose columns `fill(j, column)` writes, of a symmetric positive
    /// definite one on and below the diagonal. `None` if it is not positive definite as promised; if it is singular:
    /// if pivots are below `least`, relative to the largest; or where `goes_on` says no.
    pub fn new(
        n: usize,
        symmetric: bool,
        least: f64,
        fill: impl Fn(usize, &mut [f64]) + Sync,
        goes_on: GoesOn<'_>,
    ) -> Option<Self> {
        let mut factors = filled((n, n), fill, goes_on)?;
        let kind = if symmetric {
            cholesky(factors.as_mut(), goes_on).map(|()| Kind::Cholesky)?
        } else {
            lu(factors.as_mut(), goes_on).map(Kind::Lu)?
        };
        let diagonal = (0..n).map(|i| factors[(i, i)]);
        let (pivots, odd): (Vec<f64>, bool) = match &kind {
            Kind::Cholesky => (diagonal.map(|root| root.powi(2)).collect(), false),
            Kind::Lu(rows) => (diagonal.collect(), rows.odd),
        };
        let largest = pivots.iter().copied().map(f64::abs).fold(0.0, f64::max);
        // Written so that NaN is singular too.
        if !pivots.iter().all(|pivot| pivot.abs() > least * largest) {
            return None;
        }
        let negative = pivots.iter().filter(|pivot| **pivot < 0.0).count();
        let sign = if (negative % 2 == 1) == odd { 1 } else { -1 };
        let least_pivot = if symmetric { pivots.into_iter().fold(1.0, f64::min) } else { 0.0 };
        Some(Factor { factors, kind, least_pivot, sign })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.factors.nrows()
    }

    /// Overwrites columns of right-hand sides, contiguous, with solutions.
    pub fn solve(&self, rhs: &mut [f64]) {
        let n = self.size();
        if n == 0 || rhs.is_empty() {
            return;
        }
        if let Kind::Lu(RowOrder { order, .. }) = &self.kind {
            for rhs in rhs.chunks_exact_mut(n) {
                let before = rhs.to_vec();
                rhs.iter_mut().zip(order).for_each(|(rhs, &from)| *rhs = before[from]);
            }
        }
        let columns = rhs.len() / n;
        let mut rhs = MatMut::from_column_major_slice_mut(rhs, n, columns);
        let factors = self.factors.as_ref();
        match self.kind {
            Kind::Cholesky => solve_cholesky(factors, rhs),
            Kind::Lu(_) => {
                Triangle::UnitLower.solve(factors, rhs.as_mut());
                Triangle::Upper.solve(factors, rhs);
            }
        }
    }

    /// The inverse by Cholesky's factor, column-major. Of columns of the identity nothing is left above the diagonal, and
    /// entries of the inverse on and below it depend on those below alone: a third of the operations of [`Self::solve`].
    ///
    /// # Errors
    /// `goes_on` says why not, asked with the operations that come next.
    pub fn inverse<E>(&self, mut goes_on: impl FnMut(f64) -> Result<(), E>) -> Result<Vec<f64>, E> {
        let n = self.size();
        let mut inverse = vec![0.0; n * n];
        let mut all = MatMut::from_column_major_slice_mut(&mut inverse, n, n);
        for first in (0..n).step_by(BLOCK) {
            let (width, rows) = (BLOCK.min(n - first), n - first);
            goes_on(2.0 * (rows * rows * width) as f64)?;
            let mut columns = all.as_mut().submatrix_mut(first, first, rows, width);
            columns.as_mut().diagonal_mut().fill(1.0);
            solve_cholesky(self.factors.as_ref().submatrix(first, first, rows, rows), columns);
        }
        dense::mirror(&mut inverse, n);
        Ok(inverse)
    }
}

/// Overwrites columns with solutions by Cholesky's factor.
fn solve_cholesky(factor: MatRef<'_, f64>, columns: MatMut<'_, f64>) {
    by_rows(columns, &mut Vec::new(), |mut columns| {
        Triangle::Lower.solve(factor, columns.as_mut());
        Triangle::Upper.solve(factor.transpose(), columns);
    });
}

/// Lends scratch memory to `work`. Small matrices have theirs on the stack: an allocation takes as long as their
/// factorisation.
fn with_scratch<R>(request: StackReq, work: impl FnOnce(&mut MemStack) -> R) -> R {
    let mut few = [const { MaybeUninit::uninit() }; 2048];
    if request.unaligned_bytes_required() <= few.len() {
        return work(MemStack::new(&mut few));
    }
    work(MemStack::new(&mut MemBuffer::new(request)))
}

/// Overwrites the lower triangle of a symmetric matrix with Cholesky's factor; `None` if the matrix is not
/// positive definite, or where `goes_on` says no.
pub fn cholesky(matrix: MatMut<'_, f64>, goes_on: GoesOn<'_>) -> Option<()> {
    cholesky_to_failure(matrix, goes_on).ok()
}

/// The first row with which the leading block of the symmetric `n x n` matrix, its lower triangle `entry(i, j)`,
/// is not positive definite, or one at which `goes_on` says no.
pub fn first_not_definite(
    n: usize,
    entry: impl Fn(usize, usize) -> f64 + Sync,
    goes_on: GoesOn<'_>,
) -> Option<usize> {
    let Some(mut lower) = lower_triangle(n, entry, goes_on) else { return Some(0) };
    cholesky_to_failure(lower.as_mut(), goes_on).err()
}

/// The width of the blocks in which `n` columns are factorised.
fn width_of_blocks(n: usize) -> usize {
    if n <= SHORT { n.max(1) } else { BLOCK }
}

/// Cholesky's factor, or the row of the pivot that is not positive, or of the block at which it was ended.
fn cholesky_to_failure(mut matrix: MatMut<'_, f64>, goes_on: GoesOn<'_>) -> Result<(), usize> {
    let (n, most) = (matrix.nrows(), width_of_blocks(matrix.nrows()));
    with_scratch(dense::scratch(most), |stack| {
        for begin in (0..n).step_by(most) {
            if begin > 0 && !goes_on() {
                return Err(begin);
            }
            let (width, left) = (most.min(n - begin), n - begin);
            let all = matrix.as_mut().submatrix_mut(begin, begin, left, left);
            let (mut root, _, mut below, rest) = all.split_at_mut(width, width);
            dense::root(root.as_mut(), stack).map_err(|column| begin + column)?;
            dense::divide(root.as_ref(), below.as_mut());
            dense::subtract_square(rest, below.as_ref(), &mut || true);
        }
        Ok(())
    })
}

/// Columns of a matrix while it is factorised.
enum Part<'a> {
    /// Those of panels before.
    Before,
    /// The next panel, of which the order of rows is looked for.
    Next(&'a mut RowOrder),
    /// Those behind it.
    After,
}

/// Overwrites a matrix with its factors `LU`, with row pivots; `None` where `goes_on` says no. One thread factorises the next panel
/// while others are at the columns behind it.
pub fn lu(mut matrix: MatMut<'_, f64>, goes_on: GoesOn<'_>) -> Option<RowOrder> {
    let (n, most) = (matrix.nrows(), width_of_blocks(matrix.nrows()));
    let mut all = RowOrder { order: (0..n).collect(), odd: false };
    let mut next = lu_of_panel(matrix.as_mut().subcols_mut(0, most.min(n)));
    for begin in (0..n).step_by(most) {
        if begin > 0 && !goes_on() {
            return None;
        }
        let (width, left) = (most.min(n - begin), n - begin);
        let moved: Vec<(usize, usize)> = (begin..n)
            .zip(next.order.iter().map(|&from| begin + from))
            .filter(|(to, from)| to != from)
            .collect();
        exchange(&mut all.order, &moved);
        all.odd ^= next.odd;
        let (before, from) = matrix.as_mut().split_at_col_mut(begin);
        let (own, after) = from.split_at_col_mut(width);
        let (root, below) = own.as_ref().get(begin.., ..).split_at_row(width);
        let (panel, after) = after.split_at_col_mut(most.min(left - width));
        let panel = (panel.ncols() > 0).then_some((panel, Part::Next(&mut next)));
        let after = blocks_of_columns(after, SIDE).map(|columns| (columns, Part::After));
        let before = blocks_of_columns(before, SIDE).map(|columns| (columns, Part::Before));
        let columns = panel.into_iter().chain(after).chain(before);
        each(columns, (left * left * width) as f64, |(mut columns, part)| {
            columns_of(columns.as_mut()).for_each(|column| exchange(column, &moved));
            if let Part::Before = part {
                return;
            }
            let (_, all) = columns.split_at_row_mut(begin);
            let (mut beside, mut rest) = all.split_at_row_mut(width);
            solve_unit_lower_triangular_in_place(root, beside.as_mut(), Par::Seq);
            matmul(rest.as_mut(), Accum::Add, below, beside.as_ref(), -1.0, Par::Seq);
            if let Part::Next(order) = part {
                *order = lu_of_panel(rest);
            }
        });
    }
    Some(all)
}

/// Overwrites columns with their factors; the order of their rows.
fn lu_of_panel(panel: MatMut<'_, f64>) -> RowOrder {
    let ((rows, columns), spec) = (panel.shape(), faer::Spec::default());
    let (mut order, mut back) = (vec![0; rows], vec![0; rows]);
    let request =
        partial_pivoting::factor::lu_in_place_scratch::<usize, f64>(rows, columns, Par::Seq, spec);
    let (info, _) = with_scratch(request, |stack| {
        let par = Par::Seq;
        partial_pivoting::factor::lu_in_place(panel, &mut order, &mut back, par, stack, spec)
    });
    RowOrder { order, odd: info.transposition_count % 2 == 1 }
}

/// Moves values all at once: each pair is the new place and the old one.
fn exchange<T: Copy>(values: &mut [T], moved: &[(usize, usize)]) {
    let taken: Vec<T> = moved.iter().map(|&(_, from)| values[from]).collect();
    moved.iter().zip(taken).for_each(|(&(to, _), value)| values[to] = value);
}
