//! Equilibrium of some components while the others are held.

use crate::linalg::dense::Semidefinite;
use crate::problem::ContactProblem;

/// The factor of `K` on some of its rows, scaled to a unit diagonal.
pub struct Factor {
    rows: Vec<usize>,
    scale: Vec<f64>,
    inner: Semidefinite,
}

impl Factor {
    /// Factorises; `None` if the rows are not positive semi-definite.
    pub fn new(problem: &ContactProblem<'_>, rows: Vec<usize>) -> Option<Self> {
        let scale: Vec<f64> = rows.iter().map(|&i| problem.diagonal(i).sqrt().recip()).collect();
        let entry = |i: usize, j: usize| scale[i] * problem.column(rows[j])[rows[i]] * scale[j];
        let inner = Semidefinite::new(rows.len(), entry)?;
        Some(Factor { rows, scale, inner })
    }

    /// Rows that depend on the others.
    pub fn dependent(&self) -> impl Iterator<Item = usize> {
        self.inner.dependent().iter().map(|&i| self.rows[i])
    }

    /// Schur complement of `K` on the rows `kept`, column-major.
    pub fn schur_complement(&self, problem: &ContactProblem<'_>, kept: &[usize]) -> Vec<f64> {
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

    /// Brings the independent rows into equilibrium with the loads; twice, for the last digits.
    pub fn equilibrate(&self, problem: &ContactProblem<'_>, d: &mut [f64]) {
        for _ in 0..2 {
            self.correct(&problem.force(d), d);
        }
    }

    /// Lets the independent rows follow a motion of all others without force.
    pub fn follow(&self, problem: &ContactProblem<'_>, motion: &mut [f64]) {
        for _ in 0..2 {
            self.correct(&problem.internal_force(motion), motion);
        }
    }
}
