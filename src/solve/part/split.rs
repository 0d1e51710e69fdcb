//! A problem parted into candidates and pairs that are surely open, which leave the equations by one Cholesky
//! factorisation.

use std::borrow::Cow;
use std::sync::Arc;

use crate::law::Vector;
use crate::linalg::elimination::Elimination;
use crate::monitor::{Monitor, Stop};
use crate::solve::pieces::Equations;

/// Fewer components are not worth their elimination.
const WORTHWHILE: usize = 24;

/// A problem parted into candidates and open pairs.
pub struct Split<'w> {
    whole: &'w Equations<'w>,
    elimination: Arc<Elimination>,
    load: Vec<f64>,
}

impl<'w> Split<'w> {
    /// Eliminates all pairs but `kept`; `None` if that is not worthwhile, or not possible. `Err`: there is no time
    /// for it.
    pub fn new(
        whole: &'w Equations<'w>,
        kept: &[usize],
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Self>, Stop> {
        let dim = whole.dim;
        let parts = |pair: &usize| dim * pair..dim * (pair + 1);
        let mut is_kept = vec![false; whole.laws.len()];
        kept.iter().for_each(|&pair| is_kept[pair] = true);
        let dropped: Vec<usize> = (0..is_kept.len())
            .filter(|&pair| !is_kept[pair])
            .flat_map(|pair| parts(&pair))
            .collect();
        if dropped.len() < WORTHWHILE || kept.is_empty() || !whole.symmetric {
            return Ok(None);
        }
        let components: Vec<usize> = kept.iter().flat_map(parts).collect();
        monitor.affords(Elimination::work(dropped.len(), components.len()))?;
        let elimination = Elimination::new(whole.matrix, dropped, components);
        Ok(elimination.map(|elimination| Self::by(whole, Arc::new(elimination))))
    }

    /// The problem parted by an elimination of components of its matrix.
    pub fn by(whole: &'w Equations<'w>, elimination: Arc<Elimination>) -> Self {
        let on_dropped: Vec<f64> = elimination.dropped().iter().map(|&i| whole.load[i]).collect();
        let taken = elimination.transfer(&on_dropped);
        let kept = elimination.kept().iter().zip(taken);
        let load = kept.map(|(&i, taken)| whole.load[i] - taken).collect();
        Split { whole, elimination, load }
    }

    /// The equations of the whole problem.
    pub fn whole(&self) -> &'w Equations<'w> {
        self.whole
    }

    /// The elimination of the open pairs.
    pub fn elimination(&self) -> &Arc<Elimination> {
        &self.elimination
    }

    /// The pairs of some components.
    fn pairs<'s>(&'s self, components: &'s [usize]) -> impl Iterator<Item = usize> + 's {
        components.iter().step_by(self.whole.dim).map(|i| i / self.whole.dim)
    }

    /// The candidates.
    pub fn kept(&self) -> impl Iterator<Item = usize> + '_ {
        self.pairs(self.elimination.kept())
    }

    /// The entries of the candidates, of values that each pair has.
    pub fn of_kept(&self, y: &[Vector]) -> Vec<Vector> {
        self.kept().map(|pair| y[pair]).collect()
    }

    /// The equations of the candidates.
    pub fn equations(&self) -> Equations<'_> {
        let laws = self.kept().map(|pair| self.whole.laws[pair]).collect();
        let load = Cow::Borrowed(self.load.as_slice());
        let matrix = self.elimination.schur();
        Equations::new(self.whole.dim, matrix, load, Cow::Owned(laws), self.whole.unit)
    }

    /// All displacements, with the force that they need and the coordinates, from displacements and coordinates
    /// of the candidates.
    pub fn whole_from(&self, d: &[f64], y: &[Vector]) -> (Vec<f64>, Vec<f64>, Vec<Vector>) {
        let d = self.expand(d);
        let force = self.whole.force(&d);
        let mut all = self.whole.coordinates(&d, &force);
        self.kept().zip(y).for_each(|(pair, own)| all[pair] = *own);
        (d, force, all)
    }

    /// All displacements from those of the candidates.
    fn expand(&self, on_kept: &[f64]) -> Vec<f64> {
        let (dropped, kept) = (self.elimination.dropped(), self.elimination.kept());
        let load: Vec<f64> = dropped.iter().map(|&i| self.whole.load[i]).collect();
        let on_dropped = self.elimination.follow(&load, on_kept);
        let mut d = vec![0.0; self.whole.root.len()];
        kept.iter().zip(on_kept).for_each(|(&i, x)| d[i] = *x);
        dropped.iter().zip(on_dropped).for_each(|(&i, x)| d[i] = x);
        d
    }

    /// Eliminated pairs that are not open at the coordinates `y` of all pairs.
    pub fn closing(&self, y: &[Vector]) -> Vec<usize> {
        let pieces = self.whole.pieces(y);
        self.pairs(self.elimination.dropped()).filter(|&pair| pieces[pair].closed).collect()
    }
}
