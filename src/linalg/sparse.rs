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

use super::pivoted_cholesky::lower_times_transpose;
use super::vector::norm_inf as largest;

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
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A motion of all rows that nothing resists, its largest component 1.
    Motion(Vec<f64>),
    /// The leading part is indefinite, as this row shows.
    Indefinite(usize),
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

/// A pivot below this part of the diagonal raises suspicion: a motion may remain that nothing holds.
/// Whether it does is decided by the motion itself.
const SUSPICIOUS: f64 = 1e-8;

/// A motion is free if its forces are below this part of those of its components alone: rounding.
/// Weak parts that are held have 1e-7, free ones 4e-16.
const FREE: f64 = 10.0 * f64::EPSILON;

/// Added to the diagonal, relative to it, to make a singular matrix tell its free motion.
const REGULARISATION: f64 = 1e-10;

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
        let symbolic = analyse(&matrix, &order, &inverse)?;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| Failure::Memory)?;
        values.resize(symbolic.len_val(), 0.0);
        let singular = factorise(&symbolic, &matrix, &mut values)?.is_some();
        if singular {
            for j in 0..free {
                matrix.values[matrix.starts[j]] *= 1.0 + REGULARISATION;
            }
            if let Some(index) = factorise(&symbolic, &matrix, &mut values)? {
                return Err(Failure::Indefinite(order[index.min(n - 1)]));
            }
        }
        let m = n - free;
        let (tail, (weakest, pivot)) =
            read_tail(supernodes(&symbolic, &values), &matrix, &order, free);
        let mut schur = lower_times_transpose(&tail, m);
        for (i, shift) in shift.iter().enumerate() {
            schur[i + m * i] -= shift;
        }
        let condensation =
            Condensation { factor: Some((symbolic, values)), order, free, tail, schur };
        if singular || pivot < SUSPICIOUS {
            let motion = condensation.weakest_motion(weakest);
            if singular || matrix.resistance(&motion) <= FREE {
                return Err(Failure::Motion(motion));
            }
        }
        Ok(condensation)
    }

    /// The motion that resists least, by two steps of inverse iteration from one row.
    fn weakest_motion(&self, row: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.order.len()];
        x[self.order.iter().position(|&i| i == row).unwrap_or(0)] = 1.0;
        for _ in 0..2 {
            self.half_solve(&mut x, false);
            self.half_solve(&mut x, true);
            let most = largest(&x);
            x.iter_mut().for_each(|x| *x /= most);
        }
        let mut motion = vec![0.0; x.len()];
        for (&i, x) in self.order.iter().zip(&x) {
            motion[i] = *x;
        }
        motion
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

/// Copies `L_dd` out of the factor and finds the row before it with the smallest pivot relative to
/// the diagonal.
fn read_tail(
    factor: SupernodalLltRef<'_, usize, f64>,
    matrix: &Lower,
    order: &[usize],
    free: usize,
) -> (Vec<f64>, (usize, f64)) {
    let m = matrix.size - free;
    let mut tail = vec![0.0; m * m];
    let mut weakest = (0, f64::INFINITY);
    for s in 0..factor.symbolic().n_supernodes() {
        let node = factor.supernode(s);
        let (entries, begin) = (node.val(), node.start());
        let width = entries.ncols();
        for column in 0..width {
            let j = begin + column;
            if j < free {
                let diagonal = matrix.values[matrix.starts[order[j]]];
                let pivot = entries[(column, column)].powi(2) / diagonal;
                if pivot < weakest.1 {
                    weakest = (order[j], pivot);
                }
                continue;
            }
            let rows = (begin..begin + width).chain(node.pattern().iter().copied());
            for (position, i) in rows.enumerate().filter(|&(_, i)| i >= j) {
                tail[i - free + m * (j - free)] = entries[(position, column)];
            }
        }
    }
    (tail, weakest)
}

/// Structure of the factor in the given order.
fn analyse(
    matrix: &Lower,
    order: &[usize],
    inverse: &[usize],
) -> Result<SymbolicCholesky<usize>, Failure> {
    let params = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let permutation = faer::perm::PermRef::new_checked(order, inverse, matrix.size);
    let ordering = SymmetricOrdering::Custom(permutation);
    factorize_symbolic_cholesky(matrix.pattern(), Side::Lower, ordering, params)
        .map_err(|_| Failure::Memory)
}

/// Fills `values`; the place in the order of a pivot that is not positive, if there is one.
fn factorise(
    symbolic: &SymbolicCholesky<usize>,
    matrix: &Lower,
    values: &mut [f64],
) -> Result<Option<usize>, Failure> {
    let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::Memory)?;
    let factorised = symbolic.factorize_numeric_llt(
        values,
        SparseColMatRef::new(matrix.pattern(), &matrix.values),
        Side::Lower,
        LltRegularization::default(),
        Par::Seq,
        MemStack::new(&mut memory),
        Spec::default(),
    );
    Ok(match factorised {
        Ok(_) => None,
        Err(LltError::NonPositivePivot { index }) => Some(index),
    })
}

impl Lower {
    fn pattern(&self) -> SymbolicSparseColMatRef<'_, usize> {
        SymbolicSparseColMatRef::new_checked(self.size, self.size, &self.starts, None, &self.rows)
    }

    /// Largest force of the motion `x`, relative to the largest of its components alone.
    fn resistance(&self, x: &[f64]) -> f64 {
        let (mut force, mut parts) = (vec![0.0; self.size], vec![0.0; self.size]);
        for (j, range) in self.starts.windows(2).enumerate() {
            for k in range[0]..range[1] {
                let (i, value) = (self.rows[k], self.values[k]);
                force[i] += value * x[j];
                parts[i] += (value * x[j]).abs();
                if i != j {
                    force[j] += value * x[i];
                    parts[j] += (value * x[i]).abs();
                }
            }
        }
        largest(&force) / largest(&parts)
    }
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
