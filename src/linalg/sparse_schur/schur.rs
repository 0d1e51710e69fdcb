//! The factor of the eliminated rows, and the Schur complement of the others.

use super::diagnosis::diagnosed;
use super::factor_progress::{FactorProgress, Failure};
use super::numeric::Numeric;
use super::plan::Plan;
use super::solve;
use super::structure::Structure;
use crate::linalg::free_motions::{Doubt, Whole, settle, suspicious_pivot};
use crate::linalg::last_case::LastCase;
use crate::linalg::sparse_matrix::{Csc, diagonals, symmetric_magnitude, symmetric_times};
use crate::linalg::tolerances::FREE;
use crate::linalg::vector::{dot, largest_of, norm_inf, sizes};
use crate::linalg::watched::GoesOn;

/// So many rows of `C` are few beside the rigid motions of a body, which are up to six: pivots tell which of
/// them depend on the others, at no cost. Of more rows the weakest pivot and the diagonal say if they are looked at.
const FEW: usize = 24;

/// The factor and the Schur complement.
pub struct SparseSchur {
    structure: Structure,
    /// The factor.
    values: Vec<f64>,
    /// `S`, column-major.
    pub schur: Vec<f64>,
    /// The diagonal before the elimination, beside which `S` is rounded: positive.
    pub units: Vec<f64>,
    /// The last right side that was condensed by itself, and the result of its elimination: its recovery needs both
    /// again.
    last: LastCase,
}

impl SparseSchur {
    /// Factorises the symmetric matrix whose lower triangle is `lower`, every diagonal entry stored, and of which `plan` was
    /// made. Free motions are looked for if `C` has few rows, if rounding may hide them, or, beside those that are `known`
    /// ([`settle`]), always.
    pub fn new(
        plan: Plan,
        mut lower: Csc,
        known: Option<&[Vec<f64>]>,
        progress: &mut FactorProgress<'_>,
    ) -> Result<Self, Failure> {
        let (values, Numeric { schur, weakest, .. }) =
            diagnosed((&plan.structure, &plan.schedule), &mut lower, progress)?;
        let structure = plan.structure;
        let (eliminated, m) = (structure.eliminated, structure.kept());
        let mut units: Vec<f64> = diagonals(&lower).skip(eliminated).collect();
        // A component of a rigid body has no stiffness of its own: the stiffest other one is its unit.
        let largest = largest_of(units.iter().copied());
        let of_rigid = if largest > 0.0 { largest } else { 1.0 };
        units.iter_mut().filter(|unit| **unit == 0.0).for_each(|unit| *unit = of_rigid);
        let least = suspicious_pivot(weakest.map_or(1.0, |(_, pivot)| pivot));
        let last = LastCase::default();
        let mut found = SparseSchur { structure, values, schur, units, last };
        let doubt = match known.is_some() || m <= FEW {
            true => Some(Doubt::Pivots),
            false => Doubt::of(least, &found.units, |i| found.schur[i + m * i]),
        };
        if let Some(doubt) = doubt {
            let mut schur = std::mem::take(&mut found.schur);
            let (units, whole) = (&found.units[..], Unreduced { lower, factor: &found });
            let known = known.unwrap_or(&[]);
            settle(&mut schur, (units, least, doubt), (known, &whole), &mut || {
                progress(1.0).is_ok()
            })?;
            found.schur = schur;
            progress(1.0)?;
        }
        Ok(found)
    }

    /// Makes each of these decoupled rows of `S` as stiff as the stiffest other one of its group of `group` rows. Methods
    /// scale the rows of a group alike.
    pub fn level(&mut self, decoupled: &[usize], group: usize) {
        let size = self.schur.len().isqrt();
        for &i in decoupled {
            let first = i - i % group;
            let others = (first..first + group).filter(|j| decoupled.binary_search(j).is_err());
            let stiffest = others.map(|j| self.schur[j + size * j]).fold(0.0, f64::max);
            if stiffest > 0.0 {
                self.schur[i + size * i] = stiffest;
            }
        }
    }

    /// The right sides `(a, c)`, one behind the other, after elimination of the first rows: of each one
    /// `c - B A⁻¹ a`; `None` where `goes_on` says no. On a component that nothing resists, nothing could balance a load that is
    /// but the rounding of what the eliminated rows leave: it is zero.
    pub fn condense(&self, rhs: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let (size, eliminated) = (self.structure.size.max(1), self.structure.eliminated);
        let x = self.forward(rhs, goes_on)?;
        let mut condensed: Vec<f64> =
            x.chunks_exact(size).flat_map(|x| &x[eliminated..]).copied().collect();
        let m = self.structure.kept();
        let free: Vec<usize> = (0..m).filter(|i| self.schur[i + m * i] == 0.0).collect();
        if !free.is_empty() {
            let mut moved = x.clone();
            moved.chunks_exact_mut(size).for_each(|x| x[eliminated..].fill(0.0));
            solve::backward(&self.structure, &self.values, &mut moved, goes_on)?;
            for (load, moved) in condensed.chunks_exact_mut(m).zip(moved.chunks_exact(size)) {
                let largest = norm_inf(&moved[..eliminated]);
                for &i in &free {
                    if load[i].abs() <= FREE * f64::EPSILON * self.units[i] * largest {
                        load[i] = 0.0;
                    }
                }
            }
        }
        if x.len() == size {
            self.last.keep(rhs, &x);
        }
        Some(condensed)
    }

    /// The solution of the first rows, `A⁻¹ (a - Bᵀ d)`, followed by `d`; `rhs` is `(a, c)`, of which
    /// `c` does not matter. Of several, each argument has its vectors one behind the other, and so has the
    /// result. `None` where `goes_on` says no.
    pub fn recover(&self, rhs: &[f64], d: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let (size, eliminated) = (self.structure.size.max(1), self.structure.eliminated);
        let known = self.last.of(rhs, |_| true);
        let mut x = known.or_else(|| self.forward(rhs, goes_on))?;
        let kept = d.chunks_exact(self.structure.kept().max(1));
        for (x, d) in x.chunks_exact_mut(size).zip(kept) {
            x[eliminated..].copy_from_slice(d);
        }
        solve::backward(&self.structure, &self.values, &mut x, goes_on)?;
        Some(self.structure.unordered(&x))
    }

    fn forward(&self, rhs: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let mut x = self.structure.ordered(rhs);
        solve::forward(&self.structure, &self.values, &mut x, goes_on)?;
        Some(x)
    }
}

/// The matrix before the elimination, with its factor.
struct Unreduced<'f> {
    lower: Csc,
    factor: &'f SparseSchur,
}

impl Whole for Unreduced<'_> {
    /// With one step of iterative refinement.
    fn extended(&self, kept: &[f64], goes_on: GoesOn<'_>) -> Option<Vec<f64>> {
        let mut motion = self.factor.recover(&vec![0.0; self.lower.ncols()], kept, goes_on)?;
        let lack = self.forces(&motion);
        let correction = self.factor.recover(&lack, &vec![0.0; kept.len()], goes_on)?;
        motion.iter_mut().zip(&correction).for_each(|(x, correction)| *x -= correction);
        Some(motion)
    }

    fn forces(&self, motion: &[f64]) -> Vec<f64> {
        symmetric_times(&self.lower, motion)
    }

    fn noise(&self, motion: &[f64]) -> f64 {
        let size = sizes(motion);
        f64::EPSILON * dot(&size, &symmetric_magnitude(&self.lower, &size))
    }
}
