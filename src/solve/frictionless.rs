//! Frictionless contact by Lemke's method (paper, section 2.2).
//!
//! Tangential components, and normal ones without an obstacle, carry no contact force and are
//! eliminated: `p = q + M w` in the openings `w = gap - d_n >= 0` and the pressures `p = -F_n >= 0`,
//! with the Schur complement `M`. `K` may be singular: components that depend on others through a
//! free motion are set aside, and no singular block is inverted. A load that drives such a motion
//! has no equilibrium, and neither has one that ends Lemke's path in a ray.

use super::lemke::{Path, lemke};
use super::{Candidate, Ending};
use crate::certificate::{self, certify};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::linalg::dense::Semidefinite;
use crate::linalg::small::largest;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Solves a problem whose friction is zero. The start does not matter.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let (kept, eliminated): (Vec<usize>, Vec<usize>) = (0..problem.unknowns())
        .partition(|i| i % problem.dim() == 0 && problem.gap(i / problem.dim()).is_finite());
    let mut d = at_rest(problem);
    let Some(factor) = Factor::new(problem, &eliminated) else {
        return Ok(Candidate::stalled(d, NOT_SEMIDEFINITE));
    };
    factor.equilibrate(problem, &mut d);
    if let Some(motion) = factor.driven_motion(problem, &d) {
        return Ok(Candidate::ended(d, Ending::Escape(motion)));
    }
    let matrix = factor.inner.schur_complement(
        kept.len(),
        |i, j| factor.scale[i] * problem.column(kept[j])[eliminated[i]],
        |i, j| problem.column(kept[j])[kept[i]],
    );
    let force = problem.force(&d);
    let q: Vec<f64> = kept.iter().map(|&i| -force[i]).collect();
    let scale: Vec<f64> = kept.iter().map(|&i| problem.diagonal(i).sqrt().recip()).collect();
    let covering: Vec<f64> = scale.iter().map(|scale| scale.recip()).collect();
    let lcp = Lcp::new(kept.len(), &matrix, kept.len().max(1), &q, Some(&covering))?;
    let run = lemke(&lcp, &scale, monitor)?;
    let ending = match run.path {
        Path::Solution => Ending::Done,
        Path::Interrupted(reason) => Ending::Interrupted(reason),
        Path::Breakdown => Ending::Stalled("rounding made Lemke's basis singular"),
        Path::Ray(ray) => {
            let mut motion = vec![0.0; problem.unknowns()];
            for (&i, ray) in kept.iter().zip(ray) {
                motion[i] = -ray;
            }
            factor.follow(problem, &mut motion);
            Ending::Escape(motion)
        }
    };
    let closed: Vec<bool> = run.z.iter().map(|&opening| opening == 0.0).collect();
    for (&i, opening) in kept.iter().zip(&run.z) {
        d[i] = problem.gap(i / problem.dim()) - opening;
    }
    factor.equilibrate(problem, &mut d);
    if ending == Ending::Done && !certify(problem, &d).holds(settings.tolerance) {
        d = polished(problem, &kept, &closed, d);
    }
    Ok(Candidate { refactorisations: run.refactorisations, ..Candidate::ended(d, ending) })
}

const NOT_SEMIDEFINITE: &str = "K is not positive semi-definite";

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

/// Solves once more for equilibrium of all components but the closed normals.
fn polished(
    problem: &ContactProblem<'_>,
    kept: &[usize],
    closed: &[bool],
    d: Vec<f64>,
) -> Vec<f64> {
    let mut is_free = vec![true; problem.unknowns()];
    for (&i, &closed) in kept.iter().zip(closed) {
        is_free[i] = !closed;
    }
    let free: Vec<usize> = (0..problem.unknowns()).filter(|&i| is_free[i]).collect();
    let Some(factor) = Factor::new(problem, &free) else { return d };
    let mut better = d.clone();
    factor.equilibrate(problem, &mut better);
    for &i in kept {
        better[i] = better[i].min(problem.gap(i / problem.dim()));
    }
    let eta = |d: &[f64]| certificate::eta(problem, d, &problem.force(d));
    if eta(&better) < eta(&d) { better } else { d }
}

/// The factor of `K` on some of its rows, scaled to a unit diagonal.
struct Factor<'a> {
    rows: &'a [usize],
    scale: Vec<f64>,
    inner: Semidefinite,
}

impl<'a> Factor<'a> {
    fn new(problem: &ContactProblem<'_>, rows: &'a [usize]) -> Option<Self> {
        let scale: Vec<f64> = rows.iter().map(|&i| problem.diagonal(i).sqrt().recip()).collect();
        let entry = |i: usize, j: usize| scale[i] * problem.column(rows[j])[rows[i]] * scale[j];
        let inner = Semidefinite::new(rows.len(), entry)?;
        Some(Factor { rows, scale, inner })
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
