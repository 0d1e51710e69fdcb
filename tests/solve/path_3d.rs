//! The path in space, forced: it solves what Newton's method would, and in how many linear systems; it
//! needs no symmetric matrix.

use crate::common::blocks::{LOADINGS, MU, PRESS, block, flaw, loaded, solve};
use crate::common::brick::Support;
use crate::common::measures::{eta, rounding};
use crate::common::problems::{Case, Law, coulomb, definite, loaded as randomly_loaded, uniform};
use fastrand::Rng;
use signorini::{ContactProblem, Method, Monitor, Settings, Status};

fn settings(method: Method) -> Settings {
    Settings { method, tolerance: 1e-12, ..Settings::default() }
}

fn median(systems: &mut [u64]) -> u64 {
    systems.sort_unstable();
    systems[systems.len() / 2]
}

/// Blocks take about two systems for each boundary between the swept start and the solution: a median of
/// 15 systems at 25 pairs and of 20 at 225 is what a study of this method asks for.
#[test]
fn the_path_solves_blocks() {
    for (n, most) in [(5, 15), (15, 20)] {
        let brick = block(n, Support::Clamped);
        let model = brick.model();
        let mut systems = Vec::new();
        for loading in LOADINGS {
            for mu in MU.into_iter().chain([30.0]) {
                let case = loaded(&brick, &model, loading, mu);
                let solution = solve(&case, Method::Path, None);
                assert_eq!(flaw(&case, &solution), None, "{n}: {loading:?}, mu {mu}");
                systems.push(solution.factorisations);
            }
        }
        let worst = systems.iter().max().copied();
        let median = median(&mut systems);
        println!("{} pairs: median {median} systems, most {worst:?}", brick.pairs());
        assert!(median <= most, "{n}: {median} systems");
    }
}

/// Symmetric blocks have pairs that reach their boundaries together: the start is perturbed.
#[test]
fn ties_do_not_stop_the_path() {
    let brick = block(5, Support::Clamped);
    let model = brick.model();
    for motion in [[0.0, 0.0, -PRESS], [PRESS, 0.0, -PRESS], [PRESS, PRESS, -PRESS / 10.0]] {
        let case = brick.case(&model, |_| motion, 30.0);
        assert_eq!(flaw(&case, &solve(&case, Method::Path, None)), None, "{motion:?}");
    }
}

/// Random dense matrices of 20 pairs, the condition number 1e2 and mu 10: the same study asks for a median
/// of 30 systems and at most 150. A path that is not lost ends with the orientation +1.
#[test]
fn the_path_solves_dense_problems() {
    let mut systems = Vec::new();
    for seed in 0..50 {
        let mut rng = Rng::with_seed(seed);
        let k = definite(&mut rng, 60, 1e2);
        let case = randomly_loaded(&mut rng, 3, k, Law::Coulomb(vec![10.0; 20]));
        let solution = case.solve(&settings(Method::Path));
        assert_eq!(flaw(&case, &solution), None, "seed {seed}");
        assert_eq!(solution.orientation, 1, "seed {seed}");
        systems.push(solution.factorisations);
    }
    let worst = systems.iter().max().copied().unwrap_or(0);
    let median = median(&mut systems);
    println!("median {median} systems, most {worst}");
    assert!(median <= 30 && worst <= 150, "median {median}, most {worst}");
}

/// With given thresholds there is one solution (theorem E): Newton's method and the path find it, in at
/// most 20 systems by Newton's. A condition number of 1e4 makes 1e-8 of the displacements of 1e-12 of the
/// forces.
#[test]
fn given_thresholds_have_one_solution() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=20);
        let k = definite(&mut rng, 3 * pairs, 1e4);
        let g = (0..pairs).map(|_| uniform(&mut rng, 0.0, 1.0)).collect();
        let case = randomly_loaded(&mut rng, 3, k, Law::Tresca(g));
        let (one, two) =
            (case.solve(&settings(Method::Newton)), case.solve(&settings(Method::Path)));
        assert_eq!((one.status, two.status), (Status::Solved, Status::Solved), "seed {seed}");
        assert!(one.factorisations <= 20, "seed {seed}: {} systems", one.factorisations);
        let size = one.d.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        for (one, two) in one.d.iter().zip(&two.d) {
            assert!((one - two).abs() <= 1e-8 * size, "seed {seed}: {one} and {two}");
        }
    }
}

/// `x.K x > 0` is all that theory asks for: a symmetric definite matrix with an antisymmetric part of its
/// own size.
fn unsymmetric(rng: &mut Rng, n: usize, condition: f64) -> Vec<f64> {
    let mut k = definite(rng, n, condition);
    for j in 0..n {
        for i in 0..j {
            let turn = uniform(rng, -1.0, 1.0) * (k[i * (n + 1)] * k[j * (n + 1)]).sqrt() / 2.0;
            k[i + n * j] += turn;
            k[j + n * i] -= turn;
        }
    }
    k
}

#[test]
fn unsymmetric_problems_are_solved() {
    let (mut solved, mut by_path, count) = (0, 0, 1000);
    for seed in 0..count {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=20);
        let condition = [1e1, 1e2, 1e4][rng.usize(0..3)];
        let k = unsymmetric(&mut rng, 3 * pairs, condition);
        let law = coulomb(&mut rng, pairs, 20.0);
        let case: Case = randomly_loaded(&mut rng, 3, k, law);
        let problem = ContactProblem::unsymmetric(case.data()).expect("the data is valid");
        let settings = settings(Method::Auto);
        let mut monitor = Monitor::new(&settings, None);
        let solution = signorini::solve(&problem, &settings, None, &mut monitor).unwrap();
        by_path += u32::from(solution.method == Method::Path);
        let accurate = eta(&case, &solution.d) <= 1e-12 + rounding(&case, &solution.d);
        match solution.status == Status::Solved && accurate {
            true => solved += 1,
            false => println!("seed {seed}: {}", solution.message),
        }
    }
    println!("{solved} of {count}, {by_path} by the path");
    assert_eq!(solved, count);
}
