//! The flexibility form with a definite `W`: islands of a few pairs in one sparse call, and dense `W` beside the
//! stiffness form of the same bodies and one inversion.
//!
//! `cargo bench --bench flexibility`: minima of seven calls, one thread. A call includes its certificate; the matrices
//! are checked before.

use std::time::Instant;

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, Par, Side};
use fastrand::Rng;
use signorini::reduce::{Indices, SparseMatrix, Triangle};
use signorini::{
    ContactData, ContactProblem, FlexibilityData, FlexibilityProblem, FrictionLaw, Monitor,
    Settings, Solution, State, Status, solve, solve_flexibility,
};

#[path = "../common/beam.rs"]
mod beam;

const MU: f64 = 0.3;
const CALLS: usize = 7;

fn main() {
    faer::set_global_parallelism(Par::Seq);
    println!("Islands of random W in one sparse call, us an island");
    for (pairs, count) in [(1, 5000), (2, 2000), (8, 500)] {
        let [plane, space] = [2, 3].map(|dim| 1e6 * islands(dim, pairs, count) / count as f64);
        println!("{pairs:>3} pairs: {plane:.2} in 2D, {space:.2} in 3D");
    }
    println!(
        "\nDense W, ms: flexibility form, stiffness form, one inversion; the first over the sum"
    );
    for pairs in [64, 200, 400] {
        for dim in [2, 3] {
            for open in [0.2, 0.7] {
                dense(dim, pairs, open);
            }
        }
    }
    for pairs in [64, 200] {
        for height in [0.01, 0.1] {
            for open in [0.0, 0.7] {
                on_floor(pairs, height, open);
            }
        }
    }
}

/// The least time of some calls, in seconds, and the last result, which must be a solution.
fn least(mut call: impl FnMut() -> Solution) -> (f64, Solution) {
    let mut best: Option<(f64, Solution)> = None;
    for _ in 0..CALLS {
        let begin = Instant::now();
        let solution = call();
        let time = begin.elapsed().as_secs_f64();
        assert_eq!(solution.status, Status::Solved, "{}", solution.message);
        let before = best.map_or(f64::INFINITY, |(time, _)| time);
        best = Some((time.min(before), solution));
    }
    best.expect("there are calls")
}

fn numbers(rng: &mut Rng, count: usize) -> Vec<f64> {
    (0..count).map(|_| 2.0 * rng.f64() - 1.0).collect()
}

/// Seconds of so many islands of a random definite `W`.
fn islands(dim: usize, pairs: usize, count: usize) -> f64 {
    let rng = &mut Rng::with_seed(1);
    let (m, n) = (dim * pairs, dim * pairs * count);
    let (mut col_start, mut row, mut values) = (vec![0_i64], vec![], vec![]);
    for island in 0..count {
        let rows: Vec<Vec<f64>> = (0..m)
            .map(|i| {
                let mut row = numbers(rng, m);
                row[i] += 1.5;
                row
            })
            .collect();
        for j in 0..m {
            for i in j..m {
                row.push((island * m + i) as i64);
                values.push(rows[i].iter().zip(&rows[j]).map(|(a, b)| a * b).sum::<f64>());
            }
            col_start.push(row.len() as i64);
        }
    }
    let free = numbers(rng, n);
    let gap: Vec<f64> = (0..n / dim).map(|_| 0.4 * rng.f64() - 0.1).collect();
    let mu = vec![MU; n / dim];
    let problem = FlexibilityProblem::from_sparse(FlexibilityData {
        dim,
        pairs: n / dim,
        flexibility: SparseMatrix {
            size: n,
            col_start: Indices::Wide(&col_start),
            row: Indices::Wide(&row),
            values: &values,
            index_base: 0,
            triangle: Triangle::Lower,
        },
        free: &free,
        gap: &gap,
        law: FrictionLaw::Coulomb(&mu),
        reference_slip: None,
    })
    .expect("valid data");
    let settings = Settings::default();
    let call = || {
        let monitor = &mut Monitor::new(&settings, None);
        solve_flexibility(&problem, &settings, None, monitor).expect("valid data")
    };
    least(call).0
}

