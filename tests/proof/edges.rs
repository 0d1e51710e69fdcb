//! Statements where doubles end: other solutions with zero loads and of grazing pairs, proofs of a bound that nearly
//! vanishes.

use crate::common::problems::{Case, Law, coulomb, definite, uniform};
use fastrand::Rng;
use signorini::{Existence, Search, Settings, State, Status, Uniqueness};

fn searching() -> Settings {
    Settings { search: Search::Others, ..Settings::default() }
}

/// Without loads, with gaps that are not negative and no reference slip, `d = 0` is the only solution whatever the
/// friction: `d . K d = d . F = sum F_n gap + F_t . d_t <= 0`.
fn is_said_to_be_alone(case: &Case) {
    let solution = case.solve(&searching());
    assert_eq!(solution.status, Status::Solved, "{case:?}: {}", solution.message);
    assert!(solution.d.iter().all(|&d| d == 0.0), "{case:?}: {:?}", solution.d);
    assert_ne!(solution.uniqueness, Uniqueness::Several, "{case:?}: {:?}", solution.second);
}

#[test]
fn without_loads_there_is_one_solution() {
    let k = vec![1.07, 0.15, -0.44, 0.15, 0.23, -0.04, -0.44, -0.04, 6.38];
    let law = Law::Coulomb(vec![0.5]);
    is_said_to_be_alone(&Case {
        dim: 3,
        pairs: 1,
        k,
        f: vec![0.0; 3],
        gap: vec![1.0],
        law,
        slip: None,
    });
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=4));
        let condition = 10_f64.powf(uniform(&mut rng, 0.0, 6.0));
        let k = definite(&mut rng, dim * pairs, condition);
        let most = 10_f64.powf(uniform(&mut rng, -1.0, 3.0));
        let law = coulomb(&mut rng, pairs, most);
        let gap = (0..pairs).map(|_| [0.0, 1.0, 1e-300, rng.f64()][rng.usize(0..4)]).collect();
        let f = vec![0.0; dim * pairs];
        is_said_to_be_alone(&Case { dim, pairs, k, f, gap, law, slip: None });
    }
}

/// The exact sign of `a b - c d`, by products as integers: mantissas of 53 bits, exponents that lie close.
fn sign_of_difference(a: f64, b: f64, c: f64, d: f64) -> i32 {
    let parts = |x: f64| {
        let bits = x.abs().to_bits();
        let mantissa = (bits & ((1 << 52) - 1)) | (1 << 52);
        (mantissa as i128 * x.signum() as i128, (bits >> 52) as i32)
    };
    let product = |x: f64, y: f64| {
        let ((m, e), (n, f)) = (parts(x), parts(y));
        (m * n, e + f)
    };
    let ((left, e), (right, f)) = (product(a, b), product(c, d));
    // Products have at most 106 bits: 20 more are there.
    assert!((e - f).abs() < 20, "the products are of different sizes");
    let (left, right) = match e >= f {
        true => (left << (e - f), right),
        false => (left, right << (f - e)),
    };
    (left - right).signum() as i32
}

/// One pair in the plane, gap 0, whose free solution touches its obstacle up to rounding of the loads:
/// `d_n det K = f_n K_tt - f_t K_nt`. It is a solution, open, if that is not positive, which integers decide.
fn an_open_second_is_open(case: &Case) -> (bool, bool) {
    let penetrates = sign_of_difference(case.f[0], case.k[3], case.f[1], case.k[2]) > 0;
    let solution = case.solve(&searching());
    assert_eq!(solution.status, Status::Solved, "{case:?}: {}", solution.message);
    let is_open = |state: &State| *state == State::Open;
    let states = solution.second.iter().flat_map(|second| &second.certificate.states);
    let said = solution.uniqueness == Uniqueness::Several;
    if said && penetrates {
        let all = states.chain(&solution.certificate.states);
        assert!(!all.into_iter().any(is_open), "{case:?}: {:?}", solution.second);
    }
    (said, penetrates)
}

#[test]
fn a_pair_that_grazes_its_obstacle_is_no_second_solution() {
    let one = |k: Vec<f64>, f: Vec<f64>, mu: f64| Case {
        dim: 2,
        pairs: 1,
        k,
        f,
        gap: vec![0.0],
        law: Law::Coulomb(vec![mu]),
        slip: None,
    };
    let (k_nt, k_tt) = (-245.3354639771412, 36.21073858954927);
    let k = vec![1742.082687923819, k_nt, k_nt, k_tt];
    an_open_second_is_open(&one(k, vec![176.22193876064927, -26.009800844773032], 1.0));
    let mut counts = [0; 2];
    for seed in 0..4000 {
        let mut rng = Rng::with_seed(seed);
        let k = definite(&mut rng, 2, 1e4);
        let f_t = uniform(&mut rng, 0.5, 2.0) * if rng.bool() { 1.0 } else { -1.0 };
        let exact = f_t * k[2] / k[3];
        let f_n = f64::from_bits(exact.to_bits() + rng.u64(0..5) - 2);
        let mu = uniform(&mut rng, 0.5, 20.0);
        let (said, penetrates) = an_open_second_is_open(&one(k, vec![f_n, f_t], mu));
        counts[0] += usize::from(said);
        counts[1] += usize::from(penetrates);
    }
    println!("several, penetrating: {counts:?}");
    assert!(counts[1] > 1000, "the free solution nearly never penetrates");
}

/// A pair that is never closed carries the tension `a` and friction up to `b - mu a` of the cohesive law, here 1.1e-16, in
/// which a product of doubles rounded before the difference loses all: the pair sticks, `F_t = -f_t`.
#[test]
fn a_bound_that_nearly_vanishes_is_none_that_vanishes() {
    let law = Law::Cohesive(vec![5.0, 2.7677695733867043, 0.5535539146773408]);
    let (k, f, gap) = (vec![2.0, 0.0, 0.0, 1.0], vec![0.1, 5e-17], vec![f64::INFINITY]);
    let case = Case { dim: 2, pairs: 1, k, f, gap, law, slip: None };
    let solution = case.solve(&Settings { proof: true, ..Settings::default() });
    assert_eq!(solution.status, Status::Solved, "{}", solution.message);
    assert!((solution.certificate.force[1] + 5e-17).abs() <= 1e-32, "{:?}", solution.certificate);
    if let Existence::Proved(proof) = &solution.existence {
        let radius = proof.force_radius_about(&solution.certificate.force);
        assert!((solution.certificate.force[1] + 5e-17).abs() <= radius[1], "{radius:?}");
        assert!(solution.d[1].abs() <= proof.radius_about(&solution.d)[1]);
    }
}
