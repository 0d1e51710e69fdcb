//! Problems in flexibility form that have a solution, as they are made from one: definite, singular and in islands.
//!
//! `SIGNORINI_FLEXIBLE=2000 cargo test --release --test families -- flexible:: --nocapture` tries as many of each.

use crate::common::dense::{difference, product};
use crate::common::flexible::{Case, gram};
use crate::common::problems::{uniform, vector};
use fastrand::Rng;
use signorini::Status;

/// Problems of each kind without the variable.
const PROBLEMS: u64 = 250;

/// Rows whose products are the flexibility.
fn rows(rng: &mut Rng, kind: Kind, dim: usize, pairs: usize) -> Vec<Vec<f64>> {
    let n = dim * pairs;
    match kind {
        Kind::Definite => (0..n)
            .map(|i| {
                let own = (0..n).map(|j| f64::from(u8::from(i == j)));
                own.zip(vector(rng, n)).map(|(own, other)| 0.1 * own + other).collect()
            })
            .collect(),
        Kind::Singular => {
            let rank = rng.usize(1..=n);
            (0..n).map(|_| vector(rng, rank)).collect()
        }
        Kind::Islands => {
            let islands = rng.usize(1..=3);
            let rank = 2 * dim;
            let island: Vec<usize> = (0..pairs).map(|_| rng.usize(0..islands)).collect();
            (0..n)
                .map(|i| {
                    let mut row = vec![0.0; rank * islands];
                    let first = rank * island[i / dim];
                    row[first..first + rank].copy_from_slice(&vector(rng, rank));
                    row
                })
                .collect()
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    Definite,
    Singular,
    Islands,
}

/// A problem, made from displacements and forces that obey the law.
fn problem(rng: &mut Rng, kind: Kind, most_mu: f64) -> Case {
    let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=8));
    let n = dim * pairs;
    let w = gram(&rows(rng, kind, dim, pairs));
    let mut case = Case::new(dim, w, vec![0.0; n], 0.0);
    let (mut d, mut force) = (vec![0.0; n], vec![0.0; n]);
    for pair in 0..pairs {
        let (i, mu) = (dim * pair, most_mu * rng.f64());
        (case.mu[pair], case.gap[pair]) = (mu, uniform(rng, -0.5, 0.5));
        d[i] = case.gap[pair];
        let along = vector(rng, dim - 1);
        let length = along.iter().map(|a| a * a).sum::<f64>().sqrt();
        let state = rng.usize(0..3);
        if state == 0 {
            d[i] -= rng.f64();
            d[i + 1..i + dim].copy_from_slice(&along);
            continue;
        }
        force[i] = -rng.f64();
        let (share, slip) = if state == 1 { (rng.f64(), 0.0) } else { (1.0, rng.f64()) };
        for c in 1..dim {
            let h = along[c - 1] / length;
            (force[i + c], d[i + c]) = (share * mu * force[i] * h, slip * h);
        }
    }
    case.q = difference(&d, &product(&case.w, &force));
    case
}

/// Parts that may still be unsolved, with friction up to 2 and up to 50. Of 2000 of each kind one was, of singular ones
/// with friction up to 50.
const STILL: [(f64, f64); 2] = [(2.0, 0.0), (50.0, 0.01)];

/// None is said to have no solution, and what is solved passes the judge.
#[test]
fn problems_with_a_solution_are_solved() {
    let count =
        std::env::var("SIGNORINI_FLEXIBLE").ok().map(|text| text.parse().expect("a number"));
    let count = count.unwrap_or(PROBLEMS);
    let mut wrong = 0_u64;
    for kind in [Kind::Definite, Kind::Singular, Kind::Islands] {
        for (most_mu, still) in STILL {
            let mut unsolved = 0_u32;
            for seed in 0..count {
                let case = problem(&mut Rng::with_seed(seed), kind, most_mu);
                let solution = case.solve();
                assert_ne!(solution.status, Status::NoEquilibrium, "{kind:?}, seed {seed}");
                if solution.status != Status::Solved {
                    unsolved += 1;
                    println!("{kind:?}, mu to {most_mu}, seed {seed}: {}", solution.message);
                    continue;
                }
                // The tolerance is 1e-10 of norms; the unit of tangents is up to half of the judge's.
                let error = case.judged(&solution.d, &solution.certificate.force);
                assert!(error <= 1e-9, "{kind:?}, seed {seed}: {error:e}");
            }
            println!("{kind:?}, mu to {most_mu}: {unsolved} of {count} unsolved");
            wrong += u64::from(f64::from(unsolved) > still * count as f64);
        }
    }
    assert_eq!(wrong, 0, "more are unsolved than allowed");
}
