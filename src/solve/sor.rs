//! Projected over-relaxed Gauss–Seidel in proximal form (Cryer, Christopherson; paper, section 2.2).
//!
//! A pair's normal displacement is relaxed and projected on `d_n <= gap`; its tangential one is
//! relaxed and shrunk towards rest, `delta <- shrink(delta + omega r_t / k_t, omega g / k_t)`, so
//! that a sticking pair is at rest exactly. With given thresholds each step lowers
//! `J(d) = d.K d / 2 - f.d + sum g |delta|` for `0 < omega < 2`, definite `K` or not.
//!
//! `K d - f` is carried along: an unknown that does not change costs nothing.

use crate::certificate;
use crate::law;
use crate::linalg::kernels::{self, Simd};
use crate::problem::ContactProblem;

/// An iterate with its force.
pub struct Iterate {
    /// Displacements.
    pub d: Vec<f64>,
    /// `K d - f`.
    pub force: Vec<f64>,
    normal_stiffness: Vec<f64>,
    tangential_stiffness: Vec<f64>,
    simd: Simd,
}

impl Iterate {
    /// Starts from `d`, made admissible.
    pub fn new(problem: &ContactProblem<'_>, mut d: Vec<f64>) -> Self {
        for pair in 0..problem.pairs() {
            let normal = &mut d[problem.dim() * pair];
            *normal = normal.min(problem.gap(pair));
        }
        let force = problem.force(&d);
        Iterate::with_force(problem, d, force)
    }

    /// Starts from `d`, whose force is known.
    pub fn with_force(problem: &ContactProblem<'_>, d: Vec<f64>, force: Vec<f64>) -> Self {
        let pairs = 0..problem.pairs();
        Iterate {
            d,
            force,
            normal_stiffness: pairs.clone().map(|i| problem.diagonal(problem.dim() * i)).collect(),
            tangential_stiffness: pairs.map(|i| problem.tangential_stiffness(i)).collect(),
            simd: Simd::new(),
        }
    }

    /// One sweep over all pairs. Under Coulomb's law the threshold follows the pressure within the
    /// sweep. Returns the change in the norm of the diagonal of `K`.
    pub fn sweep(&mut self, problem: &ContactProblem<'_>, omega: f64) -> f64 {
        kernels::vectorised(
            self.simd,
            #[inline(always)]
            || self.sweep_pairs(problem, omega),
        )
    }

    #[inline(always)]
    fn sweep_pairs(&mut self, problem: &ContactProblem<'_>, omega: f64) -> f64 {
        let dim = problem.dim();
        let mut change = 0.0;
        for pair in 0..problem.pairs() {
            let i = dim * pair;
            let (k_n, k_t) = (self.normal_stiffness[pair], self.tangential_stiffness[pair]);
            let normal = (self.d[i] - omega * self.force[i] / k_n).min(problem.gap(pair));
            let step_n = normal - self.d[i];
            self.d[i] = normal;
            let pressure = (-self.force[i] - k_n * step_n).max(0.0);

            let mut steps = [step_n, 0.0, 0.0];
            change += k_n * step_n * step_n;
            let bound = omega * problem.threshold(pair, pressure) / k_t;
            self.relax_slip(problem, pair, omega / k_t, bound, &mut steps[..dim]);
            for step in &steps[1..dim] {
                change += k_t * step * step;
            }
            self.add_columns(problem, i, &steps[..dim]);
        }
        change.sqrt()
    }

    /// Relaxes the tangential displacements of a pair after its normal step `steps[0]`, by
    /// `rate = omega / k_t` and shrinkage by `bound`, and puts their steps behind it.
    ///
    /// Steps come from forces, not from differences of displacements, so that small ones survive
    /// next to a large slip; a pair that sticks is at rest exactly.
    #[inline(always)]
    fn relax_slip(
        &mut self,
        problem: &ContactProblem<'_>,
        pair: usize,
        rate: f64,
        bound: f64,
        steps: &mut [f64],
    ) {
        let i = steps.len() * pair;
        let (normal, steps) = steps.split_at_mut(1);
        let coupling = &problem.column(i)[i + 1..];
        let mut trial = [0.0; 2];
        let trial = &mut trial[..steps.len()];
        for (c, step) in steps.iter_mut().enumerate() {
            *step = -rate * (self.force[i + 1 + c] + coupling[c] * normal[0]);
            trial[c] = self.d[i + 1 + c] - problem.reference_slip(pair, c) + *step;
        }
        let length = law::length(trial);
        for (c, step) in steps.iter_mut().enumerate() {
            let d = &mut self.d[i + 1 + c];
            if length > bound {
                *step -= bound * (trial[c] / length);
                *d += *step;
            } else {
                let rest = problem.reference_slip(pair, c);
                *step = rest - *d;
                *d = rest;
            }
        }
    }

    #[inline(always)]
    fn add_columns(&mut self, problem: &ContactProblem<'_>, first: usize, steps: &[f64]) {
        let mut moved = steps
            .iter()
            .enumerate()
            .filter(|(_, step)| **step != 0.0)
            .map(|(component, step)| (-step, problem.column(first + component)));
        while let Some(one) = moved.next() {
            match moved.next() {
                Some(two) => kernels::subtract2(&mut self.force, one, two),
                None => kernels::subtract(&mut self.force, one.0, one.1),
            }
        }
    }

    /// `eta` under `problem`'s law, from the carried force.
    pub fn eta(&self, problem: &ContactProblem<'_>) -> f64 {
        certificate::eta(problem, &self.d, &self.force)
    }

    /// Computes the force anew.
    pub fn refresh(&mut self, problem: &ContactProblem<'_>) {
        self.force = problem.force(&self.d);
    }
}
