//! Which share of ill-conditioned problems is solved, and how far the answers are from the solution.
//!
//! `cargo bench --bench conditions` writes a table in Markdown. Stiffness: random orthogonal
//! eigenvectors, eigenvalues in geometric progression from 1 down to `1 / condition`, rounded to
//! doubles, and definite as it then is. Loads, gaps and reference slips of order 1, at most 6 unknowns,
//! coefficients of friction up to 2; the default method. The reference solution is found from the
//! answer by Newton's method in twice the precision, on the matrix as rounded.
//! `SIGNORINI_CONDITIONS` sets the number of problems of each column, 100 without it.

#[path = "../common/mod.rs"]
mod common;

use common::dense::{dot, norm as length};
use common::exact::{force, is_definite, quads, refined};
use common::problems::{Case, coulomb, uniform, vector};
use common::quad::{Quad, norm};
use fastrand::Rng;
use signorini::{Settings, Status};

const CONDITIONS: std::ops::RangeInclusive<i32> = 6..=15;
const TOLERANCES: [f64; 3] = [1e-8, 1e-10, 1e-12];
const PROBLEMS: u64 = 100;
const MOST_MU: f64 = 2.0;

fn main() {
    let count = std::env::var("SIGNORINI_CONDITIONS");
    let count = count.map_or(PROBLEMS, |count| count.parse().expect("a number of problems"));
    println!("The default method on {count} random definite problems of each condition number.");
    println!(
        "Shares in per cent; errors relative, the largest of the solved ones, in the Euclidean norm."
    );
    for dim in [2, 3] {
        let head: Vec<String> = CONDITIONS.map(|power| format!(" 1e{power} |")).collect();
        println!("\n| {dim}D, condition |{}", head.concat());
        println!("|---|{}", "---|".repeat(head.len()));
        for tolerance in TOLERANCES {
            let row: Vec<Cell> =
                CONDITIONS.map(|power| cell(dim, 10_f64.powi(power), tolerance, count)).collect();
            let print = |name: &str, text: &dyn Fn(&Cell) -> String| {
                let cells: Vec<String> =
                    row.iter().map(|cell| format!(" {} |", text(cell))).collect();
                println!("| {tolerance:.0e}: {name} |{}", cells.concat());
            };
            print("solved", &|cell| format!("{:.1}", 100.0 * cell.solved as f64 / count as f64));
            print("wrong status 4", &|cell| cell.wrong.to_string());
            print("solved, no solution near", &|cell| cell.alone.to_string());
            print("error of d", &|cell| format!("{:.0e}", cell.error_of_d));
            print("error of F", &|cell| format!("{:.0e}", cell.error_of_force));
        }
    }
}

#[derive(Default)]
struct Cell {
    solved: u64,
    /// Status 4, of a definite matrix.
    wrong: u64,
    /// Solved, and Newton's method finds no solution from the answer.
    alone: u64,
    error_of_d: f64,
    error_of_force: f64,
}

fn cell(dim: usize, condition: f64, tolerance: f64, count: u64) -> Cell {
    let mut cell = Cell::default();
    let settings = Settings { tolerance, ..Settings::default() };
    for seed in 0..count {
        let case = problem(&mut Rng::with_seed(seed), dim, condition);
        let solution = case.solve(&settings);
        cell.wrong += u64::from(solution.status == Status::NoEquilibrium);
        if solution.status != Status::Solved {
            continue;
        }
        cell.solved += 1;
        let start = quads(&solution.d);
        let states = &solution.certificate.states;
        let found = refined(&case, &start, Some(states)).or_else(|| refined(&case, &start, None));
        let Some(d) = found else {
            cell.alone += 1;
            continue;
        };
        let mut exact = force(&case, &d);
        // An open pair carries nothing: what is left is the rounding of the reference.
        exact.iter_mut().zip(&solution.certificate.force).for_each(|(exact, told)| {
            if *told == 0.0 && exact.abs().value() < 1e-20 {
                *exact = Quad::ZERO;
            }
        });
        cell.error_of_d = cell.error_of_d.max(error(&solution.d, &d, norm(&d)));
        let size = if norm(&exact) == Quad::ZERO { norm(&quads(&case.f)) } else { norm(&exact) };
        cell.error_of_force =
            cell.error_of_force.max(error(&solution.certificate.force, &exact, size));
    }
    cell
}

/// `|told - exact| / size`, 0 where nothing differs.
fn error(told: &[f64], exact: &[Quad], size: Quad) -> f64 {
    let difference: Vec<Quad> =
        told.iter().zip(exact).map(|(told, exact)| *exact - Quad::from(*told)).collect();
    let distance = norm(&difference);
    if distance == Quad::ZERO { 0.0 } else { (distance / size).value() }
}

fn problem(rng: &mut Rng, dim: usize, condition: f64) -> Case {
    loop {
        let pairs = rng.usize(1..=6 / dim);
        let k = geometric(rng, dim * pairs, condition);
        let law = coulomb(rng, pairs, MOST_MU);
        let f = vector(rng, dim * pairs);
        let gap = (0..pairs).map(|_| uniform(rng, -1.0, 1.0)).collect();
        let slip = rng.bool().then(|| vector(rng, (dim - 1) * pairs));
        let case = Case { dim, pairs, k, f, gap, law, slip };
        if is_definite(&case, 0.0) {
            return case;
        }
    }
}

/// `sum condition^(-i / (n - 1)) q_i q_iᵀ`, with random orthogonal `q_i`, by columns.
fn geometric(rng: &mut Rng, n: usize, condition: f64) -> Vec<f64> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    while basis.len() < n {
        let mut q = vector(rng, n);
        let before = length(&q);
        for _ in 0..2 {
            for other in &basis {
                let share = dot(other, &q);
                q.iter_mut().zip(other).for_each(|(q, other)| *q -= share * other);
            }
        }
        let after = length(&q);
        if after > 1e-3 * before {
            basis.push(q.iter().map(|q| q / after).collect());
        }
    }
    let mut k = vec![0.0; n * n];
    for (index, q) in basis.iter().enumerate() {
        let value = condition.powf(-(index as f64) / (n - 1) as f64);
        for i in 0..n {
            (0..=i).for_each(|j| k[i + j * n] += value * q[i] * q[j]);
        }
    }
    for i in 0..n {
        (0..i).for_each(|j| k[j + i * n] = k[i + j * n]);
    }
    k
}
