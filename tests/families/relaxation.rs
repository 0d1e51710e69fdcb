//! The over-relaxation factor that the solver chooses, beside fixed ones. Counts, not times.

use signorini::{
    ContactData, ContactProblem, FrictionLaw, Method, Monitor, Settings, Solution, Status, solve,
};

struct Case {
    bar: crate::bar::Condensed,
    gap: Vec<f64>,
    mu: Vec<f64>,
}

impl Case {
    /// The frictionless bar on 1025 pairs, a third of which a wavy obstacle leaves open.
    fn frictionless() -> Self {
        let bar = crate::bar::bar(1024, 10, 1.5, 10.0);
        let waves = 3.0 * std::f64::consts::TAU / (bar.pairs - 1) as f64;
        let gap = (0..bar.pairs).map(|i| 2e-3 * (1.0 - (i as f64 * waves).cos())).collect();
        Case { mu: vec![0.0; bar.pairs], gap, bar }
    }

    fn with_law(mu: f64) -> Self {
        let bar = crate::bar::bar(128, 8, 1.6, 10.0);
        Case { mu: vec![mu; bar.pairs], gap: vec![0.0; bar.pairs], bar }
    }

    fn sweeps(&self, settings: &Settings) -> u64 {
        let solution = self.solve(settings);
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        solution.iterations
    }

    fn solve(&self, settings: &Settings) -> Solution {
        let problem = ContactProblem::new(ContactData {
            dim: 2,
            pairs: self.bar.pairs,
            stiffness: &self.bar.stiffness,
            ld: 2 * self.bar.pairs,
            load: &self.bar.load,
            gap: &self.gap,
            law: FrictionLaw::Coulomb(&self.mu),
            reference_slip: None,
        })
        .unwrap();
        solve(&problem, settings, None, &mut Monitor::new(settings, None)).unwrap()
    }

    fn compare(&self, settings: &Settings, fixed: &[f64]) -> (u64, u64) {
        let chosen = self.sweeps(settings);
        let best = fixed
            .iter()
            .map(|&omega| self.solve(&Settings { omega, max_iterations: 5000, ..settings.clone() }))
            .filter(|solution| solution.status == Status::Solved)
            .map(|solution| solution.iterations)
            .min()
            .expect("one of the fixed factors converges");
        (chosen, best)
    }
}

/// 250 sweeps where the best fixed factor takes about 170 and Gauss–Seidel about 2000.
#[test]
fn frictionless_1025_pairs_take_at_most_250_sweeps() {
    let settings = Settings { method: Method::SorNested, tolerance: 1e-8, ..Settings::default() };
    let (chosen, best) = Case::frictionless().compare(&settings, &[1.8, 1.85, 1.9]);
    assert!(chosen <= 250, "{chosen} sweeps, the best fixed factor takes {best}");
}

/// Measuring costs sweeps, and friction changes the rate while it is measured: twice the best fixed
/// factor's count is what it may cost.
#[test]
fn friction_takes_at_most_twice_the_best_fixed_factor() {
    for (method, mu) in [
        (Method::SorNested, 0.3),
        (Method::SorNested, 1.0),
        (Method::SorNested, 3.0),
        (Method::SorDiagonal, 0.3),
        (Method::SorDiagonal, 1.0),
    ] {
        let settings = Settings { method, ..Settings::default() };
        let (chosen, best) = Case::with_law(mu).compare(&settings, &[1.0, 1.3, 1.5, 1.6, 1.7, 1.8]);
        assert!(chosen <= 2 * best, "{method:?}, mu {mu}: {chosen} sweeps, fixed {best}");
    }
}

/// The paper's fixed point on this bar grows by mu |beta| = 0.375 mu a step (Dundurs' constant of
/// nu = 0.2 on a rigid obstacle), so that mu = 5 needs the damping: without it the budget ends.
#[test]
fn damping_goes_beyond_the_paper() {
    let case = Case::with_law(5.0);
    let damped = Settings { method: Method::SorNested, ..Settings::default() };
    assert!(case.sweeps(&damped) < 5000);
    let undamped = Settings { damping: 1.0, max_iterations: 20_000, ..damped };
    assert_eq!(case.solve(&undamped).status, Status::IterationLimit);
}
