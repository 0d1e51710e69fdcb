//! Dense Cholesky factorisation of a semi-definite matrix, by faer on the calling thread.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt_pivoting::factor as pivoted;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use super::dense::{self, mirror, subtract_square};
use super::factor::{BLOCK, GoesOn, cholesky, cholesky_work};
use super::tolerances::{NEGLIGIBLE, SUSPICIOUS_PIVOT};

/// Operations in whose time a factorisation of `n` rows is made: at first without pivots, and if rows may depend on
/// others once more with them, half of it at the speed of memory.
pub fn pivoted_cholesky_work(n: usize) -> f64 {
    3.0 * cholesky_work(n)
}

/// Rank-revealing Cholesky factor of a positive semi-definite matrix `A` with a diagonal of size one, or
/// less in rows that little resists: `A[p, p] = L Lᵀ` on the independent rows `p`; the other rows depend on
/// them.
pub struct PivotedCholesky {
    lower: Mat<f64>,
    independent: Vec<usize>,
    dependent: Vec<usize>,
}

impl PivotedCholesky {
    /// Factorises the `n x n` matrix whose lower triangle is `entry(i, j)`, `i >= j`.
    /// `None` if it is not positive semi-definite.
    pub fn new(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<Self> {
        Self::within(n, NEGLIGIBLE, entry, &mut || true)
    }

    /// As [`Self::new`]; rows whose pivots are at most `least` depend on the others. `None` also if `go_on` ends it,
    /// which is asked between panels.
    pub fn within(
        size: usize,
        least: f64,
        entry: impl Fn(usize, usize) -> f64,
        go_on: GoesOn<'_>,
    ) -> Option<Self> {
        // No pivot exceeds its diagonal entry.
        let (rows, mut dependent): (Vec<usize>, Vec<usize>) =
            (0..size).partition(|&i| entry(i, i) > least);
        let n = rows.len();
        let lower_entry = |i: usize, j: usize| if i >= j { entry(rows[i], rows[j]) } else { 0.0 };
        let fill = || Mat::from_fn(n, n, lower_entry);
        let mut lower = fill();
        let mut has_ended = false;
        let asked = &mut || {
            has_ended = has_ended || !go_on();
            !has_ended
        };
        let regular = cholesky(&mut lower, asked).is_some();
        if has_ended {
            return None;
        }
        if regular && (0..n).all(|i| lower[(i, i)].powi(2) > SUSPICIOUS_PIVOT) {
            return Some(PivotedCholesky { lower, independent: rows, dependent });
        }
        drop(lower);
        let mut lower = fill();
        let (mut forward, mut inverse) = (vec![0_usize; n], vec![0_usize; n]);
        let scratch =
            pivoted::cholesky_in_place_scratch::<usize, f64>(n, Par::Seq, faer::Spec::default());
        let info = pivoted::cholesky_in_place(
            lower.as_mut(),
            &mut forward,
            &mut inverse,
            Par::Seq,
            MemStack::new(&mut MemBuffer::new(scratch)),
            faer::Spec::default(),
        );
        let Ok((info, _)) = info else { return None };
        let rank = (0..info.rank).find(|&i| lower[(i, i)].powi(2) <= least).unwrap_or(info.rank);
        dependent.splice(..0, forward[rank..].iter().map(|&i| rows[i]));
        Some(PivotedCholesky {
            lower: lower.as_ref().submatrix(0, 0, rank, rank).to_owned(),
            independent: forward[..rank].iter().map(|&i| rows[i]).collect(),
            dependent,
        })
    }

    /// Independent rows, in the order of the factor.
    pub fn independent(&self) -> &[usize] {
        &self.independent
    }

    /// Rows that depend on the independent ones.
    pub fn dependent(&self) -> &[usize] {
        &self.dependent
    }

    /// Overwrites `y`, in the order of [`Self::independent`], with `A⁻¹ y` on these rows.
    pub fn solve(&self, y: &mut [f64]) {
        let n = self.independent.len();
        let mut y = MatMut::from_column_major_slice_mut(y, n, 1);
        triangular_solve::solve_lower_triangular_in_place(
            self.lower.as_ref(),
            y.as_mut(),
            Par::Seq,
        );
        triangular_solve::solve_upper_triangular_in_place(self.lower.transpose(), y, Par::Seq);
    }

    /// Operations of [`Self::schur_complement`].
    pub fn schur_work(&self, m: usize) -> f64 {
        let (n, m) = (self.independent.len() as f64, m as f64);
        n * m * (n + m)
    }

    /// `C - Bᵀ A⁻¹ B` for `m` columns, `B = coupling(row, column)` over the independent rows
    /// named as in [`Self::independent`], `C = corner(i, j)` symmetric; column-major `m x m`. `go_on` is asked between
    /// blocks of columns; if it ends the work, the rest is `C`.
    pub fn schur_complement(
        &self,
        m: usize,
        coupling: impl Fn(usize, usize) -> f64,
        corner: impl Fn(usize, usize) -> f64,
        go_on: GoesOn<'_>,
    ) -> Vec<f64> {
        let n = self.independent.len();
        let mut half = Mat::from_fn(m, n, |j, i| coupling(self.independent[i], j));
        let mut schur = vec![0.0; m * m];
        for j in 0..m {
            for i in j..m {
                schur[i + m * j] = corner(i, j);
            }
        }
        let blocks = || (0..m).step_by(BLOCK).map(|begin| (begin, BLOCK.min(m - begin)));
        let mut left = MatMut::from_column_major_slice_mut(&mut schur, m, m);
        for (begin, count) in blocks() {
            if !go_on() {
                break;
            }
            let (before, rows) = half.as_mut().split_at_row_mut(begin);
            let mut rows = rows.subrows_mut(0, count);
            dense::divide(self.lower.as_ref(), rows.as_mut());
            let mut target = left.as_mut().subrows_mut(begin, count);
            let (earlier, own) = target.as_mut().split_at_col_mut(begin);
            matmul(earlier, Accum::Add, rows.as_ref(), before.transpose(), -1.0, Par::Seq);
            subtract_square(own.subcols_mut(0, count), rows.as_ref());
        }
        mirror(&mut schur, m);
        schur
    }
}

/// `C - X Xᵀ` from the lower triangle of the symmetric `C`, both triangles; column-major.
pub fn subtract_gram(c: &mut [f64], x: MatRef<'_, f64>) {
    let m = x.nrows();
    subtract_square(MatMut::from_column_major_slice_mut(c, m, m), x);
    mirror(c, m);
}
