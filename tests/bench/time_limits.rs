//! How long a call may work after its time limit: the longest time between two looks at the clock.
//!
//! `cargo bench --bench time_limits`: 1500 unknowns in the plane and in space, with and without friction,
//! every method, the search for other solutions and proofs. Measured are milliseconds of the thread's own
//! processor time, which other work on the machine does not lengthen: between two calls of the callback, and from
//! the last one to the end. A limit that passes in between is noticed so much later. Then calls with
//! limits are made, which end so many milliseconds (of the clock) after them at most.
//!
//! `cargo bench --bench time_limits -- models` does so with models of 60,000 to 110,000 unknowns, condensed and in full
//! space: while they are made, and in load cases of a series.

mod bar;
#[path = "../common/mod.rs"]
mod common;

use std::ops::ControlFlow;
use std::time::Instant;

use bar::{Top, bar_with_top};
use common::blocks::{Loading, block, loaded};
use common::brick::Support;
use common::wavy::Wavy;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, LoadCase, Method, Monitor, Progress, ProgressFn,
    Search, Settings, Solution, Starts, Status, solve,
};

/// Seconds.
const LIMITS: [f64; 8] = [0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.8];

/// A wall clock tells of other processes too: the better of so many runs.
const RUNS: usize = 2;

fn main() {
    if std::env::args().any(|argument| argument == "models") {
        println!("ms of the processor, and the most between two looks at the clock");
        models("plane, 2001 pairs", &Wavy::plane(2000));
        models("space, 1849 pairs", &Wavy::space(43));
        return;
    }
    let plane = bar_with_top(749, 10, 1.5, 10.0, Top::Clamped(0.02));
    let gap: Vec<f64> = (0..plane.pairs).map(|i| 1e-3 * (0.05 * i as f64).sin()).collect();
    let brick = block(22, Support::Clamped);
    let model = brick.model();
    let space = loaded(&brick, &model, Loading::WavyGaps, 0.3);
    println!("ms of the processor between two looks at the clock; ms of the clock after the limit");
    println!("{:<34} {:>9} {:>9} {:>9} {:>9}", "", "all", "gap", "end", "late");
    for mu in [0.0, 0.3] {
        let data = ContactData {
            dim: 2,
            pairs: plane.pairs,
            stiffness: &plane.stiffness,
            ld: 2 * plane.pairs,
            load: &plane.load,
            gap: &gap,
            law: FrictionLaw::Coulomb(&vec![mu; plane.pairs]),
            reference_slip: None,
        };
        every_method(&format!("2D mu {mu}"), &ContactProblem::new(data).expect("a valid problem"));
        let mut case = space.clone();
        case.law = common::problems::Law::Coulomb(vec![mu; case.pairs]);
        every_method(&format!("3D mu {mu}"), &case.problem());
    }
}

/// Makes a model in both forms and solves three load cases, each from the one before it, with ever lower loads.
fn models(name: &str, wavy: &Wavy) {
    for full_space in [false, true] {
        let settings = Settings { full_space, ..Settings::default() };
        let form = if full_space { "full space" } else { "condensed" };
        println!("{name}, {} unknowns, {form}", wavy.stiffness.size);
        let model = looked("model", |look| {
            wavy.try_model(&mut Monitor::new(&settings, Some(look))).expect("a model")
        });
        let (mu, mut series) = (vec![0.3; model.pairs()], model.series());
        for (part, called) in [(1.0, "first load case"), (0.9, "second load case"), (0.8, "third")]
        {
            let scaled = |values: &[f64]| values.iter().map(|v| part * v).collect::<Vec<f64>>();
            let (load, values) = (scaled(&wavy.load), wavy.prescribed.as_deref().map(scaled));
            let case = LoadCase {
                load: &load,
                prescribed: values.as_deref(),
                gap: &wavy.gap,
                law: FrictionLaw::Coulomb(&mu),
                reference_slip: None,
            };
            let solution = looked(called, |look| {
                let start = Starts::Previous(None);
                let solved = series.solve_cases(&[case], &settings, start, Some(look));
                solved.into_iter().next().expect("a case").expect("a solution")
            });
            let Solution { status, iterations, factorisations, outer_iterations, .. } = solution;
            println!(
                "    {status:?}, {iterations} systems, {factorisations} factorisations, {outer_iterations} solutions"
            );
        }
    }
}

