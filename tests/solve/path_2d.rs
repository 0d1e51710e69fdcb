//! The linear path in the plane, alone and behind the default: every positive definite problem has a
//! solution, and the path leads to one whatever the coefficients, loads, gaps and slips.

use crate::common::beam::beam;
use crate::common::measures::{eta, rounding};
use crate::common::plane_families::{SUPPORTS, Structure, Support};
use crate::common::problems::{
    Case, Law, block, cohesive, definite, frictionless, loaded, tresca, uniform, vector,
};
use fastrand::Rng;
use signorini::{Method, Settings, Status};

const TOLERANCE: f64 = 1e-10;

/// Solves the problem by one method, and measures the answer here. `mu` carries errors of the pressures
/// into the friction.
fn assert_solved(case: &Case, method: Method, context: &str) -> u64 {
    let settings = Settings { method, tolerance: TOLERANCE, ..Settings::default() };
    let solution = case.solve(&settings);
    assert_eq!(solution.status, Status::Solved, "{context}: {}", solution.message);
    let most = match &case.law {
        Law::Coulomb(mu) => mu.iter().fold(1.0, |most: f64, mu| most.max(*mu)),
        Law::Tresca(_) => 1.0,
        law => law.values().iter().step_by(3).fold(1.0, |most: f64, mu| most.max(*mu)),
    };
    let residual = eta(case, &solution.d);
    let allowed = TOLERANCE + most * rounding(case, &solution.d);
    assert!(residual <= allowed, "{context}: {residual:e}");
    solution.iterations
}

/// Random dense stiffness: nothing local is safe on it.
#[test]
fn the_path_alone_solves_random_dense_problems() {
    for (pairs, count) in [(5, 40), (20, 25)] {
        for condition in [1e2, 1e4] {
            for mu in [0.3, 1.0, 3.0, 10.0] {
                let mut most = 0;
                for seed in 0..count {
                    let mut rng = Rng::with_seed(seed);
                    let k = definite(&mut rng, 2 * pairs, condition);
                    let law = match seed % 2 {
                        0 => Law::Coulomb(vec![mu; pairs]),
                        _ => Law::Coulomb((0..pairs).map(|_| uniform(&mut rng, 0.1, mu)).collect()),
                    };
                    let mut case = loaded(&mut rng, 2, k, law);
                    if seed % 3 == 0 {
                        case.slip = Some(vector(&mut rng, pairs));
                    }
                    let context = format!("seed {seed}, {pairs} pairs, {condition:e}, mu {mu}");
                    most = most.max(assert_solved(&case, Method::Path, &context));
                }
                println!("{pairs} pairs, condition {condition:e}, mu {mu}: at most {most}");
            }
        }
    }
}

/// A thick beam on a floor, clamped at both ends, its pairs pushed at random: Newton's method and short walks end nowhere, and the path
/// from a start that no other shares its loads with arrives, as theorem H says, after tens of events for each pair.
#[test]
fn long_paths_arrive() {
    let (pairs, mut most) = (80, 0);
    for seed in 0..12 {
        let mut rng = Rng::with_seed(seed);
        let f = vector(&mut rng, 2 * pairs).iter().map(|push| push + 0.3).collect();
        let (gap, law) = (vec![0.0; pairs], Law::Coulomb(vec![3.0; pairs]));
        let case = Case { dim: 2, pairs, k: beam(pairs, 0.2), f, gap, law, slip: None };
        let context = format!("seed {seed}");
        most = most.max(assert_solved(&case, Method::Path, &context));
        assert_solved(&case, Method::Auto, &context);
    }
    // With as many events for each pair as of other bodies nothing would be shown.
    assert!(most > 20 * pairs as u64, "{most}");
}

/// Cohesion and tension shift forces and bounds; the theorems hold as they are.
#[test]
fn the_path_alone_solves_problems_with_cohesion() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=20);
        let k = definite(&mut rng, 2 * pairs, [1e1, 1e3][seed as usize % 2]);
        let law = cohesive(&mut rng, pairs, 3.0);
        let case = loaded(&mut rng, 2, k, law);
        assert_solved(&case, Method::Path, &format!("seed {seed}"));
    }
}

