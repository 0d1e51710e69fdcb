//! The transformed matrix `Tᵀ K T` as it is: no condensed matrix is formed.
//!
//! A solution with components of `d` held is one with the matrix whose rows and columns of these components are
//! replaced by those of a diagonal matrix. The pattern stays, so that it is analysed once. With all of them held
//! the matrix is definite if a condensed one exists at all.

use std::mem::take;
use std::sync::{Mutex, PoisonError};

use super::control::Asked;
use crate::error::Error;
use crate::linalg::last_case::LastCase;
use crate::linalg::sparse_matrix::{
    Csc, diagonals, symmetric_magnitude, symmetric_residual, symmetric_times, value_at,
};
use crate::linalg::sparse_schur::{Failure, Plan, Values};
use crate::linalg::vector::opposite;
use crate::problem::{GoesOn, HeldSet, SOLUTIONS, Solved, StiffnessOperator};
use crate::reduce::probes::refuse;

/// Where bodies move freely with the components that are held, springs of this part of their units hold them in
/// the factor, the first with which it exists. Solutions are approximate then.
const SPRINGS: [f64; 4] = [1e-8, 1e-5, 1e-2, 1.0];

/// The matrix with its analysis.
pub(super) struct FullSpace {
    /// Its lower triangle.
    matrix: Csc,
    inner: usize,
    dim: usize,
    units: Vec<f64>,
    cholesky: Plan,
    /// Bytes of a factor, a second matrix with components held, and some vectors of all unknowns.
    pub(super) factor_bytes: u64,
    /// The factor that was made last, for whom needs the same one next, or its memory.
    kept: Mutex<Factor>,
    /// The loads and all unknowns of the last load case, for its recovery.
    last: LastCase,
}

/// A factor, and what is held in it; `None`: there is no more than its memory.
#[derive(Default)]
struct Factor {
    held_set: Option<HeldSet>,
    values: Values,
}

impl FullSpace {
    /// Takes the lower triangle of the matrix, whose first `inner` unknowns are no relative displacements; pairs have
    /// `dim` components, and a load case takes `case` bytes beside the factor.
    pub(super) fn new(
        matrix: Csc,
        inner: usize,
        dim: usize,
        case: u64,
        asked: &mut Asked<'_, '_>,
    ) -> Result<Self, Failure> {
        let cholesky = Plan::new(&matrix, matrix.ncols(), None, &mut |share| asked.goes_on(share))?;
        let entry = size_of::<usize>() + size_of::<f64>();
        let copy = entry * matrix.compute_nnz() + VECTORS * size_of::<f64>() * matrix.ncols();
        let factor_bytes = cholesky.bytes + copy as u64;
        asked.needs(factor_bytes.saturating_add(case))?;
        let units: Vec<f64> = diagonals(&matrix).collect();
        let held_set = HeldSet::all(dim, (matrix.ncols() - inner) / dim);
        let (kept, last) = (Mutex::default(), LastCase::default());
        let mut space = FullSpace { matrix, inner, dim, units, cholesky, factor_bytes, kept, last };
        let values = space
            .cholesky
            .definite(space.restricted(&held_set, 0.0), &mut |share| asked.goes_on(share))?;
        let largest = space.units.iter().fold(0.0_f64, |most, unit| most.max(*unit));
        for unit in &mut space.units {
            *unit = if *unit > 0.0 { *unit } else { largest };
        }
        space.kept = Mutex::new(Factor { held_set: Some(held_set), values });
        Ok(space)
    }

    /// The matrix with rows and columns of held components replaced, and with springs: those of the held set,
    /// and others of `soft` units on components of `d` that are free.
    fn restricted(&self, held_set: &HeldSet, soft: f64) -> Csc {
        let (inner, dim) = (self.inner, self.dim);
        let mut matrix = self.matrix.clone();
        let held = |i: usize| i >= inner && held_set.held[i - inner];
        for j in 0..matrix.ncols() {
            let range = matrix.symbolic().col_range(j);
            for place in range {
                let i = matrix.symbolic().row_idx()[place];
                let value = &mut matrix.val_mut()[place];
                if i == j && held(i) {
                    // A component that nothing resists is held too.
                    *value = if *value > 0.0 { *value } else { 1.0 };
                } else if held(i) || held(j) {
                    *value = 0.0;
                } else if j >= inner {
                    let (pair, column) = ((j - inner) / dim, (j - inner) % dim);
                    let row = i - (inner + dim * pair);
                    if row < dim && row > 0 && column > 0 {
                        *value += held_set.springs[pair][row - 1][column - 1];
                    }
                    if i == j {
                        *value += soft * self.units[i];
                    }
                }
            }
        }
        matrix
    }

