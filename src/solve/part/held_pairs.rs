//! A problem parted into pairs whose state is decided and pairs whose state is in question.

use super::pair_data::PairData;
use crate::law::{Contact, FixedState};
use crate::linalg::elimination::Elimination;
use crate::monitor::{Monitor, Stop};
use crate::problem::{ContactProblem, Stiffness};

/// The contact problem of the pairs in question: open ones are eliminated, stuck ones are at their reference.
pub struct Parted<'c> {
    contact: &'c Contact<'c>,
    elimination: Elimination,
    /// Displacements of the stuck pairs, zero of others.
    stuck: Vec<f64>,
    /// Loads on the open pairs, and what is left on those in question.
    on_open: Vec<f64>,
    load: Vec<f64>,
    own: PairData,
}

impl<'c> Parted<'c> {
    /// Parts a problem by how each pair is held; `None` if the matrix of the open ones is not definite. `Err`: there
    /// is no time for it.
    pub fn new(
        contact: &'c Contact<'c>,
        held: &[Option<FixedState>],
        monitor: &mut Monitor<'_>,
    ) -> Result<Option<Self>, Stop> {
        let (problem, dim) = (contact.problem(), contact.dim());
        let (mut pairs, mut stuck) = (Vec::new(), vec![0.0; contact.unknowns()]);
        let (mut open, mut kept) = (Vec::new(), Vec::new());
        for (pair, held) in held.iter().enumerate() {
            let components = dim * pair..dim * (pair + 1);
            match held {
                Some(FixedState::Open) => open.extend(components),
                Some(FixedState::Stuck) => {
                    stuck[components].copy_from_slice(&contact.pairs()[pair].reference()[..dim]);
                }
                None => {
                    pairs.push(pair);
                    kept.extend(components);
                }
            }
        }
        monitor.affords(Elimination::work(open.len(), kept.len()))?;
        let lack = problem.force(&stuck);
        let Some(elimination) = Elimination::new(problem.stiffness(), open, kept) else {
            return Ok(None);
        };
        let on_open: Vec<f64> = elimination.dropped().iter().map(|&i| -lack[i]).collect();
        let taken = elimination.transfer(&on_open);
        let load =
            elimination.kept().iter().zip(taken).map(|(&i, taken)| -lack[i] - taken).collect();
        Ok(Some(Parted {
            load,
            own: PairData::of(problem, &pairs),
            contact,
            elimination,
            stuck,
            on_open,
        }))
    }

    /// The problem of the pairs in question; `None` if its numbers are beyond the largest one.
    pub fn problem(&self) -> Option<ContactProblem<'_>> {
        let (whole, dim) = (self.contact.problem(), self.contact.dim());
        let relation = Stiffness::new(self.elimination.schur(), &self.load, dim);
        let law = whole.law().with_values(&self.own.parameters);
        let is_finite = self.load.iter().all(|load| load.is_finite());
        let part =
            ContactProblem::with_relation(relation, dim, &self.own.gap, law, Some(&self.own.slip))
                .ok();
        part.filter(|_| is_finite)
    }

    /// The components that belong to the pairs in question, of any vector of all components.
    pub fn restrict(&self, values: &[f64]) -> Vec<f64> {
        self.elimination.kept().iter().map(|&i| values[i]).collect()
    }

    /// All displacements from those of the pairs in question.
    pub fn expand(&self, x: &[f64]) -> Vec<f64> {
        let mut d = self.stuck.clone();
        let on_open = self.elimination.follow(&self.on_open, x);
        self.elimination.kept().iter().zip(x).for_each(|(&i, x)| d[i] = *x);
        self.elimination.dropped().iter().zip(on_open).for_each(|(&i, x)| d[i] = x);
        d
    }
}