/// A beam above a floor that is even, or uneven so that about a part `open` of the pairs is open, pressed upon it.
fn on_floor(pairs: usize, height: f64, open: f64) {
    let (rng, n) = (&mut Rng::with_seed(3), 2 * pairs);
    let k = beam::beam(pairs, height);
    let matrix = Mat::from_fn(n, n, |i, j| k[i + n * j]);
    let inverse = matrix.llt(Side::Lower).expect("a definite matrix").inverse();
    let w: Vec<f64> =
        (0..n * n).map(|at| inverse[((at % n).max(at / n), (at % n).min(at / n))]).collect();
    let load: Vec<f64> = numbers(rng, n).iter().map(|load| 0.3 + load).collect();
    let free: Vec<f64> = (0..n).map(|i| (0..n).map(|j| w[i + n * j] * load[j]).sum()).collect();
    let deepest = free.iter().step_by(2).fold(0.0_f64, |most, q| most.max(*q));
    let gap: Vec<f64> =
        (0..pairs).map(|_| if rng.f64() < open { deepest * rng.f64() } else { 0.0 }).collect();
    let matrix = Mat::from_fn(n, n, |i, j| w[i + n * j]);
    let begin = Instant::now();
    matrix.llt(Side::Lower).expect("a definite matrix").inverse();
    let inversion = begin.elapsed().as_secs_f64();
    beside(&format!("beam of {height}"), (2, &k, &w), (&load, &free, &gap), inversion);
}

/// A `W` that falls off with the distance of components, of which about a part `open` of the pairs is open.
fn dense(dim: usize, pairs: usize, open: f64) {
    let (rng, n) = (&mut Rng::with_seed(3), dim * pairs);
    let own = |i: usize, j: usize| if i == j { 0.5 } else { 0.0 };
    let matrix = Mat::from_fn(n, n, |i, j| 1.0 / (1.0 + i.abs_diff(j) as f64) + own(i, j));
    let begin = Instant::now();
    let inverse = matrix.llt(Side::Lower).expect("a definite matrix").inverse();
    let inversion = begin.elapsed().as_secs_f64();
    let entries = |matrix: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        (0..n * n).map(|at| matrix(at % n, at / n)).collect()
    };
    let w = entries(&|i, j| matrix[(i, j)]);
    let k = entries(&|i, j| inverse[(i.max(j), i.min(j))]);
    let load = numbers(rng, n);
    let product = |a: &[f64], x: &[f64]| -> Vec<f64> {
        (0..n).map(|i| (0..n).map(|j| a[i + n * j] * x[j]).sum()).collect()
    };
    let free = product(&w, &load);
    let gap: Vec<f64> = (0..pairs)
        .map(|pair| {
            let away = if rng.f64() < open { 0.5 } else { -0.5 };
            free[dim * pair] + away * rng.f64()
        })
        .collect();
    beside("falling off", (dim, &k, &w), (&load, &free, &gap), inversion);
}

/// Prints both forms of bodies of a stiffness and a flexibility beside the time of an inversion.
fn beside(
    name: &str,
    (dim, k, w): (usize, &[f64], &[f64]),
    (load, free, gap): (&[f64], &[f64], &[f64]),
    inversion: f64,
) {
    let (pairs, n) = (gap.len(), load.len());
    let mu = vec![MU; pairs];
    let law = FrictionLaw::Coulomb(&mu);
    let problem = FlexibilityProblem::from_flexibility(FlexibilityData {
        dim,
        pairs,
        flexibility: (w, n),
        free,
        gap,
        law,
        reference_slip: None,
    })
    .expect("valid data");
    let stiffness = ContactProblem::new(ContactData {
        dim,
        pairs,
        stiffness: k,
        ld: n,
        load,
        gap,
        law,
        reference_slip: None,
    })
    .expect("valid data");
    let settings = Settings::default();
    let (time, solution) = least(|| {
        let monitor = &mut Monitor::new(&settings, None);
        solve_flexibility(&problem, &settings, None, monitor).expect("valid data")
    });
    let (other, _) = least(|| {
        let monitor = &mut Monitor::new(&settings, None);
        solve(&stiffness, &settings, None, monitor).expect("valid data")
    });
    println!(
        "{name}, {dim}D, {pairs} pairs, {} open: {:.2}, {:.2}, {:.2}; {:.2}",
        solution.certificate.count(State::Open),
        1e3 * time,
        1e3 * other,
        1e3 * inversion,
        time / (other + inversion)
    );
}
