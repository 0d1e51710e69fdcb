//! Random definite problems with friction in space, of every size, condition number and coefficient that
//! theory promises a solution for: the default solves all of them.
//!
//! Theory: with a definite stiffness there is a solution for all coefficients, loads, gaps and previous
//! slips. So there is no share of failures that would be right.

use crate::common::brick::{Brick, Support, Vector, cross};
use crate::common::measures::{eta, rounding};
use crate::common::problems::{Case, Law, definite, loaded, uniform};
use fastrand::Rng;
use signorini::{Method, Model, Settings, Solution, Status};

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
/// condition number `c` of 1e4 and 1e-9 at 1e6, with `n = 90`. Up to 1e4 a tenth of that is asked for, as
/// loads along the softest motion alone would reach it.
fn tolerance(condition: f64) -> f64 {
    if condition <= 1e4 { 1e-12 } else { 1e-9 }
}

/// One coefficient for all pairs, or one for each, up to `most`.
fn friction(rng: &mut Rng, pairs: usize, most: f64) -> Law {
    let mu = |rng: &mut Rng| uniform(rng, LEAST_MU.ln(), most.ln()).exp();
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
    let law = friction(&mut rng, pairs, MOST_MU);
    (loaded(&mut rng, 3, k, law), condition)
}

fn solve(case: &Case, tolerance: f64) -> Solution {
    case.solve(&Settings {
        method: Method::Auto,
        tolerance,
        max_iterations: MOST_ITERATIONS,
        ..Settings::default()
    })
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
        let solution = solve(&case, tolerance);
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

/// How many blocks, and their largest coefficient: bricks are far kinder than random matrices.
const BLOCKS: u64 = 400;
const MOST_MU_OF_BLOCKS: f64 = 30.0;

/// A block of bricks, clamped or on springs, whose plate moves anyhow: it presses in the mean; loads at the
/// pairs, gaps and previous slips of the size of the plate's motion.
fn random_block(rng: &mut Rng, models: &[(Brick, Model)]) -> Case {
    let (brick, model) = &models[rng.usize(0..models.len())];
    let mut some = |size: f64| uniform(rng, -size, size);
    let shift: Vector = std::array::from_fn(|_| some(0.1));
    let turn: Vector = std::array::from_fn(|_| some(0.1));
    let motion = |place: Vector| {
        let turned = cross(turn, place);
        std::array::from_fn(|c| shift[c] + turned[c] - if c == 2 { 0.05 } else { 0.0 })
    };
    let mut case = brick.case(model, motion, 0.0);
    case.law = friction(rng, case.pairs, MOST_MU_OF_BLOCKS);
    let mut some = |size: f64| uniform(rng, -size, size);
    case.f.iter_mut().for_each(|f| *f += some(0.01));
    case.gap.iter_mut().for_each(|gap| *gap = some(0.05));
    case.slip = Some((0..2 * case.pairs).map(|_| some(0.05)).collect());
    case
}

#[test]
fn the_default_solves_every_random_block_in_a_few_systems() {
    let models = [Support::Clamped, Support::Springs(0.01)].map(|support| {
        let brick = Brick::new([4, 4, 3], [2.0, 2.0, 1.0], support);
        let model = brick.model();
        (brick, model)
    });
    let (mut systems, mut failed, mut left) = (Vec::new(), Vec::new(), 0);
    for seed in 0..BLOCKS {
        let case = random_block(&mut Rng::with_seed(seed), &models);
        let solution = solve(&case, 1e-12);
        systems.push(solution.factorisations);
        left += u64::from(solution.fallback.is_some());
        if !is_solved(&case, &solution, 1e-12) {
            failed.push(format!("seed {seed}: {}, {:?}", solution.message, solution.fallback));
        }
    }
    systems.sort_unstable();
    let median = systems[systems.len() / 2];
    println!("blocks: {} of {BLOCKS} solved", systems.len() - failed.len());
    println!("{left} of them not by Newton's method");
    println!("systems: median {median}, most {}", systems[systems.len() - 1]);
    assert!(failed.is_empty(), "{} of {BLOCKS} are not solved: {failed:#?}", failed.len());
    assert!(median <= 3, "{median}");
    assert!(left <= BLOCKS / 100, "{left} of {BLOCKS} leave Newton's method");
}
