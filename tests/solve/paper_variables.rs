//! The paper's own form of two bodies (section 3), projected SOR in `(u_A, d)`, against the fully
//! reduced one in `d` alone.
//!
//! The system `[[K_A + K_B, -K_B], [-K_B, K_B]]` with loads `(f_A - f_B, f_B)` is a contact problem of
//! twice as many pairs: those of `u_A` have no obstacle and no friction.

use crate::common::problems::{Case, Law, definite, vector};
use fastrand::Rng;
use signorini::{FrictionLaw, LoadCase, Method, Model, Monitor, Settings, Status};

#[test]
fn sor_in_the_papers_variables_agrees_with_the_reduced_problem() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=6));
        let n = dim * pairs;
        let (k_a, k_b) = (definite(&mut rng, n, 30.0), definite(&mut rng, n, 30.0));
        let (f_a, f_b) = (vector(&mut rng, n), vector(&mut rng, n));
        let gap: Vec<f64> = (0..pairs).map(|_| 0.1 * rng.f64()).collect();
        let mu: Vec<f64> = (0..pairs).map(|_| 0.3 * rng.f64()).collect();

        let mut k = vec![0.0; 4 * n * n];
        for j in 0..n {
            for i in 0..n {
                let (a, b) = (k_a[i + n * j], k_b[i + n * j]);
                k[i + 2 * n * j] = a + b;
                k[n + i + 2 * n * j] = -b;
                k[i + 2 * n * (n + j)] = -b;
                k[n + i + 2 * n * (n + j)] = b;
            }
        }
        let difference = f_a.iter().zip(&f_b).map(|(a, b)| a - b);
        let whole = Case {
            dim,
            pairs: 2 * pairs,
            k,
            f: difference.chain(f_b.iter().copied()).collect(),
            gap: vec![f64::INFINITY; pairs].into_iter().chain(gap.clone()).collect(),
            law: Law::Coulomb(vec![0.0; pairs].into_iter().chain(mu.clone()).collect()),
            slip: None,
        };
        let model = Model::two_body(dim, pairs, (&k_a, n), (&k_b, n)).unwrap();
        let load = [f_a, f_b].concat();
        let case = LoadCase {
            load: &load,
            prescribed: None,
            gap: &gap,
            law: FrictionLaw::Coulomb(&mu),
            reference_slip: None,
        };
        for method in [Method::SorNested, Method::SorDiagonal] {
            let settings = Settings { method, tolerance: 1e-12, ..Settings::default() };
            let paper = whole.solve(&settings);
            let reduced =
                model.solve(&case, &settings, None, &mut Monitor::new(&settings, None)).unwrap();
            assert_eq!(paper.status, Status::Solved, "seed {seed}: {}", paper.message);
            assert_eq!(reduced.status, Status::Solved, "seed {seed}: {}", reduced.message);
            let recovered = model.recover(Some(&load), None, &reduced.d).unwrap();
            // eta 1e-12 times condition numbers of some hundreds.
            let close = |a: f64, b: f64| (a - b).abs() <= 1e-8;
            assert!(paper.d[n..].iter().zip(&reduced.d).all(|(a, b)| close(*a, *b)), "{seed}");
            assert!(paper.d[..n].iter().zip(&recovered).all(|(a, b)| close(*a, *b)), "{seed}");
            let forces = &paper.certificate.force[n..];
            let same = forces.iter().zip(&reduced.certificate.force).all(|(a, b)| close(*a, *b));
            assert!(same, "seed {seed}");
        }
    }
}