/// Works with a callback, and tells how long it takes and is silent.
fn looked<T>(name: &str, work: impl FnOnce(&mut ProgressFn<'_>) -> T) -> T {
    let (begin, mut looks) = (processor_time(), Vec::new());
    let mut look = |_: &Progress| {
        looks.push(processor_time());
        ControlFlow::Continue(())
    };
    let done = work(&mut look);
    looks.push(processor_time());
    let mut gaps: Vec<(f64, usize)> = (0..looks.len())
        .map(|k| (looks[k] - if k > 0 { looks[k - 1] } else { begin }, k))
        .collect();
    gaps.sort_by(|a, b| b.0.total_cmp(&a.0));
    gaps.truncate(4);
    let longest: Vec<String> = gaps.iter().map(|(gap, k)| format!("{gap:.0} (look {k})")).collect();
    println!("  {name:<16} {:>7.0}; {}", looks[looks.len() - 1] - begin, longest.join(", "));
    done
}

fn every_method(name: &str, problem: &ContactProblem<'_>) {
    let method = |method| Settings { method, ..Settings::default() };
    let all = [
        ("auto", method(Method::Auto)),
        ("nested sweeps", method(Method::SorNested)),
        ("diagonal sweeps", method(Method::SorDiagonal)),
        ("Lemke", method(Method::Lemke)),
        ("block pivoting", method(Method::BlockPivoting)),
        ("Newton", method(Method::Newton)),
        ("path", method(Method::Path)),
        ("others", Settings { search: Search::Others, ..Settings::default() }),
        ("proof", Settings { proof: true, ..Settings::default() }),
    ];
    for (method, settings) in all {
        let Some((all, gap, end)) = looks(problem, &settings) else { continue };
        let late = LIMITS.map(|limit| {
            let settings = Settings { time_limit: limit, ..settings };
            (0..RUNS).map(|_| late(problem, &settings)).fold(f64::INFINITY, f64::min)
        });
        let late = late.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let name = format!("{name}, {method}");
        println!("{name:<34} {all:>9.1} {gap:>9.1} {end:>9.1} {late:>9.1}");
    }
}

/// Processor time of a call in all, most of it between two looks at the clock, and after the last one; `None` if the method
/// does not fit the problem.
fn looks(problem: &ContactProblem<'_>, settings: &Settings) -> Option<(f64, f64, f64)> {
    let settings = Settings { time_limit: 3.0, ..*settings };
    let begin = processor_time();
    let (mut last, mut most) = (begin, 0.0_f64);
    let mut look = |_: &Progress| {
        let now = processor_time();
        most = most.max(now - last);
        last = now;
        ControlFlow::Continue(())
    };
    let monitor = &mut Monitor::new(&settings, Some(&mut look));
    solve(problem, &settings, None, monitor).ok()?;
    let end = processor_time();
    Some((end - begin, most, end - last))
}

/// How much later than its limit a call ends.
fn late(problem: &ContactProblem<'_>, settings: &Settings) -> f64 {
    let begin = Instant::now();
    let Solution { status, .. } =
        solve(problem, settings, None, &mut Monitor::new(settings, None)).expect("a valid problem");
    let elapsed = begin.elapsed().as_secs_f64();
    assert!(matches!(status, Status::Solved | Status::TimeLimit | Status::Stalled), "{status:?}");
    1e3 * (elapsed - settings.time_limit)
}

/// Milliseconds that the processor has worked for this thread.
fn processor_time() -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").expect("Linux");
    let nanoseconds: f64 = told.split(' ').next().and_then(|ns| ns.parse().ok()).expect("a number");
    1e-6 * nanoseconds
}
