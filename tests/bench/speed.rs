//! How close the kernels come to what the memory allows; both sides in one run, one thread.
//!
//! `cargo bench --bench speed`. Figures are medians.

mod bar;

use std::hint::black_box;
use std::time::Instant;

use pulp::Arch;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Lcp, Method, Monitor, Settings, Solution, State,
    Status, solve, solve_lcp,
};

fn main() {
    let problems = [512, 1024].map(|columns| bar::bar(columns, 10, 1.5, 10.0));
    println!("A sweep in which everything changes, beside one read of K");
    problems.iter().for_each(sweep);
    println!("\nA pivot of Lemke's method, beside a bare rank-1 update of its tableau");
    problems.iter().for_each(pivot);
    println!("\nFrictionless, wavy gap: sweeps to 1e-8 by omega (0: chosen), and Lemke's method");
    problems.iter().for_each(frictionless);
    println!("\nFriction, to 1e-10, omega chosen");
    problems.iter().for_each(friction);
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// Medians of two things timed in turn, so that a drift of the machine's speed meets both.
fn in_turn(mut one: impl FnMut() -> f64, mut two: impl FnMut() -> f64) -> (f64, f64) {
    let (mut first, mut second) = (Vec::new(), Vec::new());
    for _ in 0..15 {
        first.push(one());
        second.push(two());
    }
    (median(first), median(second))
}

fn seconds(work: impl FnOnce()) -> f64 {
    let begin = Instant::now();
    work();
    begin.elapsed().as_secs_f64()
}

fn problem<'a>(
    bar: &'a bar::Condensed,
    gap: &'a [f64],
    friction: FrictionLaw<'a>,
) -> ContactProblem<'a> {
    ContactProblem::new(ContactData {
        dim: 2,
        pairs: bar.pairs,
        stiffness: &bar.stiffness,
        ld: 2 * bar.pairs,
        load: &bar.load,
        gap,
        law: friction,
        reference_slip: None,
    })
    .expect("a valid problem")
}

fn run(problem: &ContactProblem<'_>, settings: &Settings) -> Solution {
    solve(problem, settings, None, &mut Monitor::new(settings, None)).expect("valid settings")
}

fn sweep(bar: &bar::Condensed) {
    let n = 2 * bar.pairs;
    let gap = vec![f64::INFINITY; bar.pairs];
    // A threshold too small to hold anything, but not zero, which would eliminate the tangents.
    let threshold = vec![1e-9; bar.pairs];
    let problem = problem(bar, &gap, FrictionLaw::Tresca(&threshold));
    let sweeps = |count| {
        let settings = Settings {
            method: Method::SorNested,
            tolerance: 1e-15,
            omega: 1.0,
            max_iterations: count,
            ..Settings::default()
        };
        assert_eq!(run(&problem, &settings).iterations, count);
    };
    let read = || {
        let arch = Arch::new();
        let repeats = 20;
        let time = seconds(|| {
            for _ in 0..repeats {
                black_box(sum(arch, black_box(&bar.stiffness)));
            }
        });
        time / f64::from(repeats)
    };
    let swept = || (seconds(|| sweeps(120)) - seconds(|| sweeps(20))) / 100.0;
    let (swept, read) = in_turn(swept, read);
    println!(
        "N = {n:4}: sweep {:7.1} us, read {:7.1} us, ratio {:.2}",
        1e6 * swept,
        1e6 * read,
        swept / read
    );
}

/// One read: sixteen running sums hide the latency of the additions.
fn sum(arch: Arch, values: &[f64]) -> f64 {
    arch.dispatch(
        #[inline(always)]
        || {
            let mut sums = [0.0; 16];
            for chunk in values.chunks_exact(16) {
                for (sum, value) in sums.iter_mut().zip(chunk) {
                    *sum += value;
                }
            }
            sums.iter().sum()
        },
    )
}

