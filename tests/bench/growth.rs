//! How time and work grow with the number of pairs, by the default method.
//!
//! `cargo bench --bench growth`: the bar on the plane (paper, section 4.1) on meshes that are
//! refined with the contact line, 33 to 2049 pairs, one thread. Times are minima of repeats and
//! hold one load case of a model; the exponent is that of the last three doublings.

#[allow(dead_code)]
#[path = "../common/mesh.rs"]
mod mesh;

#[path = "../common/graded_bar.rs"]
mod graded_bar;

use std::time::Instant;

use faer::Par;
use graded_bar::GradedBar;
use signorini::{FrictionLaw, LoadCase, Monitor, Settings, Solution, Status};

const COEFFICIENTS: [f64; 4] = [0.0, 0.1, 0.3, 1.0];

fn main() {
    faer::set_global_parallelism(Par::Seq);
    println!("The bar on the plane by the default method, eta <= 1e-12");
    println!(
        "ms of a load case, linear systems / factorisations; without friction the gap is wavy"
    );
    println!(
        "{:>5} {}",
        "pairs",
        COEFFICIENTS.map(|mu| format!("{:>22}", format!("mu {mu}"))).join("")
    );
    let mut times = Vec::new();
    for pairs in (5..=11).map(|power| (1 << power) + 1) {
        let bar = GradedBar::new(pairs - 1);
        let row = COEFFICIENTS.map(|mu| time(&bar, mu));
        let cells = row.iter().map(|(time, solution)| {
            let work = format!("{:>3}/{}", solution.iterations, solution.factorisations);
            format!("{:>16.3} {work:<5}", 1e3 * time)
        });
        println!("{pairs:>5} {}", cells.collect::<String>());
        times.push(row.map(|(time, _)| time));
    }
    let last = times.len() - 1;
    let exponents = (0..COEFFICIENTS.len()).map(|k| {
        let exponent = (times[last][k] / times[last - 3][k]).log2() / 3.0;
        format!("{exponent:>16.2}      ")
    });
    println!("time ~ pairs^ {}", exponents.collect::<String>().split_off(8));
}

/// Least time of a load case, and its solution.
fn time(bar: &GradedBar, mu: f64) -> (f64, Solution) {
    let pairs = bar.model.pairs();
    let wave = 3.0 * std::f64::consts::TAU / (pairs - 1) as f64;
    let gap = |i: usize| if mu == 0.0 { 2e-3 * (1.0 - (wave * i as f64).cos()) } else { 0.0 };
    let gap: Vec<f64> = (0..pairs).map(gap).collect();
    let case = LoadCase {
        load: &bar.load,
        prescribed: None,
        gap: &gap,
        law: FrictionLaw::Coulomb(&vec![mu; pairs]),
        reference_slip: None,
    };
    let settings = Settings { tolerance: 1e-12, ..Settings::default() };
    let mut least = (f64::INFINITY, None);
    for _ in 0..(100_000 / (pairs * pairs)).clamp(3, 50) {
        let monitor = &mut Monitor::new(&settings, None);
        let begin = Instant::now();
        let solution = bar.model.solve(&case, &settings, None, monitor).expect("a valid case");
        let time = begin.elapsed().as_secs_f64();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        if time < least.0 {
            least = (time, Some(solution));
        }
    }
    (least.0, least.1.expect("it was solved"))
}
