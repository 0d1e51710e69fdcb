//! Definite problems that lead far: reference slips of millions of times what the loads ask for with coefficients to 1000,
//! rows that nearly coincide, coefficients next to none on ill-conditioned matrices, and given thresholds there. Each has
//! a solution, and the default finds it, measured in twice the precision.

use crate::common::exact::eta;
use crate::common::problems::{Case, Law, definite, loaded, uniform, vector};
use crate::common::quad::Quad;
use fastrand::Rng;
use signorini::{Settings, Status};

fn power(rng: &mut Rng, low: f64, high: f64) -> f64 {
    10_f64.powf(uniform(rng, low, high))
}

fn assert_solved(case: &Case) {
    let settings = Settings::default();
    let solution = case.solve(&settings);
    assert_eq!(solution.status, Status::Solved, "{case:?}: {}", solution.message);
    let d: Vec<Quad> =
        solution.d.iter().zip(&solution.d_low).map(|(&d, &low)| Quad::sum(d, low)).collect();
    let residual = eta(case, &d);
    assert!(residual <= settings.tolerance, "{case:?}: {residual:e}");
}

/// One pair on a matrix of condition number 1500, its reference slip up to 1e6 of the displacement that solves it.
#[test]
fn a_large_reference_slip_with_large_friction_is_solved() {
    #[rustfmt::skip]
    let k = vec![1.3, -0.0664, -0.233, -0.0664, 0.0106, 0.0142, -0.233, 0.0142, 0.0435];
    for slip in [-1.86e6, -1.86e5, -1.86e4] {
        assert_solved(&Case {
            dim: 3,
            pairs: 1,
            k: k.clone(),
            f: vec![1.52, -0.359, 1.38],
            gap: vec![0.0],
            law: Law::Coulomb(vec![1000.0]),
            slip: Some(vec![-0.746, slip]),
        });
    }
    let mut rng = Rng::with_seed(1);
    for round in 0..400 {
        let (dim, pairs) = (2 + round % 2, rng.usize(1..=4));
        let condition = power(&mut rng, 0.0, 5.0);
        let k = definite(&mut rng, dim * pairs, condition);
        let law = Law::Coulomb(vec![power(&mut rng, 0.0, 3.0); pairs]);
        let mut case = loaded(&mut rng, dim, k, law);
        let slips = vector(&mut rng, (dim - 1) * pairs);
        case.slip = Some(slips.iter().map(|slip| slip * power(&mut rng, 0.0, 7.0)).collect());
        assert_solved(&case);
    }
}

/// One or two pairs that stand twice, tied by springs of 1e-9 to 1e-7: condition numbers to 1e10.
#[test]
fn rows_that_nearly_coincide_are_solved() {
    let mut rng = Rng::with_seed(2);
    for round in 0..200 {
        let dim = 2 + round % 2;
        let m = dim * rng.usize(1..=2);
        let (once, n, spring) = (definite(&mut rng, m, 10.0), 2 * m, power(&mut rng, -9.0, -7.0));
        let mut k: Vec<f64> =
            (0..n * n).map(|at| once[at % n % m + m * (at / n % m)] / 4.0).collect();
        for i in 0..n {
            k[i + n * i] += spring;
            k[i + n * ((i + m) % n)] -= spring;
        }
        let law = Law::Coulomb(vec![uniform(&mut rng, 0.1, 1.5); n / dim]);
        let mut case = loaded(&mut rng, dim, k, law);
        case.gap.fill(0.0);
        assert_solved(&case);
    }
}

/// Condition numbers to 1e10 with coefficients down to 1e-9, or with given thresholds.
#[test]
fn little_friction_and_thresholds_are_solved_on_ill_conditioned_matrices() {
    let mut rng = Rng::with_seed(3);
    for round in 0..400 {
        let (dim, pairs) = (2 + round % 2, rng.usize(1..=4));
        let condition = power(&mut rng, 6.0, 10.0);
        let k = definite(&mut rng, dim * pairs, condition);
        let law = match round % 4 < 2 {
            true => Law::Coulomb(vec![power(&mut rng, -9.0, 0.0); pairs]),
            false => Law::Tresca(vec![power(&mut rng, -6.0, 2.0); pairs]),
        };
        assert_solved(&loaded(&mut rng, dim, k, law));
    }
}
