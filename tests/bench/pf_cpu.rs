//! Friction in the plane on the families that are hard for Newton's method: who solves them, in what
//! time.
//!
//! `cargo bench --bench plane_families -- PAIRS PROBLEMS`: on each of the four supports as many
//! problems (default: 257 pairs, 40 problems). Counts of those that leave Newton's method; the worst
//! time of a support beside its median.

#[allow(dead_code)]
#[path = "../common/mesh.rs"]
mod mesh;
#[path = "../common/plane_families.rs"]
mod plane_families;

use std::collections::BTreeMap;

use fastrand::Rng;
use plane_families::{SUPPORTS, Structure};
use signorini::{ContactData, ContactProblem, FrictionLaw, Monitor, Settings, Solution, Status};

/// Least time of three runs, as others use the machine too; and the solution.
fn solve(problem: &ContactProblem<'_>) -> (f64, Solution) {
    let settings = Settings::default();
    let runs = (0..3).map(|_| {
        let begin = cpu();
        let solution =
            signorini::solve(problem, &settings, None, &mut Monitor::new(&settings, None));
        (cpu() - begin, solution.expect("the settings fit"))
    });
    runs.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are three runs")
}


fn cpu() -> f64 {
    let mut t = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    unsafe { libc::clock_gettime(libc::CLOCK_THREAD_CPUTIME_ID, &mut t) };
    t.tv_sec as f64 + 1e-9 * t.tv_nsec as f64
}

fn main() {
    let mut numbers = std::env::args().filter_map(|argument| argument.parse().ok());
    let pairs: usize = numbers.next().unwrap_or(257);
    let problems: u64 = numbers.next().unwrap_or(40) as u64;
    for support in SUPPORTS {
        let structure = Structure::new(support, pairs);
        let mut ways: BTreeMap<String, (usize, u64)> = BTreeMap::new();
        let mut times = Vec::new();
        let mut systems = 0;
        for seed in 0..problems {
            let mut rng = Rng::with_seed(seed);
            let case = structure.case(&mut rng);
            let problem = ContactProblem::new(ContactData {
                dim: 2,
                pairs,
                stiffness: &structure.stiffness,
                ld: 2 * pairs,
                load: &case.load,
                gap: &case.gap,
                law: FrictionLaw::Coulomb(&case.mu),
                reference_slip: case.slip.as_deref(),
            });
            let problem = problem.expect("the data is valid");
            let (time, solution) = solve(&problem);
            times.push(time);
            let status = match solution.status {
                Status::Solved => "solved".to_owned(),
                _ => format!("{:?} ({})", solution.status, solution.message),
            };
            let left = solution.fallback.map(|(_, reason)| format!(" after {reason:?}"));
            if left.is_none() && solution.status == Status::Solved {
                systems += solution.iterations;
            } else {
                println!(
                    "  {seed}: {}: {status} by {:?}{}, {} iterations, {} factorisations, {:.1} ms",
                    case.name,
                    solution.method,
                    left.clone().unwrap_or_default(),
                    solution.iterations,
                    solution.factorisations,
                    1e3 * time
                );
            }
            let way = format!("{status} by {:?}{}", solution.method, left.unwrap_or_default());
            let entry = ways.entry(way).or_default();
            *entry = (entry.0 + 1, entry.1.max(solution.iterations));
        }
        times.sort_by(f64::total_cmp);
        let (median, worst) = (times[times.len() / 2], times[times.len() - 1]);
        println!(
            "{support:?}, {pairs} pairs: median {:.2} ms, worst {:.2} ms, ratio {:.1}; {systems} systems where \
             Newton's method sufficed",
            1e3 * median,
            1e3 * worst,
            worst / median
        );
        for (way, (count, most)) in ways {
            println!("    {count:>3} {way}, at most {most} iterations");
        }
    }
}
