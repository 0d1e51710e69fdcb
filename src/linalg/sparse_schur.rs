//! Sparse Cholesky factorisation of `[A Bᵀ; B C]` with the Schur complement `S = C - B A⁻¹ Bᵀ`, by
//! faer on the calling thread.
//!
//! What a factorisation leaves for its last columns is `S`, dense. The factorisation goes on through
//! `S + D`, with `D` the diagonal of `C`, so that `S` may be singular: `S = L_s L_sᵀ - D`, where `L_s`
//! is the last block of the factor.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::free_motions::{self, Doubt, is_suspicious};
use super::null_vector::{resistance, weakest};
use super::pivoted_cholesky::lower_times_transpose;
use super::sparse_matrix::{Csc, diagonal, leading_part};
use super::tolerances::{NULL_VECTOR, REGULARISATION, SUSPICIOUS_PIVOT};
use super::unreduced::Unreduced;
use super::workspaces::Workspaces;

/// So many rows of `C` are few beside the rigid motions of a body, which are up to six: pivots tell which of
/// them depend on the others, at no cost. Of more rows small diagonal entries alone are looked at.
const FEW: usize = 24;

/// Why a matrix was not factorised.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// A null vector of the matrix with `C + D` in the place of `C`, its largest entry 1.
    NullVector(Vec<f64>),
    /// The matrix is not positive semi-definite, as this row shows.
    Indefinite(usize),
    /// The energy of this motion is negative, so that the matrix is not positive semi-definite.
    Negative(Vec<f64>),
    /// Whether the matrix resists this motion cannot be told from rounding.
    Unclear(Vec<f64>),
    /// Not enough memory.
    OutOfMemory,
}

/// The factor and the Schur complement.
pub struct SparseSchur {
    /// `None` if there are no rows.
    factor: Option<Factor>,
    /// Rows in the order of the factor: those of `A` permuted, then those of `C`.
    order: Vec<usize>,
    /// Number of rows of `A`.
    eliminated: usize,
    /// `L_s`, column-major.
    tail: Vec<f64>,
    /// `S`, column-major.
    schur: Vec<f64>,
}

impl SparseSchur {
    /// Factorises the symmetric matrix whose lower triangle is `lower`, every diagonal entry stored.
    /// The first `eliminated` rows are those of `A`.
    pub fn new(lower: Csc, eliminated: usize) -> Result<Self, Failure> {
        Self::with_look(lower, eliminated, false)
    }

    /// As [`Self::new`]; free motions are looked for however many rows `C` has, and whatever its diagonal says.
    pub fn exact_on_free_motions(lower: Csc, eliminated: usize) -> Result<Self, Failure> {
        Self::with_look(lower, eliminated, true)
    }

    fn with_look(mut lower: Csc, eliminated: usize, always: bool) -> Result<Self, Failure> {
        let n = lower.ncols();
        if n == 0 {
            let (order, tail, schur) = (Vec::new(), Vec::new(), Vec::new());
            return Ok(SparseSchur { factor: None, order, eliminated, tail, schur });
        }
        let shift: Vec<f64> = (eliminated..n).map(|j| scale_diagonal(&mut lower, j, 2.0)).collect();
        let (order, inverse) = ordering(&lower, eliminated)?;
        let mut factor = Factor::analysed(&lower, PermRef::new_checked(&order, &inverse, n))?;
        let singular = factor.fill(&lower)?.is_some();
        if singular {
            (0..eliminated).for_each(|j| {
                scale_diagonal(&mut lower, j, 1.0 + REGULARISATION);
            });
            if let Some(place) = factor.fill(&lower)? {
                return Err(Failure::Indefinite(order[place.min(n - 1)]));
            }
        }
        let (tail, weakest_pivot) = factor.tail(&lower, &order, eliminated);
        let m = n - eliminated;
        let mut schur = lower_times_transpose(&tail, m);
        for (i, shift) in shift.iter().enumerate() {
            schur[i + m * i] -= shift;
        }
        if let Some((place, pivot)) = weakest_pivot
            && (singular || pivot < SUSPICIOUS_PIVOT)
        {
            let ordered = weakest(n, place, |x| {
                factor.half_solve(x, Half::Forward);
                factor.half_solve(x, Half::Backward);
            });
            let vector = unpermuted(&order, &ordered);
            let is_null = || resistance(&lower, &vector) <= NULL_VECTOR;
            if singular || is_null() {
                return Err(Failure::NullVector(vector));
            }
        }
        let mut found = SparseSchur { factor: Some(factor), order, eliminated, tail, schur };
        if always || m <= FEW || is_suspicious(&shift, |i| found.schur[i + m * i]) {
            for (j, shift) in (eliminated..n).zip(&shift) {
                set_diagonal(&mut lower, j, *shift);
            }
            found.settle(lower, &shift)?;
        }
        Ok(found)
    }

