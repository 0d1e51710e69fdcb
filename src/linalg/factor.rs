//! Dense factors of square systems, by faer on the calling thread.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt;
use faer::linalg::lu::partial_pivoting as lu;
use faer::linalg::matmul::matmul;
use faer::perm::PermRef;
use faer::{Accum, Mat, MatMut, MatRef, Par};

use super::dense;
use super::small_products::{SMALL_PRODUCT, by_rows};
use super::tolerances::SINGULAR;
use super::vector::dot;

/// Operations of a Cholesky factorisation of `n` rows.
pub fn cholesky_work(n: usize) -> f64 {
    (n as f64).powi(3) / 3.0
}

/// Operations of an `LU` factorisation of `n` rows.
pub fn lu_work(n: usize) -> f64 {
    2.0 * cholesky_work(n)
}

/// Factors of a square matrix whose entries are of size one: Cholesky's or `LU`.
pub struct Factor {
    factors: Mat<f64>,
    kind: Kind,
    /// Scratch memory of [`Self::solve`], and for how many right-hand sides it is large enough.
    memory: MemBuffer,
    room: usize,
    /// Working memory of [`by_rows`].
    rows: Vec<f64>,
}

enum Kind {
    Cholesky,
    Lu { forward: Vec<usize>, inverse: Vec<usize>, odd: bool },
}

impl Factor {
    /// Factorises the `n x n` matrix whose columns `fill(j, column)` writes, of a symmetric positive
    /// definite one on and below the diagonal. `None` if it is singular to working precision, or
    /// not positive definite as promised.
    pub fn new(n: usize, symmetric: bool, fill: impl FnMut(usize, &mut [f64])) -> Option<Self> {
        Self::with_least_pivot(n, symmetric, SINGULAR, fill)
    }

    /// As [`Self::new`]; pivots below `least`, relative to the largest, make the matrix singular.
    pub fn with_least_pivot(
        n: usize,
        symmetric: bool,
        least: f64,
        mut fill: impl FnMut(usize, &mut [f64]),
    ) -> Option<Self> {
        let mut factors = Mat::zeros(n, n);
        for j in 0..n {
            fill(j, factors.col_as_slice_mut(j));
        }
        let kind = if symmetric {
            cholesky(&mut factors).map(|()| Kind::Cholesky)?
        } else {
            general(&mut factors)
        };
        let pivot = |i: usize| match kind {
            Kind::Cholesky => factors[(i, i)].powi(2),
            Kind::Lu { .. } => factors[(i, i)].abs(),
        };
        let largest = (0..n).map(pivot).fold(0.0, f64::max);
        // Written so that NaN is singular too.
        let regular = (0..n).all(|i| pivot(i) > least * largest);
        regular.then(|| Factor {
            factors,
            kind,
            memory: MemBuffer::new(StackReq::EMPTY),
            room: 0,
            rows: Vec::new(),
        })
    }

    /// Number of rows.
    pub fn size(&self) -> usize {
        self.factors.nrows()
    }

    /// Overwrites columns of right-hand sides, contiguous, with solutions.
    pub fn solve(&mut self, rhs: &mut [f64]) {
        let n = self.size();
        if n == 0 || rhs.is_empty() {
            return;
        }
        let columns = rhs.len() / n;
        let rhs = MatMut::from_column_major_slice_mut(rhs, n, columns);
        if columns > self.room {
            self.memory = MemBuffer::new(match self.kind {
                Kind::Cholesky => llt::solve::solve_in_place_scratch::<f64>(n, columns, Par::Seq),
                Kind::Lu { .. } => {
                    lu::solve::solve_in_place_scratch::<usize, f64>(n, columns, Par::Seq)
                }
            });
            self.room = columns;
        }
        let factors = self.factors.as_ref();
        let stack = MemStack::new(&mut self.memory);
        match &self.kind {
            Kind::Cholesky => by_rows(rhs, &mut self.rows, |rhs| {
                llt::solve::solve_in_place(factors, rhs, Par::Seq, stack);
            }),
            Kind::Lu { forward, inverse, .. } => {
                let order = PermRef::new_checked(forward, inverse, n);
                lu::solve::solve_in_place(factors, factors, order, rhs, Par::Seq, stack);
            }
        }
    }

    /// Sign of the determinant.
    pub fn sign(&self) -> i8 {
        let negative = (0..self.size()).filter(|&i| self.factors[(i, i)] < 0.0).count();
        let odd = matches!(self.kind, Kind::Lu { odd: true, .. });
        if (negative % 2 == 1) == odd { 1 } else { -1 }
    }
}

/// Overwrites the lower triangle of a symmetric matrix with Cholesky's factor; `None` if the matrix is not
/// positive definite.
pub fn cholesky(matrix: &mut Mat<f64>) -> Option<()> {
    cholesky_to_failure(matrix).ok()
}

/// The first row with which the leading block of the symmetric `n x n` matrix, its lower triangle `entry(i, j)`,
/// is not positive definite.
pub fn first_not_definite(n: usize, entry: impl Fn(usize, usize) -> f64) -> Option<usize> {
    let lower = |i: usize, j: usize| if i >= j { entry(i, j) } else { 0.0 };
    cholesky_to_failure(&mut Mat::from_fn(n, n, lower)).err()
}

/// Cholesky's factor, or the row of the pivot that is not positive.
fn cholesky_to_failure(matrix: &mut Mat<f64>) -> Result<(), usize> {
    let mut memory = MemBuffer::new(dense::scratch(matrix.nrows()));
    dense::root(matrix.as_mut(), MemStack::new(&mut memory))
}

fn general(matrix: &mut Mat<f64>) -> Kind {
    let n = matrix.nrows();
    let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
    let scratch =
        lu::factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, faer::Spec::default());
    let (info, _) = lu::factor::lu_in_place(
        matrix.as_mut(),
        &mut forward,
        &mut inverse,
        Par::Seq,
        MemStack::new(&mut MemBuffer::new(scratch)),
        faer::Spec::default(),
    );
    Kind::Lu { forward, inverse, odd: info.transposition_count % 2 == 1 }
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
    matmul(
        MatMut::from_column_major_slice_mut(target, rows, columns),
        Accum::Add,
        MatRef::from_column_major_slice(a, n, rows).transpose(),
        MatRef::from_column_major_slice(b, n, columns),
        -1.0,
        Par::Seq,
    );
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
