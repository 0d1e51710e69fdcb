//! Components without a contact law, eliminated from a frictionless problem.
//!
//! Tangential components, and normal ones without an obstacle, carry no contact force. What is left
//! is a problem in the normal displacements, `M d_n = load + F_n`, with the Schur complement `M`.
//! `K` may be singular: components that depend on others through a free motion are set aside, and
//! no singular block is inverted.

use super::factor::Factor;
use crate::certificate;
use crate::linalg::dense::RANK;
use crate::problem::{ContactData, ContactProblem, FrictionLaw};

/// A frictionless problem and what is left of it.
pub struct Elimination<'p> {
    problem: &'p ContactProblem<'p>,
    kept: Vec<usize>,
    factor: Factor,
    at_rest: Vec<f64>,
    matrix: Vec<f64>,
    load: Vec<f64>,
    gap: Vec<f64>,
    no_friction: Vec<f64>,
}

/// Why a problem cannot be reduced.
pub enum Obstruction {
    /// `K` is not positive semi-definite.
    Indefinite,
    /// The loads do work on a motion that no contact hinders.
    Driven(Vec<f64>),
}

impl<'p> Elimination<'p> {
    /// Eliminates; the friction of `problem` is zero.
    pub fn new(problem: &'p ContactProblem<'p>) -> Result<Self, Obstruction> {
        let dim = problem.dim();
        let (normal, eliminated): (Vec<usize>, Vec<usize>) =
            (0..problem.unknowns()).partition(|i| i % dim == 0 && problem.gap(i / dim).is_finite());
        let factor = Factor::new(problem, eliminated).ok_or(Obstruction::Indefinite)?;
        let mut at_rest = vec![0.0; problem.unknowns()];
        factor.equilibrate(problem, &mut at_rest);
        if let Some(motion) = driven_motion(problem, &factor, &at_rest) {
            return Err(Obstruction::Driven(motion));
        }
        let whole = factor.schur_complement(problem, &normal);
        let size = normal.len();
        // A normal component that moves without force: it is pressed on its obstacle or taken away.
        let (weightless, weighty): (Vec<usize>, Vec<usize>) =
            (0..size).partition(|&k| whole[k + size * k] <= RANK * problem.diagonal(normal[k]));
        let force = problem.force(&at_rest);
        for &k in &weightless {
            at_rest[normal[k]] = problem.gap(normal[k] / dim);
            if force[normal[k]] > 0.0 {
                let mut motion = vec![0.0; problem.unknowns()];
                motion[normal[k]] = -1.0;
                factor.follow(problem, &mut motion);
                if certificate::is_escape(problem, &motion) {
                    return Err(Obstruction::Driven(motion));
                }
            }
        }
        factor.equilibrate(problem, &mut at_rest);
        let kept: Vec<usize> = weighty.iter().map(|&k| normal[k]).collect();
        Ok(Elimination {
            factor,
            matrix: weighty
                .iter()
                .flat_map(|&j| weighty.iter().map(move |&i| i + size * j))
                .map(|entry| whole[entry])
                .collect(),
            load: kept.iter().map(|&i| -force[i]).collect(),
            gap: kept.iter().map(|&i| problem.gap(i / dim)).collect(),
            no_friction: vec![0.0; kept.len()],
            problem,
            kept,
            at_rest,
        })
    }

    /// Unknowns that are left, normal components all.
    pub fn kept(&self) -> &[usize] {
        &self.kept
    }

    /// What is left, as a contact problem of its own with one component a pair.
    pub fn reduced(&self) -> ContactProblem<'_> {
        ContactProblem::reduced(ContactData {
            dim: 1,
            pairs: self.kept.len(),
            stiffness: &self.matrix,
            ld: self.kept.len().max(1),
            load: &self.load,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.no_friction),
            reference_slip: None,
        })
    }

    /// `M`, column-major.
    pub fn matrix(&self) -> &[f64] {
        &self.matrix
    }

    /// All displacements from the kept ones.
    pub fn expand(&self, kept: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (&i, value) in self.kept.iter().zip(kept) {
            d[i] = *value;
        }
        self.factor.equilibrate(self.problem, &mut d);
        d
    }

    /// The motion of all components that follow a motion of the kept ones without force.
    pub fn follow(&self, kept: &[f64]) -> Vec<f64> {
        let mut motion = vec![0.0; self.problem.unknowns()];
        for (&i, value) in self.kept.iter().zip(kept) {
            motion[i] = *value;
        }
        self.factor.follow(self.problem, &mut motion);
        motion
    }

    /// Solves once more, directly, for equilibrium of all components but the normal ones that
    /// touch, and keeps the better.
    pub fn polished(&self, d: Vec<f64>) -> Vec<f64> {
        let problem = self.problem;
        let dim = problem.dim();
        let touches = |i: usize| i.is_multiple_of(dim) && d[i] == problem.gap(i / dim);
        let free = (0..problem.unknowns()).filter(|&i| !touches(i)).collect();
        let Some(factor) = Factor::new(problem, free) else { return d };
        let mut better = d.clone();
        factor.equilibrate(problem, &mut better);
        for &i in &self.kept {
            better[i] = better[i].min(problem.gap(i / dim));
        }
        let eta = |d: &[f64]| certificate::certify(problem, d).eta;
        if eta(&better) < eta(&d) { better } else { d }
    }
}

/// A motion of eliminated components alone on which the loads do work, if there is one.
pub fn driven_motion(problem: &ContactProblem<'_>, factor: &Factor, d: &[f64]) -> Option<Vec<f64>> {
    factor.dependent().next()?;
    let force = problem.force(d);
    let mut motion = vec![0.0; problem.unknowns()];
    for i in factor.dependent() {
        motion[i] = -force[i] / problem.diagonal(i);
    }
    factor.follow(problem, &mut motion);
    certificate::is_escape(problem, &motion).then_some(motion)
}
