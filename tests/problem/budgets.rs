//! Budgets and the progress callback end a call with the status that names them, and the best iterate.

use std::ops::ControlFlow;

use crate::common::measures::{eta, rounding};
use crate::common::problems::{
    Case, Law, coulomb, decades, definite, frictionless, loaded, tresca,
};
use fastrand::Rng;
use signorini::{Method, Monitor, Progress, Search, Settings, Solution, Status};

const TOLERANCE: f64 = 1e-10;

const ALL: [Method; 6] = [
    Method::Auto,
    Method::SorNested,
    Method::SorDiagonal,
    Method::Lemke,
    Method::BlockPivoting,
    Method::Newton,
];

/// Problems that the method solves, with friction that has one solution, and some work to do.
fn problems(method: Method) -> Vec<Case> {
    let laws: &[fn(&mut Rng, usize) -> Law] = match method {
        Method::BlockPivoting => &[|_, pairs| frictionless(pairs)],
        Method::SorDiagonal => &[|rng, pairs| coulomb(rng, pairs, 0.1), |_, n| frictionless(n)],
        _ => &[|rng, pairs| coulomb(rng, pairs, 0.3), |_, n| frictionless(n), tresca],
    };
    // Block pivoting and Newton's method need more than one system on harder ones alone.
    let hard = matches!(method, Method::BlockPivoting | Method::Newton);
    let (least, condition) = if hard { (12, 1e4) } else { (4, 30.0) };
    let make = |seed: u64| {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(least..=least + 8);
        let k = definite(&mut rng, 2 * pairs, condition);
        let law = laws[seed as usize % laws.len()](&mut rng, pairs);
        loaded(&mut rng, 2, k, law)
    };
    (0..24).map(make).collect()
}

