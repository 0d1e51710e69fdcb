//! Sparse Cholesky factorisation of `[K_ff K_fd; K_df K_dd]` with the `d` last, by faer on the
//! calling thread.
//!
//! What a factorisation leaves for its last columns is the Schur complement
//! `S = K_dd - K_df K_ff⁻¹ K_fd`, dense. The factorisation goes on through `S + D`, with `D` the
//! diagonal of `K_dd`, so that `S` may be singular: `S = L_dd L_ddᵀ - D`.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::dense::lower_times_transpose;

/// Lower triangle of a symmetric matrix by columns, rows ascending, diagonal entries present.
pub struct Lower {
    /// Number of rows.
    pub size: usize,
    /// Begin of each column, and the number of entries.
    pub starts: Vec<usize>,
    /// Rows.
    pub rows: Vec<usize>,
    /// Entries.
    pub values: Vec<f64>,
}

/// Why a matrix was not factorised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// The leading part is singular or indefinite; this row depends on others.
    Dependent(usize),
    /// Not enough memory.
    Memory,
}

/// The factor, with `S`.
pub struct Condensation {
    /// Structure and entries; nothing if there are no rows.
    factor: Option<(SymbolicCholesky<usize>, Vec<f64>)>,
    order: Vec<usize>,
    free: usize,
    tail: Vec<f64>,
    schur: Vec<f64>,
}

/// Pivots below this part of the diagonal mean that a motion remains that nothing holds.
const SINGULAR: f64 = 1e-12;

impl Condensation {
    /// Factorises; the last `size - free` rows are the `d`.
    pub fn new(mut matrix: Lower, free: usize) -> Result<Self, Failure> {
        let n = matrix.size;
        if n == 0 {
            let (order, tail, schur) = (Vec::new(), Vec::new(), Vec::new());
            return Ok(Condensation { factor: None, order, free, tail, schur });
        }
        let shift: Vec<f64> = (free..n).map(|j| matrix.values[matrix.starts[j]]).collect();
        for (j, shift) in (free..n).zip(&shift) {
            matrix.values[matrix.starts[j]] += shift;
        }
        let (order, inverse) = ordering(&matrix, free)?;
        let pattern =
            SymbolicSparseColMatRef::new_checked(n, n, &matrix.starts, None, &matrix.rows);
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let permutation = faer::perm::PermRef::new_checked(&order, &inverse, n);
        let symbolic = factorize_symbolic_cholesky(
            pattern,
            Side::Lower,
            SymmetricOrdering::Custom(permutation),
            params,
        )
        .map_err(|_| Failure::Memory)?;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| Failure::Memory)?;
        values.resize(symbolic.len_val(), 0.0);
        let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::Memory)?;
        let factorised = symbolic.factorize_numeric_llt(
            &mut values,
            SparseColMatRef::new(pattern, &matrix.values),
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Spec::default(),
        );
        if let Err(LltError::NonPositivePivot { index }) = factorised {
            return Err(Failure::Dependent(order[index.min(n - 1)]));
        }
        let m = n - free;
        let tail = read_tail(supernodes(&symbolic, &values), &matrix, &order, free)?;
        let mut schur = lower_times_transpose(&tail, m);
        for (i, shift) in shift.iter().enumerate() {
            schur[i + m * i] -= shift;
        }
        Ok(Condensation { factor: Some((symbolic, values)), order, free, tail, schur })
    }

    /// `S`, column-major.
    pub fn schur(&self) -> &[f64] {
        &self.schur
    }

    /// Condenses loads: `f_d - K_df K_ff⁻¹ f_f`, and what [`Self::recover`] needs of `f_f`.
    pub fn condense(&self, load: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut x: Vec<f64> = self.order.iter().map(|&i| load[i]).collect();
        self.half_solve(&mut x, false);
        let m = load.len() - self.free;
        let condensed = (0..m)
            .map(|i| (0..=i).map(|j| self.tail[i + m * j] * x[self.free + j]).sum())
            .collect();
        (condensed, x)
    }

    /// All displacements from those of the `d` and the half-solved loads.
    pub fn recover(&self, half_solved: &[f64], d: &[f64]) -> Vec<f64> {
        let m = d.len();
        let mut x = half_solved.to_vec();
        for (i, x) in x[self.free..].iter_mut().enumerate() {
            *x = (i..m).map(|j| self.tail[j + m * i] * d[j]).sum();
        }
        self.half_solve(&mut x, true);
        let mut u = vec![0.0; x.len()];
        for (&i, x) in self.order.iter().zip(&x) {
            u[i] = *x;
        }
        u[self.free..].copy_from_slice(d);
        u
    }

    /// Solves with `L`, or with its transpose.
    fn half_solve(&self, x: &mut [f64], transposed: bool) {
        let Some((symbolic, values)) = &self.factor else { return };
        let factor = supernodes(symbolic, values);
        let scratch = factor.symbolic().solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::new(scratch);
        let stack = MemStack::new(&mut memory);
        let n = x.len();
        let x = MatMut::from_column_major_slice_mut(x, n, 1);
        if transposed {
            factor.l_transpose_solve_with_conj(Conj::No, x, Par::Seq, stack);
        } else {
            factor.l_solve_with_conj(Conj::No, x, Par::Seq, stack);
        }
    }
}

fn supernodes<'a>(
    symbolic: &'a SymbolicCholesky<usize>,
    values: &'a [f64],
) -> SupernodalLltRef<'a, usize, f64> {
    match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(symbolic) => SupernodalLltRef::new(symbolic, values),
        SymbolicCholeskyRaw::Simplicial(_) => unreachable!("supernodes were asked for"),
    }
}

/// Copies `L_dd` out of the factor and looks at the pivots before it.
fn read_tail(
    factor: SupernodalLltRef<'_, usize, f64>,
    matrix: &Lower,
    order: &[usize],
    free: usize,
) -> Result<Vec<f64>, Failure> {
    let m = matrix.size - free;
    let mut tail = vec![0.0; m * m];
    for s in 0..factor.symbolic().n_supernodes() {
        let node = factor.supernode(s);
        let (entries, begin) = (node.val(), node.start());
        let width = entries.ncols();
        for column in 0..width {
            let j = begin + column;
            if j < free {
                let diagonal = matrix.values[matrix.starts[order[j]]];
                if entries[(column, column)].powi(2) <= SINGULAR * diagonal {
                    return Err(Failure::Dependent(order[j]));
                }
                continue;
            }
            let rows = (begin..begin + width).chain(node.pattern().iter().copied());
            for (position, i) in rows.enumerate().filter(|&(_, i)| i >= j) {
                tail[i - free + m * (j - free)] = entries[(position, column)];
            }
        }
    }
    Ok(tail)
}

/// Approximate minimum degree on the leading part, the others after it in their order.
fn ordering(matrix: &Lower, free: usize) -> Result<(Vec<usize>, Vec<usize>), Failure> {
    let mut starts = vec![0];
    let mut rows = Vec::new();
    for j in 0..free {
        let column = &matrix.rows[matrix.starts[j]..matrix.starts[j + 1]];
        rows.extend(column.iter().copied().filter(|&i| i < free));
        starts.push(rows.len());
    }
    let (mut order, mut inverse) = (vec![0; free], vec![0; free]);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(free, rows.len());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::Memory)?;
    amd::order_maybe_unsorted(
        &mut order,
        &mut inverse,
        SymbolicSparseColMatRef::new_checked(free, free, &starts, None, &rows),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| Failure::Memory)?;
    order.extend(free..matrix.size);
    inverse.extend(free..matrix.size);
    Ok((order, inverse))
}