fn pivot(bar: &bar::Condensed) {
    let n = bar.pairs;
    // The normal block alone, under loads of both signs, so that about half of the pairs open.
    let matrix: Vec<f64> =
        (0..n * n).map(|k| bar.stiffness[2 * (k % n) + 2 * n * 2 * (k / n)]).collect();
    let q: Vec<f64> = (0..n).map(|i| (0.37 * i as f64).sin() + 0.2).collect();
    let lcp = Lcp::new(n, &matrix, n, &q, None).expect("a valid problem");
    let settings = Settings { method: Method::Lemke, ..Settings::default() };
    let pivoted = || {
        let mut pivots = 0;
        let time = seconds(|| {
            let solution = solve_lcp(&lcp, &settings, &mut Monitor::new(&settings, None));
            let solution = solution.expect("valid settings");
            assert_eq!(solution.status, Status::Solved);
            pivots = solution.iterations;
        });
        time / pivots as f64
    };
    let mut tableau = vec![1.0; n * (n + 2)];
    let column = vec![1e-3; n];
    let updated = || {
        let arch = Arch::new();
        let repeats = 20;
        let time = seconds(|| {
            for _ in 0..repeats {
                rank_one(arch, black_box(&mut tableau), black_box(&column));
            }
        });
        time / f64::from(repeats)
    };
    let (pivoted, updated) = in_turn(pivoted, updated);
    println!(
        "n = {n:4}: pivot {:6.1} us, rank-1 update {:6.1} us, pivots per second {:.0} % of the \
         bare update's",
        1e6 * pivoted,
        1e6 * updated,
        100.0 * updated / pivoted
    );
}

fn rank_one(arch: Arch, tableau: &mut [f64], column: &[f64]) {
    for (j, target) in tableau.chunks_exact_mut(column.len()).enumerate() {
        let share = 1e-3 * (j % 7) as f64 + 1e-3;
        arch.dispatch(
            #[inline(always)]
            || {
                for (target, column) in target.iter_mut().zip(column) {
                    *target -= share * column;
                }
            },
        );
    }
}

fn frictionless(bar: &bar::Condensed) {
    let zero = vec![0.0; bar.pairs];
    let waves = 3.0 * std::f64::consts::TAU / (bar.pairs - 1) as f64;
    let gap: Vec<f64> = (0..bar.pairs).map(|i| 2e-3 * (1.0 - (i as f64 * waves).cos())).collect();
    let problem = problem(bar, &gap, FrictionLaw::Coulomb(&zero));
    for omega in [1.0, 1.7, 1.8, 1.85, 1.9, 0.0] {
        let method = Method::SorNested;
        let settings = Settings { method, tolerance: 1e-8, omega, ..Settings::default() };
        report("SOR", bar.pairs, &format!("omega {omega:4}"), &problem, &settings);
    }
    let settings = Settings { method: Method::Lemke, ..Settings::default() };
    report("Lemke", bar.pairs, "", &problem, &settings);
}

fn friction(bar: &bar::Condensed) {
    let gap = vec![0.0; bar.pairs];
    for mu in [0.3, 1.0, 3.0] {
        let coefficients = vec![mu; bar.pairs];
        let problem = problem(bar, &gap, FrictionLaw::Coulomb(&coefficients));
        for (name, method) in [("nested", Method::SorNested), ("diagonal", Method::SorDiagonal)] {
            let settings = Settings { method, ..Settings::default() };
            report(name, bar.pairs, &format!("mu {mu}"), &problem, &settings);
        }
    }
}

fn report(name: &str, pairs: usize, what: &str, problem: &ContactProblem<'_>, settings: &Settings) {
    let begin = Instant::now();
    let solution = run(problem, settings);
    println!(
        "{pairs:4} pairs {name:8} {what:10} {:?}, {:5} iterations, omega {:.3}, {:4} open, {:7.1} ms",
        solution.status,
        solution.iterations,
        solution.omega,
        solution.certificate.count(State::Open),
        1e3 * begin.elapsed().as_secs_f64()
    );
}
