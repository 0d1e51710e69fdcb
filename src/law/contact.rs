//! A contact problem with the law of each pair worked out: what solvers and the certificate work on.

use super::branch::Branch;
use super::{Bound, PairLaw, coulomb, frictionless, tresca};
use crate::linalg::vector::norm_inf;
use crate::problem::{ContactProblem, FrictionLaw, Relation, Stiffness};

/// A problem and the laws of its pairs.
#[derive(Clone, Debug)]
pub struct Contact<'p, R = Stiffness<'p>> {
    problem: &'p ContactProblem<'p, R>,
    pairs: Vec<PairLaw>,
}

impl<'p, R: Relation> Contact<'p, R> {
    /// Works out the laws of a problem.
    pub fn new(problem: &'p ContactProblem<'p, R>) -> Self {
        let pair = |pair: usize| {
            let bound = match problem.law() {
                FrictionLaw::Frictionless => frictionless::bound(),
                FrictionLaw::Coulomb(mu) => coulomb::bound(mu[pair]),
                FrictionLaw::Tresca(g) => tresca::bound(g[pair]),
            };
            let mut slip0 = [0.0; 2];
            for (component, slip0) in slip0[..problem.dim() - 1].iter_mut().enumerate() {
                *slip0 = problem.reference_slip(pair, component);
            }
            let stiffness = (problem.normal_stiffness(pair), problem.tangential_stiffness(pair));
            PairLaw::new(problem.dim(), problem.gap(pair), slip0, bound, stiffness)
        };
        Contact { problem, pairs: (0..problem.pairs()).map(pair).collect() }
    }

    /// The problem.
    pub fn problem(&self) -> &'p ContactProblem<'p, R> {
        self.problem
    }

    /// The laws, pair by pair.
    pub fn pairs(&self) -> &[PairLaw] {
        &self.pairs
    }

    /// Components of a pair.
    pub fn dim(&self) -> usize {
        self.problem.dim()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.problem.unknowns()
    }

    /// The law of each pair with the components of `d` and of `force` that belong to it.
    pub fn each<'s>(
        &'s self,
        d: &'s [f64],
        force: &'s [f64],
    ) -> impl Iterator<Item = (&'s PairLaw, &'s [f64], &'s [f64])> + use<'s, 'p, R> {
        let dim = self.dim();
        let parts = d.chunks_exact(dim).zip(force.chunks_exact(dim));
        self.pairs.iter().zip(parts).map(|(law, (d, force))| (law, d, force))
    }

    /// The branches of the law on which displacements and forces are.
    pub fn branches(&self, d: &[f64], force: &[f64]) -> Vec<Branch> {
        self.each(d, force).map(|(law, d, force)| law.branch(&law.trial(d, force))).collect()
    }

    /// The displacements nearest to `d` that do not penetrate.
    pub fn admissible(&self, d: &[f64]) -> Vec<f64> {
        let mut d = d.to_vec();
        for (law, normal) in self.pairs.iter().zip(d.iter_mut().step_by(self.dim())) {
            *normal = law.admissible(*normal);
        }
        d
    }

    /// Every pair that has an obstacle closed, and sticking as far as it has friction.
    pub fn all_stick(&self) -> Vec<Branch> {
        self.pairs.iter().map(PairLaw::stick).collect()
    }

    /// Gives the pairs thresholds in the place of their own bounds: a Tresca problem.
    pub fn set_thresholds(&mut self, thresholds: &[f64]) {
        for (law, &threshold) in self.pairs.iter_mut().zip(thresholds) {
            *law = law.with_bound(tresca::bound(threshold));
        }
    }

    /// Whether no pair can carry a tangential force.
    pub fn is_frictionless(&self) -> bool {
        !self.pairs.iter().any(PairLaw::has_friction)
    }

    /// Whether the bound of some pair depends on its pressure.
    pub fn is_coupled(&self) -> bool {
        self.bounds().any(|bound| bound.slope > 0.0)
    }

    /// The bounds of all pairs.
    pub fn bounds(&self) -> impl Iterator<Item = Bound> {
        self.pairs.iter().map(PairLaw::bound)
    }

    /// Whether nothing but a reference slip can cause forces.
    pub fn is_unloaded(&self) -> bool {
        norm_inf(self.problem.relation().load()) == 0.0
            && self.pairs.iter().all(PairLaw::admits_zero)
    }

    /// Whether zero displacement is the solution: no load, no interference, no reference slip.
    pub fn is_at_rest(&self) -> bool {
        let no_slip = |law: &PairLaw| law.reference()[1..] == [0.0; 2];
        self.is_unloaded() && self.pairs.iter().all(no_slip)
    }
}