/// Given thresholds: one solution, and `s` never turns back.
#[test]
fn the_path_alone_solves_problems_with_given_thresholds() {
    for seed in 0..302 {
        let mut rng = Rng::with_seed(seed);
        // Above 200 pairs the walk keeps columns for the changes to come.
        let pairs = if seed < 300 { rng.usize(1..=30) } else { 220 };
        let k = definite(&mut rng, 2 * pairs, 1e4);
        let law = tresca(&mut rng, pairs);
        let case = loaded(&mut rng, 2, k, law);
        assert_solved(&case, Method::Path, &format!("seed {seed}, {pairs} pairs"));
    }
}

/// Without friction no event turns back either.
#[test]
fn the_path_alone_solves_problems_without_friction() {
    for seed in 0..200 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=30);
        let k = definite(&mut rng, 2 * pairs, 1e4);
        let case = loaded(&mut rng, 2, k, frictionless(pairs));
        assert_solved(&case, Method::Path, &format!("seed {seed}, {pairs} pairs"));
    }
}

fn on_mesh(structure: &Structure, seed: u64) -> (Case, String) {
    let case = structure.case(&mut Rng::with_seed(seed));
    let problem = Case {
        dim: 2,
        pairs: structure.pairs,
        k: structure.stiffness.clone(),
        f: case.load,
        gap: case.gap,
        law: Law::Coulomb(case.mu),
        slip: case.slip,
    };
    (problem, format!("seed {seed}, {}", case.name))
}

/// Meshes on four supports, two of them with a rigid motion that contact alone stops.
fn solves_all_on_meshes(method: Method, pairs: usize, seeds: std::ops::Range<u64>) {
    for support in SUPPORTS {
        let structure = Structure::new(support, pairs);
        let mut most = 0;
        for seed in seeds.clone() {
            let (case, context) = on_mesh(&structure, seed);
            most = most.max(assert_solved(&case, method, &context));
        }
        println!("{support:?}, {pairs} pairs: at most {most}");
    }
}

#[test]
fn the_path_alone_solves_problems_on_meshes() {
    solves_all_on_meshes(Method::Path, 33, 0..60);
    solves_all_on_meshes(Method::Path, 65, 60..90);
}

#[test]
fn the_default_solves_problems_on_meshes() {
    solves_all_on_meshes(Method::Auto, 33, 0..80);
    solves_all_on_meshes(Method::Auto, 129, 80..110);
}

/// A body on a roller whose loads lift it by a hundredth more than they press it down: no equilibrium,
/// and the ray on which the path ends proves it.
#[test]
fn the_path_proves_that_a_lifted_body_has_no_equilibrium() {
    let structure = Structure::new(Support::Roller, 33);
    for seed in 0..20 {
        let (mut case, context) = on_mesh(&structure, seed);
        let pressed: f64 = case.f.iter().step_by(2).sum();
        let n = case.f.len();
        // The normal points down: a negative load lifts.
        case.f[n - 2] -= 1.01 * pressed;
        let settings = Settings { method: Method::Path, ..Settings::default() };
        let solution = case.solve(&settings);
        assert_eq!(solution.status, Status::NoEquilibrium, "{context}: {}", solution.message);
    }
}

/// Coulomb: a block that nothing else holds rests while it is pushed by less than `mu N`, and slides
/// away when it is pushed by more. The ray shows the motion.
#[test]
fn the_path_finds_the_friction_angle_of_a_loose_block() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(3..=10);
        let mu = uniform(&mut rng, 0.05, 1.0);
        let press: Vec<f64> = (0..pairs).map(|_| uniform(&mut rng, 0.9, 1.1)).collect();
        let push = mu * press.iter().sum::<f64>() / pairs as f64;
        let k = block(&mut rng, pairs);
        for (ratio, status) in
            [(0.5, Status::Solved), (0.999, Status::Solved), (1.001, Status::NoEquilibrium)]
        {
            let case = Case {
                dim: 2,
                pairs,
                k: k.clone(),
                f: press.iter().flat_map(|press| [*press, ratio * push]).collect(),
                gap: vec![0.0; pairs],
                law: Law::Coulomb(vec![mu; pairs]),
                slip: None,
            };
            let solution = case.solve_by(Method::Path);
            let context = format!("seed {seed}, mu {mu}, {ratio}: {}", solution.message);
            assert_eq!(solution.status, status, "{context}");
        }
    }
}
