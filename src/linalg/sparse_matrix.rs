//! Sparse matrices in compressed columns, rows ascending, by faer on the calling thread.

use faer::sparse::linalg::matmul::{SparseDenseMatMul, sparse_dense_matmul, sparse_sparse_matmul};
use faer::sparse::{SparseColMat, SymbolicSparseColMat, Triplet};
use faer::{Accum, MatMut, MatRef, Par};

use super::double_double::{two_product, two_sum};
use super::simd::vectorised;
use super::tolerances::ROUNDING;
use super::vector::opposite;

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

/// The entries of a column: row, value.
#[inline(always)]
pub fn entries_of(a: &Csc, j: usize) -> impl Iterator<Item = (usize, f64)> {
    let (rows, values) = column(a, j);
    rows.iter().copied().zip(values.iter().copied())
}

/// All entries, column by column: row, column, value.
pub fn entries(a: &Csc) -> impl Iterator<Item = (usize, usize, f64)> {
    (0..a.ncols()).flat_map(|j| entries_of(a, j).map(move |(i, value)| (i, j, value)))
}

/// An entry; 0 if it is not stored.
pub fn value_at(a: &Csc, i: usize, j: usize) -> f64 {
    a.get(i, j).copied().unwrap_or_default()
}

/// The diagonal entry of column `j` of a lower triangle, if it is stored.
pub fn diagonal(lower: &Csc, j: usize) -> Option<f64> {
    entries_of(lower, j).next().filter(|(i, _)| *i == j).map(|(_, value)| value)
}

/// Multiplies the diagonal entry of column `j` of a lower triangle, if it is stored.
pub fn scale_diagonal(lower: &mut Csc, j: usize, factor: f64) {
    if diagonal(lower, j).is_some() {
        let place = lower.symbolic().col_ptr()[j];
        lower.val_mut()[place] *= factor;
    }
}

/// The diagonal of a lower triangle, 0 where it is not stored.
pub fn diagonals(lower: &Csc) -> impl Iterator<Item = f64> {
    (0..lower.ncols()).map(|j| diagonal(lower, j).unwrap_or_default())
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
        (&rows[skipped..], &values[skipped..])
    };
    let ((a_rows, a_values), (b_rows, b_values)) = (tail(a), tail(b));
    let (mut p, mut q) = (0, 0);
    std::iter::from_fn(move || {
        let (one, other) = (a_rows.get(p).copied(), b_rows.get(q).copied());
        let i = one.into_iter().chain(other).min()?;
        let mut values = (0.0, 0.0);
        if one == Some(i) {
            values.0 = a_values[p];
            p += 1;
        }
        if other == Some(i) {
            values.1 = b_values[q];
            q += 1;
        }
        Some((i, values.0, values.1))
    })
}

/// `Aᵀ`.
pub fn transposed(a: &Csc) -> Result<Csc, OutOfMemory> {
    a.transpose().to_col_major().map_err(|_| OutOfMemory)
}

/// `A x`.
pub fn times(a: &Csc, x: &[f64]) -> Vec<f64> {
    image(a.as_ref(), a.nrows(), x)
}

/// `Aᵀ x`.
pub fn transpose_times(a: &Csc, x: &[f64]) -> Vec<f64> {
    image(a.transpose(), a.ncols(), x)
}

fn image(a: impl SparseDenseMatMul<f64>, rows: usize, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; rows];
    let target = as_column_mut(&mut y);
    sparse_dense_matmul(target, Accum::Replace, a, as_column(x), 1.0, Par::Seq);
    y
}

/// Visits each entry of the symmetric matrix whose lower triangle is `lower`: row, column, value.
#[inline(always)]
pub fn each_of_symmetric(lower: &Csc, mut visit: impl FnMut(usize, usize, f64)) {
    for j in 0..lower.ncols() {
        for (i, value) in entries_of(lower, j) {
            visit(i, j, value);
            if i != j {
                visit(j, i, value);
            }
        }
    }
}

