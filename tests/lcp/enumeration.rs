//! LCPs `w = q + M z`, by Lemke's method and by the default method, which falls back to it: against
//! enumeration of all complementary bases.

use crate::common::bare::Bare;
use crate::common::problems::{decades, definite, semidefinite, uniform, vector};
use fastrand::Rng;
use signorini::{Method, Settings, Status};

/// Solves `count` problems by both; returns how many were solved, proved infeasible, given up where there is a
/// solution, and given up otherwise.
fn run(
    count: u64,
    make: impl Fn(&mut Rng, usize) -> Vec<f64>,
    allowed: impl Fn(Status) -> bool,
) -> [usize; 4] {
    let mut counts = [0; 4];
    for seed in 0..count {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=8);
        let mut data = Bare { n, m: make(&mut rng, n), q: right_hand_side(&mut rng, n) };
        if rng.u8(0..4) == 0 {
            duplicate(&mut rng, &mut data);
        }
        // Decisions closer than this are left to rounding: bases of condition 1e6.
        let margin = data.margin();
        for method in [Method::Lemke, Method::Auto] {
            let settings = Settings { method, max_iterations: 5000, ..Settings::default() };
            let solution = data.solve(&settings);
            let context = || format!("seed {seed}\n{data:?}\n{solution:?}");
            assert!(allowed(solution.status), "{}", context());
            assert_eq!(data.flaw(&solution, settings.tolerance), None, "{}", context());
            match solution.status {
                Status::Solved => assert!(margin > -1e-7, "margin {margin}: {}", context()),
                Status::NoEquilibrium => assert!(margin < -1e-12, "margin {margin}: {}", context()),
                _ => {}
            }
            counts[match solution.status {
                Status::Solved => 0,
                Status::NoEquilibrium => 1,
                _ if margin > 1e-7 => 2,
                _ => 3,
            }] += 1;
        }
    }
    counts
}

/// Random; with equal entries; of few whole numbers; zero; without negative entries.
fn right_hand_side(rng: &mut Rng, n: usize) -> Vec<f64> {
    match rng.u8(0..12) {
        0 => vec![0.0; n],
        1 => vec![-1.0; n],
        2 => vector(rng, n).iter().map(|q| q.abs()).collect(),
        3..6 => (0..n).map(|_| f64::from(rng.i32(-1..=1))).collect(),
        _ => vector(rng, n),
    }
}

/// Makes unknown `j` a copy of unknown `i`: same row, same column, same `q`.
fn duplicate(rng: &mut Rng, data: &mut Bare) {
    let n = data.n;
    let (i, j) = (rng.usize(0..n), rng.usize(0..n));
    for k in 0..n {
        data.m[j + k * n] = data.m[i + k * n];
    }
    for k in 0..n {
        data.m[k + j * n] = data.m[k + i * n];
    }
    data.q[j] = data.q[i];
}

fn add_skew(rng: &mut Rng, n: usize, m: &mut [f64], size: f64) {
    for i in 0..n {
        for j in 0..i {
            let skew = uniform(rng, -size, size);
            m[i + j * n] += skew;
            m[j + i * n] -= skew;
        }
    }
}

/// Symmetric of rank `rank`.
fn deficient(rng: &mut Rng, n: usize, rank: usize) -> Vec<f64> {
    let kernel: Vec<Vec<f64>> = (rank..n).map(|_| vector(rng, n)).collect();
    let condition = decades(rng, 3.0);
    semidefinite(rng, n, condition, &kernel)
}

fn solved(status: Status) -> bool {
    status == Status::Solved
}

fn decided(status: Status) -> bool {
    matches!(status, Status::Solved | Status::NoEquilibrium)
}

/// Positive semi-definite, symmetric or not, of any rank: a solution, or the proof that nothing is
/// feasible (Cottle, Pang, Stone, *The Linear Complementarity Problem*, sections 3.1 and 4.4).
#[test]
fn decides_positive_semidefinite_problems() {
    let counts = run(
        4000,
        |rng, n| {
            let rank = rng.usize(0..=n);
            let mut m = deficient(rng, n, rank);
            if rng.bool() {
                add_skew(rng, n, &mut m, 1.0);
            }
            m
        },
        decided,
    );
    assert!(counts[1] > 400, "{counts:?}: too few are infeasible to test anything");
}

