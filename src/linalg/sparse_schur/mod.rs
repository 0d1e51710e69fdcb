//! Sparse Cholesky factorisation of `[A Bᵀ; B C]` that ends before the columns of `C`, and the Schur
//! complement `S = C - B A⁻¹ Bᵀ`, on the calling thread.
//!
//! With `A = L Lᵀ` the factor has the rows `B' = B L⁻ᵀ`, and `S = C - B' B'ᵀ` is accumulated in place while
//! they are computed. Nothing of `S` is factorised, so that it may be singular. Loads `(a, c)` become
//! `c - B' y` with `L y = a`; and `Lᵀ x = y - B'ᵀ d` gives the eliminated unknowns.

mod dense;
mod failure;
mod graph;
mod numeric;
mod order;
mod solve;
mod structure;
mod watch;

pub use failure::Failure;
pub use watch::{Unwatched, Watch};

use super::free_motions::{self, Doubt, is_suspicious};
use super::null_vector::{resistance, weakest};
use super::sparse_matrix::{Csc, diagonal};
use super::tolerances::{NULL_VECTOR, REGULARISATION, SUSPICIOUS_PIVOT};
use super::unreduced::Unreduced;
use numeric::{Numeric, Unfinished, factorised};
use structure::Structure;
use watch::answered;

/// So many rows of `C` are few beside the rigid motions of a body, which are up to six: pivots tell which of
/// them depend on the others, at no cost. Of more rows small diagonal entries alone are looked at.
const FEW: usize = 24;

/// When free motions are looked for.
#[derive(Clone, Copy, PartialEq)]
pub enum Look {
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
}

impl SparseSchur {
    /// Factorises the symmetric matrix whose lower triangle is `lower`, every diagonal entry stored.
    /// The first `eliminated` rows are those of `A`; `rank`, if given, orders them. `watch` is told the
    /// memory before it is taken.
    pub fn new(
        mut lower: Csc,
        eliminated: usize,
        rank: Option<&[usize]>,
        look: Look,
        watch: &mut dyn Watch,
    ) -> Result<Self, Failure> {
        let structure = Structure::new(&lower, eliminated, rank, watch)?;
        let panel_of = structure.panel_of_columns()?;
        let update = structure.cost(&panel_of).update;
        let matrix = lower.compute_nnz() * (size_of::<usize>() + size_of::<f64>());
        let bytes = numeric::bytes(&structure, &lower, update) + structure.bytes() + matrix;
        answered(watch.announce(bytes as u64))?;
        let (numeric, singular) = match factorised(&structure, &panel_of, &lower, watch) {
            Ok(numeric) => (numeric, false),
            Err(Unfinished::Failed(failure)) => return Err(failure),
            Err(Unfinished::Pivot(_)) => {
                (0..eliminated).for_each(|j| scale_diagonal(&mut lower, j, 1.0 + REGULARISATION));
                match factorised(&structure, &panel_of, &lower, watch) {
                    Ok(numeric) => (numeric, true),
                    Err(Unfinished::Failed(failure)) => return Err(failure),
                    Err(Unfinished::Pivot(place)) => {
                        return Err(Failure::Indefinite(structure.order[place]));
                    }
                }
            }
        };
        let Numeric { values, schur, weakest } = numeric;
        let mut found = SparseSchur { structure, values, schur };
        if let Some((place, pivot)) = weakest
            && (singular || pivot < SUSPICIOUS_PIVOT)
        {
            let vector = found.weakest_motion(place);
            if singular || resistance(&lower, &vector) <= NULL_VECTOR {
                return Err(Failure::NullVector(vector));
            }
        }
        let m = found.structure.kept();
        let units: Vec<f64> =
            (eliminated..lower.ncols()).map(|j| diagonal(&lower, j).unwrap_or_default()).collect();
        let few = look == Look::Always || m <= FEW;
        if few || is_suspicious(&units, |i| found.schur[i + m * i]) {
            found.settle(lower, &units)?;
        }
        Ok(found)
    }

    /// The motion of the eliminated rows that `A` resists least, by inverse iteration from a `place`.
    fn weakest_motion(&self, place: usize) -> Vec<f64> {
        let structure = &self.structure;
        let ordered = weakest(structure.size, place, |x| {
            solve::forward(structure, &self.values, x);
            x[structure.eliminated..].fill(0.0);
            solve::backward(structure, &self.values, x);
        });
        self.unordered(&ordered)
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
        self.forward(rhs).split_off(self.structure.eliminated)
    }

    /// The solution of the first rows, `A⁻¹ (a - Bᵀ d)`, followed by `d`; `rhs` is `(a, c)`, of which
    /// `c` does not matter.
    pub fn recover(&self, rhs: &[f64], d: &[f64]) -> Vec<f64> {
        let mut x = self.forward(rhs);
        x[self.structure.eliminated..].copy_from_slice(d);
        solve::backward(&self.structure, &self.values, &mut x);
        self.unordered(&x)
    }

    fn forward(&self, rhs: &[f64]) -> Vec<f64> {
        let mut x: Vec<f64> = self.structure.order.iter().map(|&i| rhs[i]).collect();
        solve::forward(&self.structure, &self.values, &mut x);
        x
    }

    fn unordered(&self, ordered: &[f64]) -> Vec<f64> {
        let mut vector = vec![0.0; ordered.len()];
        for (&i, x) in self.structure.order.iter().zip(ordered) {
            vector[i] = *x;
        }
        vector
    }
}

/// Multiplies the diagonal entry of column `j`, which is stored first.
fn scale_diagonal(lower: &mut Csc, j: usize, factor: f64) {
    let place = lower.symbolic().col_ptr()[j];
    lower.val_mut()[place] *= factor;
}
