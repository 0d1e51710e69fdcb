//! Components without a contact law, eliminated from a frictionless problem.
//!
//! Tangential components, and normal ones without an obstacle, carry no contact force. What is left
//! is `p = q + M w` in the openings `w = gap - d_n >= 0` and the pressures `p = -F_n >= 0`, with the
//! Schur complement `M`. `K` may be singular: components that depend on others through a free motion
//! are set aside, and no singular block is inverted.

use crate::certificate;
use crate::linalg::dense::Semidefinite;
use crate::linalg::small::largest;
use crate::problem::{ContactData, ContactProblem, Friction};

/// A frictionless problem and what is left of it.
pub struct Elimination<'p> {
    problem: &'p ContactProblem<'p>,
    kept: Vec<usize>,
    factor: Factor,
    at_rest: Vec<f64>,
    matrix: Vec<f64>,
    q: Vec<f64>,
}

/// Why a problem cannot be reduced.
pub enum Obstruction {
    /// `K` is not positive semi-definite.
    Indefinite,
    /// The loads do work on a motion without any contact.
    Driven(Vec<f64>),
}

impl<'p> Elimination<'p> {
    /// Eliminates; the friction of `problem` is zero.
    pub fn new(problem: &'p ContactProblem<'p>) -> Result<Self, Obstruction> {
        let dim = problem.dim();
        let (kept, eliminated): (Vec<usize>, Vec<usize>) =
            (0..problem.unknowns()).partition(|i| i % dim == 0 && problem.gap(i / dim).is_finite());
        let factor = Factor::new(problem, eliminated).ok_or(Obstruction::Indefinite)?;
        let mut at_rest = at_rest(problem);
        factor.equilibrate(problem, &mut at_rest);
        if let Some(motion) = factor.driven_motion(problem, &at_rest) {
            return Err(Obstruction::Driven(motion));
        }
        let matrix = factor.schur_complement(problem, &kept);
        let force = problem.force(&at_rest);
        let q = kept.iter().map(|&i| -force[i]).collect();
        Ok(Elimination { problem, kept, factor, at_rest, matrix, q })
    }

    /// Unknowns that are left: normal components with an obstacle.
    pub fn kept(&self) -> &[usize] {
        &self.kept
    }

    /// `M`, column-major.
    pub fn matrix(&self) -> &[f64] {
        &self.matrix
    }

    /// `q`.
    pub fn q(&self) -> &[f64] {
        &self.q
    }

    /// The rest as a contact problem of its own, one component a pair, in `d_n - gap`.
    /// `zeros` are as many.
    pub fn reduced<'a>(&'a self, zeros: &'a [f64]) -> ContactProblem<'a> {
        ContactProblem::reduced(ContactData {
            dim: 1,
            pairs: self.kept.len(),
            stiffness: &self.matrix,
            ld: self.kept.len().max(1),
            load: &self.q,
            gap: zeros,
            friction: Friction::Coulomb(zeros),
            previous_slip: None,
        })
    }

    /// All displacements from `d_n - gap` of the kept ones.
    pub fn expand(&self, kept: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (&i, value) in self.kept.iter().zip(kept) {
            d[i] += value;
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
        let eta = |d: &[f64]| certificate::eta(problem, d, &problem.force(d));
        if eta(&better) < eta(&d) { better } else { d }
    }
}

/// Every obstacle touched, tangential components at their previous slip.
fn at_rest(problem: &ContactProblem<'_>) -> Vec<f64> {
    let mut d = Vec::with_capacity(problem.unknowns());
    for pair in 0..problem.pairs() {
        let gap = problem.gap(pair);
        d.push(if gap.is_finite() { gap } else { 0.0 });
        d.extend((0..problem.dim() - 1).map(|component| problem.previous_slip(pair, component)));
    }
    d
}

/// The factor of `K` on some of its rows, scaled to a unit diagonal.
struct Factor {
    rows: Vec<usize>,
    scale: Vec<f64>,
    inner: Semidefinite,
}

impl Factor {
    fn new(problem: &ContactProblem<'_>, rows: Vec<usize>) -> Option<Self> {
        let scale: Vec<f64> = rows.iter().map(|&i| problem.diagonal(i).sqrt().recip()).collect();
        let entry = |i: usize, j: usize| scale[i] * problem.column(rows[j])[rows[i]] * scale[j];
        let inner = Semidefinite::new(rows.len(), entry)?;
        Some(Factor { rows, scale, inner })
    }

    /// `M` on the rows `kept`.
    fn schur_complement(&self, problem: &ContactProblem<'_>, kept: &[usize]) -> Vec<f64> {
        self.inner.schur_complement(
            kept.len(),
            |i, j| self.scale[i] * problem.column(kept[j])[self.rows[i]],
            |i, j| problem.column(kept[j])[kept[i]],
        )
    }

    /// Adds to the independent rows of `d` what makes `K d = rhs` there, given `K d - rhs`.
    fn correct(&self, excess: &[f64], d: &mut [f64]) {
        let rows = self.inner.independent();
        let mut y: Vec<f64> = rows.iter().map(|&i| self.scale[i] * excess[self.rows[i]]).collect();
        self.inner.solve(&mut y);
        for (&i, y) in rows.iter().zip(&y) {
            d[self.rows[i]] -= self.scale[i] * y;
        }
    }

    /// Brings the rows into equilibrium with the loads; twice, for the last digits.
    fn equilibrate(&self, problem: &ContactProblem<'_>, d: &mut [f64]) {
        for _ in 0..2 {
            self.correct(&problem.force(d), d);
        }
    }

    /// Lets the rows follow a motion of the others without force.
    fn follow(&self, problem: &ContactProblem<'_>, motion: &mut [f64]) {
        for _ in 0..2 {
            let mut internal = problem.force(motion);
            for (internal, load) in internal.iter_mut().zip(problem.load()) {
                *internal += load;
            }
            self.correct(&internal, motion);
        }
    }

    /// A free motion of the rows on which the loads do work, if there is one.
    fn driven_motion(&self, problem: &ContactProblem<'_>, d: &[f64]) -> Option<Vec<f64>> {
        if self.inner.dependent().is_empty() {
            return None;
        }
        let force = problem.force(d);
        let mut motion = vec![0.0; problem.unknowns()];
        for &i in self.inner.dependent() {
            motion[self.rows[i]] = -force[self.rows[i]] * self.scale[i].powi(2);
        }
        let driven = largest(&motion) > 0.0;
        self.follow(problem, &mut motion);
        (driven && certificate::is_escape(problem, &motion)).then_some(motion)
    }
}