/// Semi-definite problems of small whole numbers are decided whatever the covering vector, whose entries here differ by up to 1e12 and
/// take the digits of the path with it.
#[test]
fn decides_problems_with_any_covering_vector() {
    for seed in 0..8000 {
        let rng = &mut Rng::with_seed(seed);
        let n = rng.usize(2..=5);
        let mut whole = |most: i32| f64::from(rng.i32(-most..=most));
        let rows: Vec<Vec<f64>> = (0..n / 2).map(|_| (0..n).map(|_| whole(3)).collect()).collect();
        let mut m: Vec<f64> =
            (0..n * n).map(|at| rows.iter().map(|row| row[at % n] * row[at / n]).sum()).collect();
        for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let skew = whole(3);
            m[i + j * n] += skew;
            m[j + i * n] -= skew;
        }
        let q = (0..n).map(|_| whole(4)).collect();
        let data = Bare { n, m, q };
        let cover: Vec<f64> = (0..n).map(|_| 10_f64.powf(uniform(rng, -6.0, 6.0))).collect();
        let settings = Settings::default();
        let solution = data.solve_covered(&settings, Some(&cover));
        let context = || format!("seed {seed}\n{data:?}\n{cover:?}\n{solution:?}");
        assert!(decided(solution.status), "{}", context());
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{}", context());
    }
}

/// Copies of one unknown leave definite matrices semi-definite, but every `q` feasible.
#[test]
fn solves_positive_definite_problems() {
    run(
        3000,
        |rng, n| {
            let condition = decades(rng, 6.0);
            let mut m = definite(rng, n, condition);
            if rng.bool() {
                add_skew(rng, n, &mut m, 1.0);
            }
            m
        },
        solved,
    );
}

/// P-matrices that are neither symmetric nor definite: rows and columns of dominant ones scaled
/// (minors keep their sign). Exactly one solution (Cottle, Pang, Stone, section 3.3).
#[test]
fn solves_problems_with_p_matrices() {
    run(
        3000,
        |rng, n| {
            let mut m: Vec<f64> = vector(rng, n * n);
            for i in 0..n {
                let sum: f64 = (0..n).filter(|&j| j != i).map(|j| m[i + j * n].abs()).sum();
                m[i + i * n] = sum + uniform(rng, 0.05, 1.0);
            }
            let (rows, columns): (Vec<f64>, Vec<f64>) =
                (0..n).map(|_| (decades(rng, 2.0), decades(rng, 2.0))).unzip();
            for j in 0..n {
                for i in 0..n {
                    m[i + j * n] *= rows[i] * columns[j];
                }
            }
            m
        },
        solved,
    );
}

/// Copositive-plus beyond semi-definite: a strictly copositive block (positive diagonal, nothing
/// negative) and a semi-definite one, joined by a skew part. A solution, or the proof that nothing
/// is feasible (Cottle, Pang, Stone, section 4.4).
#[test]
fn decides_copositive_plus_problems() {
    let counts = run(
        4000,
        |rng, n| {
            let first = rng.usize(0..=n);
            let rank = rng.usize(0..=n - first);
            let block = deficient(rng, n - first, rank);
            let mut m = vec![0.0; n * n];
            for j in 0..first {
                for i in 0..first {
                    m[i + j * n] = if rng.bool() { rng.f64() } else { 0.0 };
                }
                m[j + j * n] = uniform(rng, 0.1, 1.0);
            }
            for j in first..n {
                for i in first..n {
                    m[i + j * n] = block[i - first + (j - first) * (n - first)];
                }
            }
            for j in 0..first {
                for i in first..n {
                    let skew = uniform(rng, -1.0, 1.0);
                    (m[i + j * n], m[j + i * n]) = (skew, -skew);
                }
            }
            m
        },
        decided,
    );
    assert!(counts[1] > 100, "{counts:?}: too few are infeasible to test anything");
}

/// Nothing is known of a general matrix; the answer may be that nothing was found, never wrong.
#[test]
fn is_never_wrong_on_general_problems() {
    let counts = run(
        6000,
        |rng, n| {
            if rng.bool() {
                vector(rng, n * n)
            } else {
                (0..n * n).map(|_| f64::from(rng.i32(-1..=1))).collect()
            }
        },
        |_| true,
    );
    assert!(counts.iter().all(|&count| count > 200), "{counts:?}: one-sided");
    // No theorem says how many; 85 % are found.
    let [found, _, missed, _] = counts;
    assert!(found >= 4 * missed, "{counts:?}: too few of those that have a solution");
}
