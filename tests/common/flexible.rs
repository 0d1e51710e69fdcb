//! Problems in flexibility form on arrays of their own, and a judge of their solutions in twice the precision.

use signorini::{
    FlexibilityData, FlexibilityProblem, FrictionLaw, Monitor, Settings, Solution, Status,
    Uniqueness, solve_flexibility,
};

use super::dense::{dot, largest};
use super::quad::Quad;

/// A problem on arrays of its own, with Coulomb's friction.
pub struct Case {
    pub dim: usize,
    pub w: Vec<f64>,
    pub q: Vec<f64>,
    pub gap: Vec<f64>,
    pub mu: Vec<f64>,
    pub slip0: Vec<f64>,
}

impl Case {
    /// With gaps and slips of zero, and one coefficient of friction.
    pub fn new(dim: usize, w: Vec<f64>, q: Vec<f64>, mu: f64) -> Case {
        let pairs = q.len() / dim;
        let slip0 = vec![0.0; q.len() - pairs];
        Case { dim, w, q, gap: vec![0.0; pairs], mu: vec![mu; pairs], slip0 }
    }

    pub fn data(&self) -> FlexibilityData<'_> {
        FlexibilityData {
            dim: self.dim,
            pairs: self.gap.len(),
            flexibility: (&self.w, self.q.len().max(1)),
            free: &self.q,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: Some(&self.slip0),
        }
    }

    pub fn solve(&self) -> Solution {
        let problem = FlexibilityProblem::from_flexibility(self.data()).expect("valid data");
        let settings = Settings::default();
        let monitor = &mut Monitor::new(&settings, None);
        let solution = solve_flexibility(&problem, &settings, None, monitor).expect("valid data");
        assert_eq!(solution.uniqueness, Uniqueness::NotKnown);
        solution
    }

    /// The solution, which must be certified and pass the judge.
    pub fn solved(&self) -> Solution {
        let solution = self.solve();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let error = self.judged(&solution.d, &solution.certificate.force);
        // The library's tolerance is 1e-10 of norms; the unit of its tangents is up to half of the judge's.
        assert!(error <= 1e-9, "{error:e}");
        solution
    }

    /// The residual of the relation and of the law in twice the precision, the largest of all components, in
    /// forces by the unit `1 / W_nn` or one over the largest entry on the diagonal of the tangents; relative to
    /// the largest such force that would undo a free displacement, or to that of the contact.
    pub fn judged(&self, d: &[f64], force: &[f64]) -> f64 {
        let (n, dim) = (d.len(), self.dim);
        let (mut worst, mut size) = (Quad::ZERO, largest(force));
        for pair in 0..self.gap.len() {
            let (first, slips) = (dim * pair, (dim - 1) * pair);
            let flexible = |i: usize| self.w[(first + i) * (n + 1)];
            let [normal, tangent] = [flexible(0), (1..dim).map(flexible).fold(0.0, f64::max)];
            let v: Vec<Quad> = (first..first + dim).map(|i| self.caused(i, force)).collect();
            for (i, v) in v.iter().enumerate() {
                let unit = 1.0 / if i == 0 { normal } else { tangent };
                worst = worst.max((*v - Quad::from(d[first + i])).abs() * unit);
                size = size.max(self.q[first + i].abs() * unit);
            }
            let opening = (v[0] - Quad::from(self.gap[pair])) * (1.0 / normal);
            worst = worst.max(opening.max(Quad::from(force[first])).abs());
            let slip = |i: usize| (v[i] - Quad::from(self.slip0[slips + i - 1])) * (1.0 / tangent);
            let delta: Vec<Quad> = (1..dim).map(slip).collect();
            let trial: Vec<Quad> =
                (1..dim).map(|i| delta[i - 1] - Quad::from(force[first + i])).collect();
            let length = trial.iter().map(|t| *t * *t).sum::<Quad>().sqrt();
            let bound = Quad::product(self.mu[pair], f64::max(0.0, -force[first]));
            for (delta, trial) in delta.iter().zip(&trial) {
                let shrunk =
                    if length <= bound { Quad::ZERO } else { *trial * ((length - bound) / length) };
                worst = worst.max((*delta - shrunk).abs());
            }
        }
        worst.value() / size.max(f64::MIN_POSITIVE)
    }

    /// Component `i` of `W F + q`.
    fn caused(&self, i: usize, force: &[f64]) -> Quad {
        let n = force.len();
        let terms = (0..n).map(|j| Quad::product(self.w[i + n * j], force[j]));
        terms.sum::<Quad>() + Quad::from(self.q[i])
    }
}

/// `B Bᵀ` of a matrix with the given rows.
pub fn gram(rows: &[Vec<f64>]) -> Vec<f64> {
    rows.iter().flat_map(|a| rows.iter().map(|b| dot(a, b))).collect()
}
