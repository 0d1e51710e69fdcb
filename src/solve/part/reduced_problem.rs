//! A smaller problem on some of the pairs, of which every solution is one of the whole problem as long as the other pairs
//! keep their states: open ones are eliminated, stuck ones are at their reference.
//!
//! With `O` the components of the open pairs, `C` those that are kept and `r` the loads less the forces of the stuck
//! pairs' displacements,
//!
//! ```text
//! (K_CC - K_CO K_OO⁻¹ K_OC) d_C = r_C - K_CO K_OO⁻¹ r_O + F_C
//! ```

use std::borrow::Cow;
use std::sync::Arc;

use super::pair_data::PairData;
use crate::law::{Piece, Vector};
use crate::linalg::elimination::Elimination;
use crate::monitor::{Stop, Watch};
use crate::problem::{ContactProblem, Stiffness};
use crate::solve::pieces::Equations;

/// Fewer components are not worth their elimination.
const WORTHWHILE: usize = 24;

/// The problem of the pairs that are kept.
pub struct ReducedProblem<'w> {
    whole: &'w Equations<'w>,
    /// The elimination of the open pairs.
    pub elimination: Arc<Elimination>,
    /// Displacements of the stuck pairs, zero of others.
    stuck: Vec<f64>,
    /// Loads on the open pairs, and what is left on those that are kept.
    on_open: Vec<f64>,
    load: Vec<f64>,
}

impl<'w> ReducedProblem<'w> {
    /// Keeps the pairs that are held on no piece; `None` if that is not worthwhile, or if the matrix of the open ones
    /// is not definite. `Err`: there is no time for it.
    pub fn new(
        whole: &'w Equations<'w>,
        held: &[Option<Piece>],
        monitor: &dyn Watch,
    ) -> Result<Option<Self>, Stop> {
        let (mut stuck, mut open, mut kept) = (vec![0.0; whole.root.len()], Vec::new(), Vec::new());
        for (pair, (piece, law)) in held.iter().zip(whole.laws.iter()).enumerate() {
            let components = whole.dim * pair..whole.dim * (pair + 1);
            match piece {
                Some(piece) if !piece.closed => open.extend(components),
                Some(_) => {
                    stuck[components].copy_from_slice(&law.reference()[..whole.dim]);
                }
                None => kept.extend(components),
            }
        }
        if stuck.len() - kept.len() < WORTHWHILE || kept.is_empty() || !whole.symmetric {
            return Ok(None);
        }
        monitor.affords(Elimination::work(open.len(), kept.len()))?;
        let elimination = Elimination::new(whole.matrix, open, kept, &mut monitor.asking());
        Ok(elimination.map(|elimination| Self::by(whole, Arc::new(elimination), stuck)))
    }

    /// The problem reduced by an elimination of an earlier one, if all pairs that are eliminated are free when they are
    /// open.
    pub fn by_elimination(
        whole: &'w Equations<'w>,
        elimination: &Arc<Elimination>,
    ) -> Option<Self> {
        let mut components = elimination.dropped.iter();
        let are_free = components.all(|i| whole.laws[i / whole.dim].is_free_when_open());
        let nothing = || vec![0.0; whole.root.len()];
        are_free.then(|| Self::by(whole, Arc::clone(elimination), nothing()))
    }

    fn by(whole: &'w Equations<'w>, elimination: Arc<Elimination>, stuck: Vec<f64>) -> Self {
        let lack = whole.force(&stuck);
        let on_open: Vec<f64> = elimination.dropped.iter().map(|&i| -lack[i]).collect();
        let taken = elimination.transfer(&on_open);
        let kept = elimination.kept.iter().zip(taken);
        let load = kept.map(|(&i, taken)| -lack[i] - taken).collect();
        ReducedProblem { whole, elimination, stuck, on_open, load }
    }

    /// The pairs of some components.
    fn pairs<'s>(&'s self, components: &'s [usize]) -> impl Iterator<Item = usize> + 's {
        components.iter().step_by(self.whole.dim).map(|i| i / self.whole.dim)
    }

    /// The pairs that are kept.
    pub fn kept(&self) -> impl Iterator<Item = usize> + '_ {
        self.pairs(&self.elimination.kept)
    }

    /// The components that are kept, of any vector of all components.
    pub fn restrict(&self, values: &[f64]) -> Vec<f64> {
        self.elimination.kept.iter().map(|&i| values[i]).collect()
    }

    /// The equations of the pairs that are kept, with the scales that they have in the whole problem.
    pub fn equations(&self) -> Equations<'_> {
        let laws = self.kept().map(|pair| self.whole.laws[pair]).collect();
        let load = Cow::Borrowed(self.load.as_slice());
        let matrix = self.elimination.schur();
        Equations::new(self.whole.dim, matrix, load, Cow::Owned(laws), self.whole.unit)
    }

    /// The contact problem of the pairs that are kept, whose data are `own`; `None` if its numbers are beyond the largest
    /// one.
    pub fn problem<'p>(
        &'p self,
        whole: &ContactProblem<'p>,
        own: &'p PairData,
    ) -> Option<ContactProblem<'p>> {
        let relation = Stiffness::new(self.elimination.schur(), &self.load, self.whole.dim);
        let law = whole.law().with_values(&own.parameters);
        let slip = Some(own.slip.as_slice());
        let part =
            ContactProblem::with_relation(relation, self.whole.dim, &own.gap, law, slip).ok();
        part.filter(|_| self.load.iter().all(|load| load.is_finite()))
    }

    /// All displacements from those of the pairs that are kept.
    pub fn expand(&self, on_kept: &[f64]) -> Vec<f64> {
        let mut d = self.stuck.clone();
        let on_open = self.elimination.follow(&self.on_open, on_kept);
        self.elimination.kept.iter().zip(on_kept).for_each(|(&i, x)| d[i] = *x);
        self.elimination.dropped.iter().zip(on_open).for_each(|(&i, x)| d[i] = x);
        d
    }

    /// All displacements, with the force that they need and the coordinates, from displacements and coordinates
    /// of the pairs that are kept.
    pub fn whole_from(&self, d: &[f64], y: &[Vector]) -> (Vec<f64>, Vec<f64>, Vec<Vector>) {
        let d = self.expand(d);
        let force = self.whole.force(&d);
        let mut all = self.whole.coordinates(&d, &force);
        self.kept().zip(y).for_each(|(pair, own)| all[pair] = *own);
        (d, force, all)
    }

    /// Eliminated pairs that are not open at the coordinates `y` of all pairs.
    pub fn closing(&self, y: &[Vector]) -> Vec<usize> {
        let pieces = self.whole.pieces(y);
        self.pairs(&self.elimination.dropped).filter(|&pair| pieces[pair].closed).collect()
    }
}