/// The result, and the count of iterations at each call of the callback. Work without iterations, such as sweeps before
/// Newton's method and questions about a result, calls it too.
fn solve(case: &Case, settings: &Settings, cancel_at: Option<usize>) -> (Solution, Vec<u64>) {
    let mut told = Vec::new();
    let mut progress = |progress: &Progress| {
        assert!(progress.eta >= 0.0 && progress.elapsed >= 0.0);
        assert!(cancel_at != Some(told.len()), "it goes on after it was cancelled");
        let next = told.last().map_or(0, |last| last + 1);
        assert!(
            progress.iterations + 1 == next || progress.iterations == next,
            "{told:?}, {progress:?}"
        );
        told.push(progress.iterations);
        if cancel_at == Some(told.len()) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let mut monitor = Monitor::new(settings, Some(&mut progress));
    let solution = signorini::solve(&case.problem(), settings, None, &mut monitor).unwrap();
    (solution, told)
}

/// Whatever the end: finite numbers, a certificate of just these displacements, forces within the
/// law; and 'solved' if and only if they solve it.
fn consistent(case: &Case, solution: &Solution) {
    let certificate = &solution.certificate;
    assert!(solution.d.iter().chain(&certificate.force).all(|x| x.is_finite()), "{solution:?}");
    assert_eq!(solution.d.len(), case.size());
    assert_eq!(certificate.states.len(), case.pairs);
    let difference = (certificate.eta - eta(case, &solution.d)).abs();
    assert!(difference <= rounding(case, &solution.d), "{difference:e}: {solution:?}");
    assert_eq!(solution.status == Status::Solved, certificate.eta <= TOLERANCE, "{solution:?}");
    for pair in 0..case.pairs {
        let (normal, tangential) = (certificate.force[2 * pair], certificate.force[2 * pair + 1]);
        let bound = case.bound(pair, normal);
        assert!(normal <= 0.0 && tangential.abs() <= bound * (1.0 + 1e-14), "{solution:?}");
    }
}

fn settings(method: Method) -> Settings {
    Settings { method, tolerance: TOLERANCE, ..Settings::default() }
}

/// With one iteration after the other, until it is solved; then with all larger budgets, and by as
/// many iterations.
#[test]
fn max_iterations_ends_every_method() {
    for method in ALL {
        let mut limited = 0;
        for (seed, case) in problems(method).iter().enumerate() {
            let (enough, _) = solve(case, &settings(method), None);
            assert_eq!(enough.status, Status::Solved, "{method:?}, {seed}: {}", enough.message);
            consistent(case, &enough);
            let budgets = (1..20).chain([enough.iterations.max(1) - 1, enough.iterations]);
            for max_iterations in budgets.chain([enough.iterations + 1]).filter(|&b| b > 0) {
                let budget = Settings { max_iterations, ..settings(method) };
                let (solution, _) = solve(case, &budget, None);
                let context = || format!("{method:?}, {seed}, {max_iterations}: {solution:?}");
                consistent(case, &solution);
                assert!(solution.iterations <= max_iterations, "{}", context());
                if max_iterations >= enough.iterations {
                    assert_eq!(solution.status, Status::Solved, "{}", context());
                    assert_eq!(solution.d, enough.d, "{}", context());
                    assert_eq!(solution.iterations, enough.iterations, "{}", context());
                } else if solution.status != Status::Solved {
                    // (A last iterate that happens to be accurate enough is solved.)
                    assert_eq!(solution.status, Status::IterationLimit, "{}", context());
                    assert!(solution.message.contains("max_iterations"), "{}", context());
                    assert_eq!(solution.iterations, max_iterations, "{}", context());
                    limited += 1;
                }
            }
        }
        assert!(limited > 0, "no budget was too small for {method:?}");
    }
}

#[test]
fn the_callback_cancels_every_method() {
    for method in ALL {
        let mut cancelled = 0;
        for (seed, case) in problems(method).iter().enumerate() {
            let (enough, told) = solve(case, &settings(method), None);
            let last = told.last().copied().unwrap_or(0);
            assert!(last + 1 >= enough.iterations, "{method:?}, {seed}: {told:?}");
            for at in (1..=4).chain([told.len()]).filter(|at| (1..=told.len()).contains(at)) {
                let (solution, told) = solve(case, &settings(method), Some(at));
                let context = || format!("{method:?}, {seed}, cancelled at {at}: {solution:?}");
                consistent(case, &solution);
                assert_eq!(told.len(), at, "{}", context());
                assert_eq!(solution.iterations, told[at - 1], "{}", context());
                if solution.status != Status::Solved {
                    assert_eq!(solution.status, Status::Cancelled, "{}", context());
                    assert!(solution.message.contains("cancelled"), "{}", context());
                    cancelled += 1;
                }
            }
        }
        assert!(cancelled > 0, "{method:?} was never cancelled");
    }
}

#[test]
fn a_time_limit_ends_every_method() {
    for method in ALL {
        let mut limited = 0;
        for case in problems(method) {
            let limit = Settings { time_limit: f64::MIN_POSITIVE, ..settings(method) };
            let (solution, _) = solve(&case, &limit, None);
            consistent(&case, &solution);
            assert!(matches!(solution.status, Status::TimeLimit | Status::Solved), "{solution:?}");
            limited += usize::from(solution.status == Status::TimeLimit);
        }
        assert!(limited > 0, "{method:?} ends before the clock ticks");
    }
}

/// Before Newton's method ends, the results are those of Newton's method; where it ends without a
/// solution and another method follows, they are no worse than those that it leaves.
#[test]
fn auto_returns_the_best_of_what_it_has_tried() {
    let mut followed = 0;
    for seed in 0..400 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(2..=12);
        let condition = decades(&mut rng, 6.0);
        let k = definite(&mut rng, 2 * pairs, condition);
        let law = coulomb(&mut rng, pairs, 5.0);
        let case = loaded(&mut rng, 2, k, law);
        let (newton, _) = solve(&case, &settings(Method::Newton), None);
        if newton.status == Status::Solved {
            continue;
        }
        let end = newton.iterations;
        for max_iterations in [1, 2, 3, end, end + 1, end + 2, end + 5, end + 20] {
            let of = |method| Settings { max_iterations, ..settings(method) };
            let (auto, _) = solve(&case, &of(Method::Auto), None);
            consistent(&case, &auto);
            let context = || format!("seed {seed}, {max_iterations}, Newton {end}: {auto:?}");
            let limited = matches!(auto.status, Status::Solved | Status::IterationLimit);
            assert!(limited, "{}", context());
            if max_iterations < end {
                let (alone, _) = solve(&case, &of(Method::Newton), None);
                assert_eq!(auto.d, alone.d, "{}", context());
            } else {
                let least = newton.certificate.eta;
                assert!(auto.certificate.eta <= least, "{least:e}, {}", context());
                followed += usize::from(auto.status == Status::IterationLimit);
            }
        }
    }
    assert!(followed > 20, "no budget ends in the method that follows: {followed}");
}

/// The search for others counts: what is interrupted then is the search, not the solution, which
/// stays solved.
#[test]
fn a_solution_stays_solved_when_the_search_for_others_is_interrupted() {
    for seed in 0..100 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(2..=8);
        let k = definite(&mut rng, 2 * pairs, 1e3);
        let law = coulomb(&mut rng, pairs, 5.0);
        let case = loaded(&mut rng, 2, k, law);
        let (alone, _) = solve(&case, &settings(Method::Auto), None);
        assert_eq!(alone.status, Status::Solved, "seed {seed}: {}", alone.message);
        for more in 0..5 {
            let max_iterations = (alone.iterations + more).max(1);
            let settings = Settings { search: Search::Others, ..settings(Method::Auto) };
            let (solution, _) = solve(&case, &Settings { max_iterations, ..settings }, None);
            let context = || format!("seed {seed}, {more} more: {solution:?}");
            consistent(&case, &solution);
            assert_eq!(solution.status, Status::Solved, "{}", context());
            assert_eq!(solution.d, alone.d, "{}", context());
        }
    }
}
