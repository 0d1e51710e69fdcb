//! A contact problem with the law of each pair worked out: what solvers and the certificate work on.

use std::borrow::Cow;

use super::{Bound, LevelledTangents, PairLaw, Piece};
use crate::linalg::vector::norm_inf;
use crate::problem::{ContactProblem, Relation, Stiffness};

/// A problem and the laws of its pairs.
#[derive(Clone, Debug)]
pub struct Contact<'p, R = Stiffness<'p>> {
    problem: &'p ContactProblem<'p, R>,
    pairs: Vec<PairLaw>,
    /// `f` with the tensions of the pairs.
    load: Cow<'p, [f64]>,
}

impl Contact<'_> {
    /// The force `F - a` that equilibrium at `d` needs beside the tension of the pairs: `K d - (f + a)`.
    pub fn force_without_tension(&self, d: &[f64]) -> Vec<f64> {
        self.problem.stiffness().product_less(d, &self.load)
    }
}

impl<'p, R: Relation> Contact<'p, R> {
    /// Works out the laws of a problem.
    pub fn new(problem: &'p ContactProblem<'p, R>) -> Self {
        let pair = |pair: usize| {
            let (dim, gap) = (problem.dim(), problem.gap(pair));
            let slip = |c: usize| if c + 1 < dim { problem.reference_slip(pair, c) } else { 0.0 };
            let slip0 = std::array::from_fn(slip);
            let stiffness = (problem.unit(dim * pair), problem.tangential_stiffness(pair));
            PairLaw::new(dim, gap, slip0, Bound::FRICTIONLESS, stiffness)
                .with_friction(problem.law().of_pair(pair))
        };
        let pairs: Vec<PairLaw> = (0..problem.pairs()).map(pair).collect();
        let mut load = Cow::Borrowed(problem.relation().load());
        for (pair, law) in pairs.iter().enumerate().filter(|(_, law)| law.tension > 0.0) {
            load.to_mut()[problem.dim() * pair] += law.tension;
        }
        Contact { problem, pairs, load }
    }

