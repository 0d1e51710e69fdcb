//! Dense Cholesky factorisation of a semi-definite matrix.

use faer::linalg::matmul::matmul;
use faer::{Accum, MatRef, Par};

use super::columns::Columns;
use super::dense::{self, Triangle};
use super::factor::cholesky;
use super::sparse_matrix::as_column_mut;
use super::tolerances::SUSPICIOUS_PIVOT;
use super::watched::{BLOCK, GoesOn, lower_triangle};

/// Rank-revealing Cholesky factor of a positive semi-definite matrix `A` with a diagonal of size one, or
/// less in rows that little resists: `A[p, p] = L Lᵀ` on the independent rows `p`; the other rows depend on
/// them.
#[derive(Debug)]
pub struct PivotedCholesky {
    lower: Columns,
    /// Independent rows, in the order of the factor.
    pub independent: Vec<usize>,
    /// Rows that depend on the independent ones.
    pub dependent: Vec<usize>,
}

impl PivotedCholesky {
    /// Factorises the `n x n` matrix whose lower triangle is `entry(i, j)`, `i >= j`; rows whose pivots are at most `least`
    /// depend on the others. `None` if it is not positive semi-definite, or if `go_on` ends it, which is asked between
    /// panels.
    pub fn within(
        size: usize,
        least: f64,
        entry: impl Fn(usize, usize) -> f64 + Sync,
        go_on: GoesOn<'_>,
    ) -> Option<Self> {
        // No pivot exceeds its diagonal entry.
        let (rows, mut dependent): (Vec<usize>, Vec<usize>) =
            (0..size).partition(|&i| entry(i, i) > least);
        let n = rows.len();
        let fill = |go_on: GoesOn<'_>| lower_triangle(n, |i, j| entry(rows[i], rows[j]), go_on);
        let mut lower = fill(go_on)?;
        let mut has_ended = false;
        let asked = &mut || {
            has_ended = has_ended || !go_on();
            !has_ended
        };
        let regular = cholesky(lower.as_mut(), asked).is_some();
        if has_ended {
            return None;
        }
        if regular && (0..n).all(|i| lower[(i, i)].powi(2) > least.max(SUSPICIOUS_PIVOT)) {
            return Some(PivotedCholesky { lower, independent: rows, dependent });
        }
        drop(lower);
        let mut lower = fill(go_on)?;
        let (order, rank) = pivoted(&mut lower, least, go_on)?;
        dependent.splice(..0, order[rank..].iter().map(|&i| rows[i]));
        Some(PivotedCholesky {
            lower,
            independent: order[..rank].iter().map(|&i| rows[i]).collect(),
            dependent,
        })
    }

    /// `A⁻¹ b` on the independent rows: each row with its component. `b(row)` is asked for these rows alone.
    pub fn solution(&self, b: impl Fn(usize) -> f64) -> Vec<(usize, f64)> {
        let mut y: Vec<f64> = self.independent.iter().map(|&i| b(i)).collect();
        let (lower, mut column) = (self.lower(), as_column_mut(&mut y));
        Triangle::Lower.solve(lower, column.as_mut());
        Triangle::Upper.solve(lower.transpose(), column);
        self.independent.iter().copied().zip(y).collect()
    }

    /// The factor of the independent rows.
    fn lower(&self) -> MatRef<'_, f64> {
        let rank = self.independent.len();
        self.lower.as_ref().get(..rank, ..rank)
    }

    /// Operations of [`Self::schur_complement`].
    pub fn schur_work(&self, m: usize) -> f64 {
        let (n, m) = (self.independent.len() as f64, m as f64);
        n * m * (n + m)
    }

    /// `C - Bᵀ A⁻¹ B` for `m` columns, `B = coupling(row, column)` over the independent rows
    /// named as in [`Self::independent`], `C = corner(i, j)` symmetric; column-major `m x m`. `None` where `goes_on` says
    /// no, which is asked between blocks of columns.
    pub fn schur_complement(
        &self,
        m: usize,
        coupling: impl Fn(usize, usize) -> f64 + Sync,
        corner: impl Fn(usize, usize) -> f64 + Sync,
        goes_on: GoesOn<'_>,
    ) -> Option<Vec<f64>> {
        let coupling = |i: usize, column: &mut [f64]| {
            (0..m).for_each(|j| column[j] = coupling(self.independent[i], j));
        };
        let corner = |j: usize, column: &mut [f64]| {
            (j..m).zip(column).for_each(|(i, entry)| *entry = corner(i, j));
        };
        Some(dense::schur_complement(self.lower(), m, coupling, corner, goes_on)?.1)
    }
}