/// Both triangles of the symmetric matrix whose lower triangle is `lower`.
pub fn whole(lower: &Csc) -> Result<Csc, OutOfMemory> {
    let upper = transposed(lower)?;
    let mut all = Columns::with_capacity(lower.compute_nnz() + upper.compute_nnz())?;
    for j in 0..lower.ncols() {
        let above = entries_of(&upper, j).filter(|(i, _)| *i < j);
        for (i, value) in above.chain(entries_of(lower, j)) {
            all.row.push(i);
            all.values.push(value);
        }
        all.end_column();
    }
    Ok(all.matrix(lower.nrows()))
}

/// `A x` of the symmetric matrix whose lower triangle is `lower`.
pub fn symmetric_times(lower: &Csc, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    each_of_symmetric(lower, |i, j, value| y[i] += value * x[j]);
    y
}

/// `|A| x` of the symmetric matrix whose lower triangle is `lower`.
pub fn symmetric_magnitude(lower: &Csc, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    each_of_symmetric(lower, |i, j, value| y[i] += value.abs() * x[j]);
    y
}

/// `A (x + low) - b` of the symmetric matrix whose lower triangle is `lower`, in twice the precision and rounded
/// once. `low` has the first entries, or all.
pub fn symmetric_residual(lower: &Csc, (x, low): (&[f64], &[f64]), b: &[f64]) -> Vec<f64> {
    let (mut sum, mut rest) = (opposite(b), vec![0.0; b.len()]);
    let low_of = |j: usize| low.get(j).copied().unwrap_or(0.0);
    vectorised(
        #[inline(always)]
        || {
            each_of_symmetric(
                lower,
                #[inline(always)]
                |i, j, value| {
                    let (product, error) = two_product(value, x[j]);
                    let (high, lost) = two_sum(sum[i], product);
                    sum[i] = high;
                    rest[i] += (error + lost) + value * low_of(j);
                },
            );
        },
    );
    sum.iter().zip(&rest).map(|(sum, rest)| sum + rest).collect()
}

/// A vector as a matrix.
pub fn as_column(x: &[f64]) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(x, x.len(), 1)
}

/// A vector as a matrix that may be written to.
pub fn as_column_mut(x: &mut [f64]) -> MatMut<'_, f64> {
    let length = x.len();
    MatMut::from_column_major_slice_mut(x, length, 1)
}

/// `A B`.
pub fn product(a: &Csc, b: &Csc) -> Result<Csc, OutOfMemory> {
    sparse_sparse_matmul(a.as_ref(), b.as_ref(), 1.0, Par::Seq).map_err(|_| OutOfMemory)
}

/// `A B`. A sum of which only rounding is left is zero, and stays stored.
pub fn product_without_rounding(a: &Csc, b: &Csc) -> Result<Csc, OutOfMemory> {
    let mut found = product(a, b)?;
    let sizes = product(&absolute(a), &absolute(b))?;
    for (value, size) in found.val_mut().iter_mut().zip(sizes.val()) {
        if value.abs() <= ROUNDING * size {
            *value = 0.0;
        }
    }
    Ok(found)
}

/// `|A|`, entry by entry.
pub fn absolute(a: &Csc) -> Csc {
    let mut sizes = a.clone();
    sizes.val_mut().iter_mut().for_each(|value| *value = value.abs());
    sizes
}

/// A matrix that is made column by column.
pub struct Columns {
    col_start: Vec<usize>,
    /// Rows of the entries so far.
    pub row: Vec<usize>,
    /// The entries so far.
    pub values: Vec<f64>,
}

impl Default for Columns {
    fn default() -> Self {
        Columns { col_start: vec![0], row: Vec::new(), values: Vec::new() }
    }
}

impl Columns {
    /// Room for entries.
    pub fn with_capacity(entries: usize) -> Result<Self, OutOfMemory> {
        let mut columns = Columns::default();
        columns.row.try_reserve_exact(entries).map_err(|_| OutOfMemory)?;
        columns.values.try_reserve_exact(entries).map_err(|_| OutOfMemory)?;
        Ok(columns)
    }

    /// The next entries are of the next column.
    pub fn end_column(&mut self) {
        self.col_start.push(self.row.len());
    }

    /// The matrix of the columns so far.
    pub fn matrix(self, rows: usize) -> Csc {
        from_columns((rows, self.col_start.len() - 1), self.col_start, self.row, self.values)
    }
}