    /// Makes `S` exact on the motions that nothing resists; `lower` is the whole matrix, and `units` is the
    /// diagonal of `C`.
    fn settle(&mut self, lower: Csc, units: &[f64]) -> Result<(), Doubt> {
        let mut schur = std::mem::take(&mut self.schur);
        let recover = |load: &[f64], d: &[f64]| self.recover(load, d);
        free_motions::settle(&mut schur, units, &Unreduced::new(lower, &recover))?;
        self.schur = schur;
        Ok(())
    }

    /// `S`, column-major.
    pub fn schur(&self) -> &[f64] {
        &self.schur
    }

    /// The right side `(a, c)` after elimination of the first rows: `c - B A⁻¹ a`.
    pub fn condense(&self, rhs: &[f64]) -> Vec<f64> {
        let half = self.forward(rhs);
        let (m, kept) = (rhs.len() - self.eliminated, &half[self.eliminated..]);
        (0..m).map(|i| (0..=i).map(|j| self.tail[i + m * j] * kept[j]).sum()).collect()
    }

    /// The solution of the first rows, `A⁻¹ (a - Bᵀ d)`, followed by `d`; `rhs` is `(a, c)`, of which
    /// `c` does not matter.
    pub fn recover(&self, rhs: &[f64], d: &[f64]) -> Vec<f64> {
        let m = d.len();
        let mut x = self.forward(rhs);
        for (i, x) in x[self.eliminated..].iter_mut().enumerate() {
            *x = (i..m).map(|j| self.tail[j + m * i] * d[j]).sum();
        }
        self.half_solve(&mut x, Half::Backward);
        let mut solution = unpermuted(&self.order, &x);
        solution[self.eliminated..].copy_from_slice(d);
        solution
    }

    /// `L⁻¹` of the right side, in the order of the factor.
    fn forward(&self, rhs: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = self.order.iter().map(|&i| rhs[i]).collect();
        self.half_solve(&mut x, Half::Forward);
        x
    }

    fn half_solve(&self, x: &mut [f64], half: Half) {
        if let Some(factor) = &self.factor {
            factor.half_solve(x, half);
        }
    }
}

impl From<Doubt> for Failure {
    fn from(doubt: Doubt) -> Self {
        match doubt {
            Doubt::Indefinite(motion) => Failure::Negative(motion),
            Doubt::Unclear(motion) => Failure::Unclear(motion),
        }
    }
}

/// Multiplies the diagonal entry of column `j` and returns what it was.
fn scale_diagonal(lower: &mut Csc, j: usize, factor: f64) -> f64 {
    let before = diagonal(lower, j).unwrap_or_default();
    set_diagonal(lower, j, factor * before);
    before
}

/// Sets the diagonal entry of column `j`, which is stored.
fn set_diagonal(lower: &mut Csc, j: usize, value: f64) {
    let place = lower.symbolic().col_ptr()[j];
    lower.val_mut()[place] = value;
}

fn unpermuted(order: &[usize], ordered: &[f64]) -> Vec<f64> {
    let mut vector = vec![0.0; ordered.len()];
    for (&i, x) in order.iter().zip(ordered) {
        vector[i] = *x;
    }
    vector
}

/// Which triangular system of `L Lᵀ`.
#[derive(Clone, Copy, PartialEq)]
enum Half {
    /// `L x = b`.
    Forward,
    /// `Lᵀ x = b`.
    Backward,
}

/// Supernodal Cholesky factor `L`.
struct Factor {
    symbolic: SymbolicCholesky<usize>,
    values: Vec<f64>,
    workspaces: Workspaces,
}

