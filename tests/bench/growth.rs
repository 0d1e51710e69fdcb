//! How time and iterations grow with the number of pairs: the bar on the plane by the default
//! method, `cargo bench --bench growth`. Minimum of repeats, one thread.

mod bar;

use std::time::Instant;

use signorini::{
    ContactData, ContactProblem, Friction, Method, Monitor, Settings, Solution, solve,
};

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let most: usize = std::env::var("MOST").ok().and_then(|v| v.parse().ok()).unwrap_or(1025);
    let rows: usize = std::env::var("ROWS").ok().and_then(|v| v.parse().ok()).unwrap_or(8);
    let mut pairs = 33;
    while pairs <= most {
        let bar = bar::bar(pairs - 1, rows, 1.5, 10.0);
        let waves = 3.0 * std::f64::consts::TAU / (bar.pairs - 1) as f64;
        let gap: Vec<f64> =
            (0..bar.pairs).map(|i| 2e-3 * (1.0 - (i as f64 * waves).cos())).collect();
        let zero = vec![0.0; bar.pairs];
        for mu in [0.0, 0.1, 0.3, 1.0] {
            let gap = if mu == 0.0 { &gap } else { &zero };
            let coefficients = vec![mu; bar.pairs];
            let problem = ContactProblem::new(ContactData {
                dim: 2,
                pairs: bar.pairs,
                stiffness: &bar.stiffness,
                ld: 2 * bar.pairs,
                load: &bar.load,
                gap,
                friction: Friction::Coulomb(&coefficients),
                previous_slip: None,
            })
            .unwrap();
            let method = if mu == 0.0 { Method::Pivot } else { Method::Newton };
            let settings = Settings { method, tolerance: 1e-12, ..Settings::default() };
            let mut best = f64::INFINITY;
            let mut s: Option<Solution> = None;
            let repeats = if std::env::var("DBG").is_ok() { 1 } else { 3 }
                * (70_000 / (pairs * pairs)).clamp(1, 60);
            for _ in 0..repeats {
                let begin = Instant::now();
                s = Some(
                    solve(&problem, &settings, None, &mut Monitor::new(&settings, None)).unwrap(),
                );
                best = best.min(begin.elapsed().as_secs_f64());
            }
            let s = s.unwrap();
            println!(
                "{pairs:5} mu {mu:3} {:?} {:8.3} ms, {:3} its {:3} factorisations eta {:.1e} {}",
                s.status,
                1e3 * best,
                s.iterations,
                s.factorisations,
                s.certificate.eta,
                s.message
            );
        }
        pairs = 2 * pairs - 1;
    }
}
