//! Random definite problems with friction in space, of every size, condition number and coefficient that
//! theory promises a solution for: the default solves all of them.
//!
//! Theory: with a definite stiffness there is a solution for all coefficients, loads, gaps and previous
//! slips. So there is no share of failures that would be right.

mod common;

use common::measures::{eta, rounding};
use common::problems::{Case, Law, definite, loaded, uniform};
use fastrand::Rng;
use signorini::{Method, Settings, Solution, Status};

/// How many problems. `SIGNORINI_RANDOM_3D` in the environment chooses another number.
const PROBLEMS: u64 = 1000;

/// Most pairs of a problem.
const PAIRS: usize = 30;

/// Condition numbers, in turn.
const CONDITIONS: [f64; 6] = [1e1, 1e2, 1e3, 1e4, 1e5, 1e6];

/// Range of the coefficients of friction, of which the logarithm is uniform.
const LEAST_MU: f64 = 0.1;
const MOST_MU: f64 = 20.0;

/// A loop that an exact method never fills: it keeps a failing problem from taking its time.
const MOST_ITERATIONS: u64 = 20_000;

/// Rounding of `K d` beside the forces is up to `eps c sqrt(n)`, as `|d|` is up to `c |f|`: 1e-11 at the
/// condition number `c` of 1e4 and 1e-9 at 1e6 with `n = 90`. Displacements that large are rare: to 1e4
/// a tenth of it is met by all.
fn tolerance(condition: f64) -> f64 {
    if condition <= 1e4 { 1e-12 } else { 1e-9 }
}

/// One coefficient for all pairs, or one for each.
fn friction(rng: &mut Rng, pairs: usize) -> Law {
    let mu = |rng: &mut Rng| uniform(rng, LEAST_MU.ln(), MOST_MU.ln()).exp();
    if rng.bool() {
        return Law::Coulomb(vec![mu(rng); pairs]);
    }
    Law::Coulomb((0..pairs).map(|_| mu(rng)).collect())
}

fn problem(seed: u64) -> (Case, f64) {
    let mut rng = Rng::with_seed(seed);
    let condition = CONDITIONS[seed as usize % CONDITIONS.len()];
    let pairs = rng.usize(1..=PAIRS);
    let k = definite(&mut rng, 3 * pairs, condition);
    let law = friction(&mut rng, pairs);
    (loaded(&mut rng, 3, k, law), condition)
}

/// Solved, and measured here too: to the tolerance and the rounding of another sum.
fn is_solved(case: &Case, solution: &Solution, tolerance: f64) -> bool {
    solution.status == Status::Solved
        && eta(case, &solution.d) <= tolerance + rounding(case, &solution.d)
}

#[test]
fn the_default_solves_every_random_definite_problem() {
    let count = std::env::var("SIGNORINI_RANDOM_3D");
    let count = count.map_or(PROBLEMS, |count| count.parse().expect("a number of problems"));
    let mut solved = [[0_u64; 2]; CONDITIONS.len()];
    let mut failed = Vec::new();
    for seed in 0..count {
        let (case, condition) = problem(seed);
        let tolerance = tolerance(condition);
        let settings = Settings {
            method: Method::Auto,
            tolerance,
            max_iterations: MOST_ITERATIONS,
            ..Settings::default()
        };
        let solution = case.solve(&settings);
        let row = &mut solved[seed as usize % CONDITIONS.len()];
        row[1] += 1;
        if is_solved(&case, &solution, tolerance) {
            row[0] += 1;
        } else {
            failed.push(format!("seed {seed}, {} pairs: {}", case.pairs, solution.message));
        }
    }
    for (condition, [solved, all]) in CONDITIONS.iter().zip(solved) {
        println!("condition number {condition:.0e}: {solved} of {all} solved");
    }
    let some = &failed[..failed.len().min(10)];
    assert!(failed.is_empty(), "{} of {count} are not solved, such as {some:#?}", failed.len());
}
