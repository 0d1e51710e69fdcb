//! Steps of a load history on a condensed model that start from the step before, beside the same problems from nothing.
//!
//! `cargo bench --bench warm_steps`, and `-- 129` of the body whose name begins so. Loads grow from step to step by a
//! thousandth, and gaps are zero, so that states stay; then they turn about a hundredth of the whole, so that some pairs
//! change. Told are medians of 200 steps, in microseconds.

#[path = "../common/mod.rs"]
mod common;

use std::time::Instant;

use common::wavy::Wavy;
use signorini::{FrictionLaw, LoadCase, Model, Monitor, Settings, Starts, Status};

const STEPS: usize = 200;

fn main() {
    println!(
        "us a step: cold; states stay: from the step before, part of cold; some change: the same"
    );
    for (name, wavy) in [
        ("129 pairs in the plane", Wavy::plane(128)),
        ("513", Wavy::plane(512)),
        ("1025", Wavy::plane(1024)),
        ("121 pairs in space", Wavy::space(11)),
        ("400", Wavy::space(20)),
    ] {
        if std::env::args().skip(1).all(|word| word.starts_with('-') || name.starts_with(&word)) {
            [0.0, 0.3].into_iter().for_each(|mu| told(name, &wavy, mu));
        }
    }
}

/// The steps of a body with a friction coefficient.
fn told(name: &str, wavy: &Wavy, mu: f64) {
    let settings = Settings::default();
    let sparse = wavy.model(&settings);
    let (dim, n) = (sparse.dim(), sparse.dim() * sparse.pairs());
    let model = Model::condensed(dim, sparse.pairs(), sparse.stiffness(), n).expect("a stiffness");
    let load =
        sparse.condensed_load(&wavy.load, wavy.prescribed.as_deref()).expect("loads that fit");
    let mu_of_pairs = vec![mu; model.pairs()];
    let law = FrictionLaw::Coulomb(&mu_of_pairs);
    let zero = vec![0.0; model.pairs()];
    let scaled = |part: f64| load.iter().map(|f| part * f).collect::<Vec<f64>>();
    let grows = |step: usize| scaled(1.0 + 1e-3 * step as f64);
    let swings = |step: usize| scaled(1.0 + 0.01 * (0.1 * step as f64).sin());
    let run = |gap: &[f64], loads: &dyn Fn(usize) -> Vec<f64>, warm: bool| -> f64 {
        let (mut series, mut times) = (model.series(), Vec::new());
        for step in 0..if warm { STEPS } else { STEPS / 10 } {
            let load = loads(step);
            let case = LoadCase { load: &load, prescribed: None, gap, law, reference_slip: None };
            let begin = Instant::now();
            let status = match warm {
                true => {
                    let solved =
                        series.solve_cases(&[case], &settings, Starts::Previous(None), None);
                    solved[0].as_ref().expect("data that fit").status
                }
                false => {
                    let monitor = &mut Monitor::new(&settings, None);
                    model.solve(&case, &settings, None, monitor).expect("data that fit").status
                }
            };
            times.push(1e6 * begin.elapsed().as_secs_f64());
            assert_eq!(status, Status::Solved, "{name}, mu {mu}, step {step}");
        }
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    let (cold, stay) = (run(&zero, &grows, false), run(&zero, &grows, true));
    let (other, change) = (run(&wavy.gap, &swings, false), run(&wavy.gap, &swings, true));
    println!(
        "{name:<24} mu {mu:<4} {cold:>8.0} {stay:>8.0} {:>5.2}   {other:>8.0} {change:>8.0} {:>5.2}",
        stay / cold,
        change / other
    );
}