    /// A new user of the matrix.
    pub(super) fn in_use(&self) -> InUse<'_> {
        let factor = take(&mut *self.kept.lock().unwrap_or_else(PoisonError::into_inner));
        InUse { space: self, factor }
    }

    /// `c - B A⁻¹ a` for each of the loads `(a, c)`, one behind the other: minus the forces on the components of
    /// `d`, all held; `None` where `goes_on` says no.
    pub(super) fn condense(&self, loads: &[f64], goes_on: GoesOn<'_>) -> Solved {
        let mut user = self.in_use();
        if !user.hold_all(goes_on)? {
            return Ok(None);
        }
        let Some(x) = user.solve(None, loads, goes_on)? else { return Ok(None) };
        let residuals = self.residuals(&x, loads);
        let own = residuals.chunks_exact(self.matrix.ncols().max(1));
        Ok(Some(own.flat_map(|residual| opposite(&residual[self.inner..])).collect()))
    }

    /// `A x - b` of each of the loads, one behind the other.
    fn residuals(&self, x: &[f64], loads: &[f64]) -> Vec<f64> {
        let size = self.matrix.ncols().max(1);
        let each = x.chunks_exact(size).zip(loads.chunks_exact(size));
        each.flat_map(|(x, load)| symmetric_residual(&self.matrix, (x, &[]), load)).collect()
    }

    /// All unknowns of loads where those of the pairs are `d`. Of several load cases, each argument has its
    /// vectors one behind the other, and so has the result.
    pub(super) fn recover(&self, loads: &[f64], d: &[f64]) -> Result<Vec<f64>, Error> {
        if let Some(x) = self.last.of(loads, |x| &x[self.inner..] == d) {
            return Ok(x);
        }
        let mut user = self.in_use();
        if !user.hold_all(&mut || true)? {
            let wrong =
                "the bodies cannot be told from bodies that fall apart where the pairs are held";
            return refuse(wrong.into());
        }
        let size = self.matrix.ncols().max(1);
        let mut x = vec![0.0; loads.len()];
        let held = d.chunks_exact((self.matrix.ncols() - self.inner).max(1));
        for (x, d) in x.chunks_exact_mut(size).zip(held) {
            x[self.inner..].copy_from_slice(d);
        }
        // A second step: the digits that the rounding of the first one has cost.
        for _ in 0..SOLUTIONS {
            let residuals = self.residuals(&x, loads);
            let steps = user.solve(None, &residuals, &mut || true)?.unwrap_or_default();
            for (x, step) in x.chunks_exact_mut(size).zip(steps.chunks_exact(size)) {
                x.iter_mut().zip(step).take(self.inner).for_each(|(x, step)| *x -= step);
            }
        }
        Ok(x)
    }
}

/// Vectors of all unknowns that a solution holds at a time, beside directions of GMRES.
const VECTORS: usize = 16;

/// A user of the matrix with a factor of its own.
pub(super) struct InUse<'a> {
    space: &'a FullSpace,
    factor: Factor,
}

impl InUse<'_> {
    fn hold_all(&mut self, goes_on: GoesOn<'_>) -> Result<bool, Error> {
        let pairs = (self.space.matrix.ncols() - self.space.inner) / self.space.dim;
        self.hold(&HeldSet::all(self.space.dim, pairs), goes_on)
    }
}

impl Drop for InUse<'_> {
    fn drop(&mut self) {
        let mut kept = self.space.kept.lock().unwrap_or_else(PoisonError::into_inner);
        *kept = take(&mut self.factor);
    }
}

impl StiffnessOperator for InUse<'_> {
    fn inner(&self) -> usize {
        self.space.inner
    }

    fn units(&self) -> &[f64] {
        &self.space.units
    }

    fn coupling(&self, i: usize, j: usize) -> f64 {
        value_at(&self.space.matrix, self.space.inner + i.max(j), self.space.inner + i.min(j))
    }

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        Ok(symmetric_times(&self.space.matrix, x))
    }

    fn residual(&self, x: &[f64], low: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
        Ok(symmetric_residual(&self.space.matrix, (x, low), load))
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        symmetric_magnitude(&self.space.matrix, size)
    }

    fn is_sparse(&self) -> bool {
        true
    }

    fn remember(&mut self, load: &[f64], x: &[f64]) {
        self.space.last.keep(load, x);
    }

    fn held_set(&self) -> Option<&HeldSet> {
        self.factor.held_set.as_ref()
    }

    fn hold(&mut self, held_set: &HeldSet, goes_on: GoesOn<'_>) -> Result<bool, Error> {
        if self.factor.held_set.as_ref() == Some(held_set) {
            return Ok(true);
        }
        self.factor.held_set = None;
        for soft in std::iter::once(0.0).chain(SPRINGS) {
            if !goes_on() {
                return Ok(false);
            }
            let matrix = self.space.restricted(held_set, soft);
            let asked = &mut |_| if goes_on() { Ok(()) } else { Err(Failure::Stopped) };
            let values = &mut self.factor.values;
            match self.space.cholesky.factor(&matrix, values, asked) {
                Ok(true) => {
                    self.factor.held_set = Some(held_set.clone());
                    return Ok(true);
                }
                Ok(false) => {}
                Err(Failure::Stopped) => return Ok(false),
                Err(_) => return Err(Error::OutOfMemory("the factor of the stiffness matrix")),
            }
        }
        Ok(false)
    }

    /// Its own factor tells what is held.
    fn solve(&mut self, _: Option<&HeldSet>, forces: &[f64], goes_on: GoesOn<'_>) -> Solved {
        let Factor { held_set: Some(held_set), values } = &self.factor else {
            unreachable!("something is held before")
        };
        let mut right = forces.to_vec();
        // A vector, or several one behind the other.
        let each = right.chunks_exact_mut(self.space.matrix.ncols().max(1));
        each.for_each(|right| held_set.clear(right));
        Ok(self.space.cholesky.solve(values, &right, goes_on))
    }
}
