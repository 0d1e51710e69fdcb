//! The factor of the eliminated rows, and the Schur complement of the others.

use std::sync::Mutex;

use super::diagnosis::diagnosed;
use super::factor_progress::FactorProgress;
use super::failure::Failure;
use super::numeric::Numeric;
use super::plan::Plan;
use super::solve;
use super::structure::Structure;
use crate::linalg::free_motions::{self, StiffnessDefect, is_suspicious};
use crate::linalg::sparse_matrix::{Csc, diagonal};
use crate::linalg::unreduced::Unreduced;
use crate::shortage;
use crate::workers::Workers;

/// So many rows of `C` are few beside the rigid motions of a body, which are up to six: pivots tell which of
/// them depend on the others, at no cost. Of more rows small diagonal entries alone are looked at.
const FEW: usize = 24;

/// When free motions are looked for.
#[derive(Clone, Copy, PartialEq)]
pub enum RigidModeCheck {
    /// However many rows `C` has, and whatever its diagonal says.
    Always,
    /// If `C` has few rows, or small diagonal entries.
    IfSuspicious,
}

/// The factor and the Schur complement.
pub struct SparseSchur {
    structure: Structure,
    /// The factor.
    values: Vec<f64>,
    /// `S`, column-major.
    schur: Vec<f64>,
    /// The last right side that was condensed by itself, and the result of its elimination: its recovery needs both
    /// again.
    last: Mutex<Option<[Vec<f64>; 2]>>,
}

impl SparseSchur {
    /// Factorises the symmetric matrix whose lower triangle is `lower`, every diagonal entry stored.
    /// The first `eliminated` rows are those of `A`; `rank`, if given, orders them. `progress` is told the
    /// memory before it is taken.
    pub fn new(
        lower: Csc,
        eliminated: usize,
        rank: Option<&[usize]>,
        check: RigidModeCheck,
        workers: &dyn Workers,
        progress: &mut dyn FactorProgress,
    ) -> Result<Self, Failure> {
        let plan = Plan::new(&lower, eliminated, rank, workers, progress)?;
        progress.needs(plan.bytes())?;
        Self::planned(plan, lower, check, workers, progress)
    }

    /// Factorises the matrix of which `plan` was made.
    pub fn planned(
        plan: Plan,
        mut lower: Csc,
        check: RigidModeCheck,
        workers: &dyn Workers,
        progress: &mut dyn FactorProgress,
    ) -> Result<Self, Failure> {
        let Numeric { values, schur, .. } = diagnosed(&plan, &mut lower, workers, progress)?;
        let structure = plan.structure;
        let (eliminated, m) = (structure.eliminated, structure.kept());
        let mut found = SparseSchur { structure, values, schur, last: Mutex::new(None) };
        let units: Vec<f64> =
            (eliminated..lower.ncols()).map(|j| diagonal(&lower, j).unwrap_or_default()).collect();
        let few = check == RigidModeCheck::Always || m <= FEW;
        if few || is_suspicious(&units, |i| found.schur[i + m * i]) {
            found.settle(lower, &units)?;
        }
        Ok(found)
    }

    /// Makes `S` exact on the motions that nothing resists; `lower` is the whole matrix, and `units` is the
    /// diagonal of `C`.
    fn settle(&mut self, lower: Csc, units: &[f64]) -> Result<(), StiffnessDefect> {
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

    /// The right sides `(a, c)`, one behind the other, after elimination of the first rows: of each one
    /// `c - B A⁻¹ a`.
    pub fn condense(&self, rhs: &[f64]) -> Vec<f64> {
        let (size, eliminated) = (self.structure.size.max(1), self.structure.eliminated);
        let x = self.forward(rhs);
        let condensed = x.chunks_exact(size).flat_map(|x| &x[eliminated..]).copied().collect();
        // The reserve of a call holds nothing that outlives it.
        if x.len() == size && !shortage::is_noted() {
            let last = [rhs.to_vec(), x];
            if let Ok(mut place) = self.last.try_lock() {
                *place = Some(last);
            }
        }
        condensed
    }

    /// The solution of the first rows, `A⁻¹ (a - Bᵀ d)`, followed by `d`; `rhs` is `(a, c)`, of which
    /// `c` does not matter. Of several, each argument has its vectors one behind the other, and so has the
    /// result.
    pub fn recover(&self, rhs: &[f64], d: &[f64]) -> Vec<f64> {
        let (size, eliminated) = (self.structure.size.max(1), self.structure.eliminated);
        let mut x = self.last_of(rhs).unwrap_or_else(|| self.forward(rhs));
        let kept = d.chunks_exact(self.structure.kept().max(1));
        for (x, d) in x.chunks_exact_mut(size).zip(kept) {
            x[eliminated..].copy_from_slice(d);
        }
        solve::backward(&self.structure, &self.values, &mut x);
        self.structure.unordered(&x)
    }

    /// The result of elimination for a right side, if it is the last one. No call waits for the lock: after a fork it
    /// may belong to a thread that is not there.
    fn last_of(&self, rhs: &[f64]) -> Option<Vec<f64>> {
        let last = self.last.try_lock().ok()?;
        last.as_ref().filter(|[known, _]| known == rhs).map(|[_, x]| x.clone())
    }

    fn forward(&self, rhs: &[f64]) -> Vec<f64> {
        let mut x = self.structure.ordered(rhs);
        solve::forward(&self.structure, &self.values, &mut x);
        x
    }
}