    /// The contact of `problem`, which has this one's pairs on other tangents, where they are given.
    pub fn levelled<'q>(
        &self,
        problem: &'q ContactProblem<'q>,
        tangents: &[Option<LevelledTangents>],
    ) -> Contact<'q> {
        let mut contact = Contact::new(problem);
        for ((levelled, law), tangents) in contact.pairs.iter_mut().zip(&self.pairs).zip(tangents) {
            if let Some(tangents) = tangents {
                *levelled = tangents.law(law);
            }
        }
        contact
    }

    /// `f` with the tension of each pair added to its normal component. Under this load the law has no
    /// tension: `K d = (f + a) + (F - a)`, and `F_n - a <= 0`.
    pub fn load_with_tension(&self) -> &[f64] {
        &self.load
    }

    /// Adds the tension of each pair to its normal force: `F` from `F - a`.
    pub fn add_tension(&self, force: &mut [f64]) {
        for (law, normal) in self.pairs.iter().zip(force.iter_mut().step_by(self.dim())) {
            *normal += law.tension;
        }
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

    /// Copies the contact with each law at its reference, for [`Self::beyond_reference`].
    pub fn at_its_reference(&self) -> Self
    where
        R: Clone,
    {
        let pairs = self.pairs.iter().map(PairLaw::at_its_reference).collect();
        Contact { problem: self.problem, pairs, load: self.load.clone() }
    }

    /// `d + low - reference` of each pair ([`PairLaw::beyond_reference`]).
    pub fn beyond_reference(&self, d: &[f64], low: &[f64]) -> Vec<f64> {
        let mut v = Vec::with_capacity(d.len());
        for (law, d, low) in self.each(d, low) {
            v.extend_from_slice(&law.beyond_reference(d, low)[..d.len()]);
        }
        v
    }

    /// The pieces of the normal map on which displacements and forces are.
    pub fn pieces(&self, d: &[f64], force: &[f64]) -> Vec<Piece> {
        self.each(d, force).map(|(law, d, force)| law.piece(&law.trial(d, force))).collect()
    }

    /// Gaps with which every pair that has an obstacle touches it.
    pub fn touching_gaps(&self) -> Vec<f64> {
        let gap = |law: &PairLaw| if law.has_obstacle() { 0.0 } else { f64::INFINITY };
        self.pairs.iter().map(gap).collect()
    }

    /// The pairs that are tied.
    pub fn ties(&self) -> impl Iterator<Item = usize> {
        (0..self.pairs.len()).filter(|&pair| self.pairs[pair].tied)
    }

    /// The displacements nearest to `d` that do not penetrate.
    pub fn admissible(&self, d: &[f64]) -> Vec<f64> {
        let mut d = d.to_vec();
        for (law, normal) in self.pairs.iter().zip(d.iter_mut().step_by(self.dim())) {
            *normal = law.admissible(*normal);
        }
        d
    }

    /// The largest part, at most 1, of a `motion` that can be taken from `d` without penetration.
    pub fn admissible_part(&self, d: &[f64], motion: &[f64]) -> f64 {
        let dim = self.dim();
        let normals = d.iter().step_by(dim).zip(motion.iter().step_by(dim));
        let part = |(law, (&d, &r)): (&PairLaw, (&f64, &f64))| {
            if r < 0.0 { ((law.gap - d) / -r).max(0.0) } else { 1.0 }
        };
        self.pairs.iter().zip(normals).map(part).fold(1.0, f64::min)
    }

    /// The friction that the pairs can carry under forces.
    pub fn thresholds(&self, force: &[f64]) -> Vec<f64> {
        let normals = force.iter().step_by(self.dim());
        self.pairs.iter().zip(normals).map(|(law, &normal)| law.threshold(normal)).collect()
    }

    /// Gives the pairs thresholds in the place of their own bounds: a Tresca problem.
    pub fn set_thresholds(&mut self, thresholds: &[f64]) {
        for (law, &threshold) in self.pairs.iter_mut().zip(thresholds) {
            *law = law.with_bound(Bound::tresca(threshold));
        }
    }

    /// Returns `true` if no pair can carry a tangential force.
    pub fn is_frictionless(&self) -> bool {
        !self.pairs.iter().any(PairLaw::has_friction)
    }

    /// Returns `true` if the bound of some pair depends on its pressure.
    pub fn is_coupled(&self) -> bool {
        self.bounds().any(|bound| bound.slope > 0.0)
    }

    /// Returns `true` if some pair slips along a friction that does not take the most work from its slip.
    pub fn has_collinear_slip(&self) -> bool {
        self.pairs.iter().any(PairLaw::is_collinear)
    }

    /// The bounds of all pairs.
    pub fn bounds(&self) -> impl Iterator<Item = Bound> {
        self.pairs.iter().map(|law| law.bound)
    }

    /// Returns `true` if nothing but a reference slip can cause forces.
    pub fn is_unloaded(&self) -> bool {
        norm_inf(self.problem.relation().load()) == 0.0
            && self.pairs.iter().all(PairLaw::admits_zero)
    }

    /// Returns `true` if zero displacement is the solution: no load, no interference, no reference slip.
    pub fn is_at_rest(&self) -> bool {
        let no_slip = |law: &PairLaw| law.reference()[1..] == [0.0; 2];
        self.is_unloaded() && self.pairs.iter().all(no_slip)
    }
}

/// The references of pairs, `dim` components of each.
pub fn references(laws: &[PairLaw], dim: usize) -> impl Iterator<Item = f64> {
    laws.iter().flat_map(move |law| law.reference().into_iter().take(dim))
}

/// Roots of the stiffnesses that scale the components of pairs.
pub fn scale_roots(laws: &[PairLaw], dim: usize) -> impl Iterator<Item = f64> {
    laws.iter().flat_map(move |law| law.scale().into_iter().take(dim).map(f64::sqrt))
}