/// Overwrites the lower triangle with Cholesky's factor of the rows in another order, of the largest pivot that is left
/// first, panel by panel (C. Lucas, LAPACK working note 161, 2004). Returns that order, and how many pivots are above
/// `least`; `None` where one is no number, or `goes_on` says no.
fn pivoted(matrix: &mut Columns, least: f64, goes_on: GoesOn<'_>) -> Option<(Vec<usize>, usize)> {
    let n = matrix.nrows();
    let mut order: Vec<usize> = (0..n).collect();
    for begin in (0..n).step_by(BLOCK) {
        if !goes_on() {
            return None;
        }
        let end = n.min(begin + BLOCK);
        // The diagonal of what is left.
        let mut left: Vec<f64> = (0..n).map(|i| matrix[(i, i)]).collect();
        for j in begin..end {
            let most = (j..n).reduce(|most, i| if left[i] > left[most] { i } else { most })?;
            if left[j..].iter().any(|left| left.is_nan()) {
                return None;
            }
            if left[most] <= least {
                return Some((order, j));
            }
            exchange(matrix, j, most);
            left.swap(j, most);
            order.swap(j, most);
            let rows = matrix.as_mut().submatrix_mut(j, begin, n - j, j + 1 - begin);
            let (before, mut column) = rows.split_at_col_mut(j - begin);
            let (own, below) = before.as_ref().split_at_row(1);
            matmul(
                column.as_mut().split_at_row_mut(1).1,
                Accum::Add,
                below,
                own.transpose(),
                -1.0,
                Par::Seq,
            );
            let root = left[j].sqrt();
            let column = &mut matrix.column_mut(j)[j..];
            column[0] = root;
            for (entry, left) in column[1..].iter_mut().zip(&mut left[j + 1..]) {
                *entry /= root;
                *left -= entry.powi(2);
            }
        }
        let all = matrix.as_mut().submatrix_mut(begin, begin, n - begin, n - begin);
        let (_, _, below, rest) = all.split_at_mut(end - begin, end - begin);
        dense::subtract_square(rest, below.as_ref(), &mut || true);
    }
    Some((order, n))
}

/// Exchanges the rows and columns `j < p` of a symmetric matrix whose lower triangle is kept, but for the diagonal entry of
/// `j`, which is lost.
fn exchange(matrix: &mut Columns, j: usize, p: usize) {
    if j == p {
        return;
    }
    let n = matrix.nrows();
    let mut swap = |one: (usize, usize), other: (usize, usize)| {
        (matrix[one], matrix[other]) = (matrix[other], matrix[one]);
    };
    (0..j).for_each(|k| swap((j, k), (p, k)));
    (j + 1..p).for_each(|k| swap((k, j), (p, k)));
    (p + 1..n).for_each(|k| swap((k, j), (k, p)));
    matrix[(p, p)] = matrix[(j, j)];
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gram matrices of vectors in a space of fewer dimensions: the rank is that of the space, pivots fall, and `L Lᵀ` is the
    /// matrix in the new order up to `n u` of its entries, which are of the size of the dimension.
    #[test]
    fn the_rank_of_gram_matrices_is_found_with_largest_pivots_first() {
        let mut rng = fastrand::Rng::with_seed(4);
        for (n, rank) in
            [(1, 1), (7, 3), (BLOCK, BLOCK), (BLOCK + 9, 20), (3 * BLOCK, 2 * BLOCK + 1)]
        {
            let vectors: Vec<Vec<f64>> =
                (0..n).map(|_| (0..rank).map(|_| 2.0 * rng.f64() - 1.0).collect()).collect();
            let gram = |i: usize, j: usize| crate::linalg::vector::dot(&vectors[i], &vectors[j]);
            let mut factor = lower_triangle(n, gram, &mut || true).expect("it is not ended");
            let (order, found) = pivoted(&mut factor, 1e-10, &mut || true).expect("numbers");
            assert_eq!(found, rank, "{n}");
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..n));
            assert!((1..rank).all(|j| factor[(j, j)] <= factor[(j - 1, j - 1)]));
            let most = 10.0 * (n * rank) as f64 * f64::EPSILON;
            for j in 0..n {
                for i in j..n {
                    let terms = (0..rank.min(j + 1)).map(|k| factor[(i, k)] * factor[(j, k)]);
                    let apart = terms.sum::<f64>() - gram(order[i], order[j]);
                    assert!(apart.abs() <= most, "{n}: {i}, {j}: {apart:e}");
                }
            }
            for ended in 0..rank.div_ceil(BLOCK) {
                let again = lower_triangle(n, gram, &mut || true);
                let (mut again, mut asked) = (again.expect("it is not ended"), 0);
                let goes_on = &mut || {
                    asked += 1;
                    asked <= ended
                };
                assert!(pivoted(&mut again, 1e-10, goes_on).is_none());
            }
        }
    }
}
