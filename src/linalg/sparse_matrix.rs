//! Sparse matrices in compressed columns, rows ascending, by faer on the calling thread.

use faer::sparse::linalg::matmul::{sparse_dense_matmul, sparse_sparse_matmul};
use faer::sparse::{SparseColMat, SymbolicSparseColMat, Triplet};
use faer::{Accum, MatMut, MatRef, Par};

/// Compressed columns, rows ascending.
pub type Csc = SparseColMat<usize, f64>;

/// Not enough memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfMemory;

/// The matrix of `shape` whose column `j` has the rows and values from `col_start[j]` to
/// `col_start[j + 1]`; rows ascend.
pub fn from_columns(
    (rows, columns): (usize, usize),
    col_start: Vec<usize>,
    row: Vec<usize>,
    values: Vec<f64>,
) -> Csc {
    Csc::new(SymbolicSparseColMat::new_checked(rows, columns, col_start, None, row), values)
}

/// The matrix of `shape` with entries (row, column, value) in any order; those of one place add up.
pub fn from_entries(
    (rows, columns): (usize, usize),
    entries: impl Iterator<Item = (usize, usize, f64)>,
) -> Result<Csc, OutOfMemory> {
    let entries: Vec<_> = entries.map(|(i, j, value)| Triplet::new(i, j, value)).collect();
    Csc::try_new_from_triplets(rows, columns, &entries).map_err(|_| OutOfMemory)
}

/// Rows and values of a column.
pub fn column(a: &Csc, j: usize) -> (&[usize], &[f64]) {
    let range = a.symbolic().col_range(j);
    (&a.symbolic().row_idx()[range.clone()], &a.val()[range])
}

/// The diagonal entry of column `j` of a lower triangle, if it is stored.
pub fn diagonal(lower: &Csc, j: usize) -> Option<f64> {
    let (rows, values) = column(lower, j);
    (rows.first() == Some(&j)).then(|| values[0])
}

/// Rows from `first` on that are stored in column `j` of `a` or of `b`, with both values; 0 stands for
/// one that is not stored.
pub fn both<'a>(
    a: &'a Csc,
    b: &'a Csc,
    j: usize,
    first: usize,
) -> impl Iterator<Item = (usize, f64, f64)> + 'a {
    let tail = |matrix: &'a Csc| {
        let (rows, values) = column(matrix, j);
        let skipped = rows.partition_point(|&i| i < first);
        rows[skipped..].iter().copied().zip(values[skipped..].iter().copied()).peekable()
    };
    let (mut a, mut b) = (tail(a), tail(b));
    std::iter::from_fn(move || {
        let i = [a.peek(), b.peek()].into_iter().flatten().map(|(i, _)| *i).min()?;
        let value = |tail: &mut std::iter::Peekable<_>| {
            tail.next_if(|(row, _): &(usize, f64)| *row == i).map_or(0.0, |(_, value)| value)
        };
        Some((i, value(&mut a), value(&mut b)))
    })
}

/// `Aᵀ`.
pub fn transposed(a: &Csc) -> Result<Csc, OutOfMemory> {
    a.transpose().to_col_major().map_err(|_| OutOfMemory)
}

/// `A x`.
pub fn times(a: &Csc, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; a.nrows()];
    let (target, x) = (as_column_mut(&mut y), as_column(x));
    sparse_dense_matmul(target, Accum::Replace, a.as_ref(), x, 1.0, Par::Seq);
    y
}

/// `Aᵀ x`.
pub fn transpose_times(a: &Csc, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; a.ncols()];
    let (target, x) = (as_column_mut(&mut y), as_column(x));
    sparse_dense_matmul(target, Accum::Replace, a.transpose(), x, 1.0, Par::Seq);
    y
}

fn as_column(x: &[f64]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(x, x.len(), 1)
}

fn as_column_mut(x: &mut [f64]) -> MatMut<'_, f64> {
    let length = x.len();
    MatMut::from_column_major_slice_mut(x, length, 1)
}

/// The lower triangle of `Wᵀ A W`; `lower` is that of the symmetric `A`.
///
/// With `A = H + Hᵀ`, `H` the lower triangle with half the diagonal, it is `Wᵀ H W` and its transpose:
/// no product needs the upper triangle.
pub fn congruence(mut lower: Csc, w: &Csc) -> Result<Csc, OutOfMemory> {
    for j in 0..lower.ncols() {
        if diagonal(&lower, j).is_some() {
            let place = lower.symbolic().col_ptr()[j];
            lower.val_mut()[place] *= 0.5;
        }
    }
    let half = product(&lower, w)?;
    drop(lower);
    let half = product(&transposed(w)?, &half)?;
    let mirrored = transposed(&half)?;
    lower_of_sum(&half, &mirrored)
}

fn product(a: &Csc, b: &Csc) -> Result<Csc, OutOfMemory> {
    sparse_sparse_matmul(a.as_ref(), b.as_ref(), 1.0, Par::Seq).map_err(|_| OutOfMemory)
}

/// The lower triangle of `A + Aᵀ`, `mirrored` being `Aᵀ`.
fn lower_of_sum(a: &Csc, mirrored: &Csc) -> Result<Csc, OutOfMemory> {
    let n = a.ncols();
    // Each entry of A gives one of the lower triangle at the most.
    let most = a.compute_nnz();
    let (mut col_start, mut row, mut values) = (vec![0], Vec::new(), Vec::new());
    row.try_reserve_exact(most).map_err(|_| OutOfMemory)?;
    values.try_reserve_exact(most).map_err(|_| OutOfMemory)?;
    for j in 0..n {
        for (i, one, other) in both(a, mirrored, j, j) {
            row.push(i);
            values.push(one + other);
        }
        col_start.push(row.len());
    }
    Ok(from_columns((n, n), col_start, row, values))
}

/// The rows before `first` and the others, of the columns before `columns`.
pub fn split_rows(a: &Csc, first: usize, columns: usize) -> (Csc, Csc) {
    let part = |from: usize, to: usize| {
        let range = |j: usize| {
            let (begin, rows) = (a.symbolic().col_ptr()[j], column(a, j).0);
            let [from, to] = [from, to].map(|bound| rows.partition_point(|&i| i < bound));
            begin + from..begin + to
        };
        let stored: usize = (0..columns).map(|j| range(j).len()).sum();
        let mut col_start = vec![0];
        let (mut row, mut values) = (Vec::with_capacity(stored), Vec::with_capacity(stored));
        for range in (0..columns).map(range) {
            row.extend(a.symbolic().row_idx()[range.clone()].iter().map(|i| i - from));
            values.extend_from_slice(&a.val()[range]);
            col_start.push(row.len());
        }
        from_columns((to - from, columns), col_start, row, values)
    };
    (part(0, first), part(first, a.nrows()))
}