impl Factor {
    /// Structure of the factor in the given order; values are zero.
    fn analysed(lower: &Csc, order: PermRef<'_, usize>) -> Result<Self, Failure> {
        let params = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let ordering = SymmetricOrdering::Custom(order);
        let symbolic = factorize_symbolic_cholesky(lower.symbolic(), Side::Lower, ordering, params)
            .map_err(|_| Failure::OutOfMemory)?;
        let mut values = Vec::new();
        values.try_reserve_exact(symbolic.len_val()).map_err(|_| Failure::OutOfMemory)?;
        values.resize(symbolic.len_val(), 0.0);
        let size = match symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => raw.solve_in_place_scratch::<f64>(1, Par::Seq),
            SymbolicCholeskyRaw::Simplicial(_) => unreachable!("supernodes were asked for"),
        };
        Ok(Factor { symbolic, values, workspaces: Workspaces::new(size) })
    }

    /// Computes the values. Returns the place in the order of a pivot that is not positive, if any.
    fn fill(&mut self, lower: &Csc) -> Result<Option<usize>, Failure> {
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::OutOfMemory)?;
        let factorised = self.symbolic.factorize_numeric_llt(
            &mut self.values,
            lower.as_ref(),
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

    fn supernodes(&self) -> SupernodalLltRef<'_, usize, f64> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(raw) => SupernodalLltRef::new(raw, &self.values),
            SymbolicCholeskyRaw::Simplicial(_) => unreachable!("supernodes were asked for"),
        }
    }

    fn half_solve(&self, x: &mut [f64], half: Half) {
        let n = x.len();
        let x = MatMut::from_column_major_slice_mut(x, n, 1);
        self.workspaces.lend(|stack| match half {
            Half::Forward => {
                self.supernodes().l_solve_with_conj(Conj::No, x, Par::Seq, stack);
            }
            Half::Backward => {
                self.supernodes().l_transpose_solve_with_conj(Conj::No, x, Par::Seq, stack);
            }
        });
    }

    /// Copies `L_s`. Returns with it the pivot of the earlier rows that is smallest relative to the
    /// diagonal: its place in the order, and this ratio.
    fn tail(
        &self,
        lower: &Csc,
        order: &[usize],
        eliminated: usize,
    ) -> (Vec<f64>, Option<(usize, f64)>) {
        let m = order.len() - eliminated;
        let mut tail = vec![0.0; m * m];
        let mut weakest: Option<(usize, f64)> = None;
        let factor = self.supernodes();
        for s in 0..factor.symbolic().n_supernodes() {
            let node = factor.supernode(s);
            let (entries, begin) = (node.val(), node.start());
            let width = entries.ncols();
            for column in 0..width {
                let j = begin + column;
                if j < eliminated {
                    let diagonal = diagonal(lower, order[j]).unwrap_or_default();
                    let pivot = entries[(column, column)].powi(2) / diagonal;
                    if weakest.is_none_or(|(_, least)| pivot < least) {
                        weakest = Some((j, pivot));
                    }
                    continue;
                }
                let rows = (begin..begin + width).chain(node.pattern().iter().copied());
                for (position, i) in rows.enumerate().filter(|&(_, i)| i >= j) {
                    tail[i - eliminated + m * (j - eliminated)] = entries[(position, column)];
                }
            }
        }
        (tail, weakest)
    }
}

/// Approximate minimum degree on the first rows, the others after them as they are; with its inverse.
fn ordering(lower: &Csc, eliminated: usize) -> Result<(Vec<usize>, Vec<usize>), Failure> {
    let leading = leading_part(lower, eliminated).map_err(|_| Failure::OutOfMemory)?;
    let (mut order, mut inverse) = (vec![0; eliminated], vec![0; eliminated]);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(eliminated, leading.compute_nnz());
    let mut memory = MemBuffer::try_new(scratch).map_err(|_| Failure::OutOfMemory)?;
    amd::order_maybe_unsorted(
        &mut order,
        &mut inverse,
        leading.symbolic(),
        amd::Control::default(),
        MemStack::new(&mut memory),
    )
    .map_err(|_| Failure::OutOfMemory)?;
    order.extend(eliminated..lower.ncols());
    inverse.extend(eliminated..lower.ncols());
    Ok((order, inverse))
}
