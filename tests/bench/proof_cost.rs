//! Cost of a proof that a solution exists, in units of the solution without it.
//!
//! `cargo bench --bench proof_cost`. Times are the least of seven, both in turn, on one thread.

mod bar;
#[path = "../common/mod.rs"]
mod common;

use std::time::Instant;

use bar::{Top, bar_with_top};
use common::blocks::{LOADINGS, block, loaded};
use common::brick::Support;
use signorini::{
    ContactData, ContactProblem, Existence, FrictionLaw, Monitor, Settings, Status, solve,
};

const RUNS: usize = 7;

fn main() {
    println!("problem                    pairs    mu   solution ms   proof/solution   proved");
    for (name, top) in [("bar, pressed", Top::Pressed), ("bar, clamped", Top::Clamped(0.02))] {
        for columns in [32, 128, 512] {
            let bar = bar_with_top(columns, 10, 1.5, 10.0, top);
            let gap: Vec<f64> = (0..bar.pairs).map(|i| 1e-4 * (i as f64).sin()).collect();
            for mu in [0.0, 0.3, 1.0, 3.0] {
                let mu = vec![mu; bar.pairs];
                let data = ContactData {
                    dim: 2,
                    pairs: bar.pairs,
                    stiffness: &bar.stiffness,
                    ld: 2 * bar.pairs,
                    load: &bar.load,
                    gap: &gap,
                    law: FrictionLaw::Coulomb(&mu),
                    reference_slip: None,
                };
                report(name, mu[0], &ContactProblem::new(data).expect("a valid problem"));
            }
        }
    }
    for edge in [5, 9, 15] {
        let brick = block(edge, Support::Clamped);
        let model = brick.model();
        for mu in [0.0, 0.2, 0.6, 3.0] {
            for loading in LOADINGS {
                let case = loaded(&brick, &model, loading, mu);
                report(&format!("block, {loading:?}"), mu, &case.problem());
            }
        }
    }
}

fn report(name: &str, mu: f64, problem: &ContactProblem<'_>) {
    let mut least = [f64::INFINITY; 2];
    let mut proved = false;
    for _ in 0..RUNS {
        for (with, least) in least.iter_mut().enumerate() {
            let settings = Settings { proof: with == 1, ..Settings::default() };
            let begin = Instant::now();
            let solution = solve(problem, &settings, None, &mut Monitor::new(&settings, None))
                .expect("the settings fit");
            *least = least.min(begin.elapsed().as_secs_f64());
            assert_eq!(solution.status, Status::Solved, "{name}");
            proved = matches!(solution.existence, Existence::Proved(_));
        }
    }
    let [plain, with] = least;
    let pairs = problem.pairs();
    let (time, ratio) = (1e3 * plain, (with - plain) / plain);
    println!("{name:<26} {pairs:5} {mu:5} {time:13.3} {ratio:16.2}   {proved}");
}
