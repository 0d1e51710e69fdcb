//! The default solves whatever any single method solves, on random problems at the edges of double precision.
//!
//! `SIGNORINI_NEVER_WORSE=100000 cargo test --release --test families -- never_worse --nocapture` asks so many problems.

use crate::common::edges::{Problem, problem, problem_among};
use crate::common::problems::{Law, coulomb, definite, loaded, tresca};
use fastrand::Rng;
use signorini::{ContactProblem, Error, Method, Model, Monitor, Settings, Solution, Status};

/// Problems without the variable: 50 of each class in each dimension.
const PROBLEMS: u64 = 1200;

const METHODS: [Method; 6] = [
    Method::Newton,
    Method::Path,
    Method::Lemke,
    Method::BlockPivoting,
    Method::SorNested,
    Method::SorDiagonal,
];

fn solve(problem: &Problem, method: Method) -> Result<Solution, Error> {
    let settings = Settings { method, tolerance: problem.tolerance, ..Settings::default() };
    let checked = ContactProblem::new(problem.case.data())?;
    signorini::solve(&checked, &settings, None, &mut Monitor::new(&settings, None))
}

/// The methods that solve a problem which the default leaves open. A proof that there is no equilibrium says more than a
/// solution to a coarse tolerance.
fn better(problem: &Problem) -> Vec<Method> {
    let status = |method| solve(problem, method).map(|solution| solution.status);
    if matches!(status(Method::Auto), Ok(Status::Solved | Status::NoEquilibrium)) {
        return Vec::new();
    }
    METHODS.into_iter().filter(|&method| matches!(status(method), Ok(Status::Solved))).collect()
}

#[test]
fn the_default_solves_what_any_method_solves() {
    let long = std::env::var("SIGNORINI_NEVER_WORSE").ok();
    let problems = long.map_or(PROBLEMS, |count| count.parse().expect("a number of problems"));
    let mut worse = Vec::new();
    for seed in 0..problems {
        let mut problem = problem(seed);
        if ContactProblem::new(problem.case.data()).is_err() {
            // A host makes a model of a body on few points, which knows its rigid motions without rounding.
            let data = problem.case.data();
            let model = Model::condensed(data.dim, data.pairs, data.stiffness, data.ld);
            problem.case.k = model.expect("a model of the matrix").stiffness().to_vec();
        }
        let better = better(&problem);
        if !better.is_empty() {
            println!("seed {seed}, class {}: {better:?}", problem.class);
            worse.push(seed);
        }
    }
    println!(
        "{} of {problems} problems are solved by a method and not by the default",
        worse.len()
    );
    assert!(worse.is_empty(), "{worse:?}");
}

/// Ill-conditioned matrices with much and with little friction and gaps of all sizes, and one pair with given
/// thresholds: there a start that another method had left was worse than none.
#[test]
fn a_bad_start_of_another_method_does_no_harm() {
    let mut worse = Vec::new();
    for seed in 0..300 {
        let rng = &mut Rng::with_seed(seed);
        let dim = 2 + seed as usize % 2;
        let pairs = [1, 4, 12][rng.usize(0..3)];
        let condition = 10_f64.powf(4.0 + 6.0 * rng.f64());
        let k = definite(rng, dim * pairs, condition);
        let law: Law = match seed % 3 {
            0 => tresca(rng, pairs),
            1 => coulomb(rng, pairs, 1e-8),
            _ => coulomb(rng, pairs, 5.0),
        };
        let mut case = loaded(rng, dim, k, law);
        for gap in &mut case.gap {
            *gap = 10_f64.powf(-12.0 + 24.0 * rng.f64());
        }
        let problem = Problem {
            class: 0,
            case,
            motions: Vec::new(),
            noise: 0.0,
            tolerance: 1e-10,
            search: false,
        };
        let better = better(&problem);
        if !better.is_empty() {
            println!("seed {seed}: {better:?}");
            worse.push(seed);
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
}

/// Sweeps need more than a plan gives them where they begin: pairs that stand twice with a tolerance of 1e-12 need 5,056
/// to 21,988, and fewer from where other methods end. Of the others only those from zero arrive.
#[test]
fn sweeps_begin_at_zero_and_where_other_methods_end() {
    let problems = [28604, 92178].map(|seed| problem_among(seed, 19)).into_iter();
    for problem in problems.chain([44188, 51580, 54456].map(|seed| problem_among(seed, 22))) {
        let better = better(&problem);
        assert!(better.is_empty(), "class {}: {better:?}", problem.class);
    }
}
