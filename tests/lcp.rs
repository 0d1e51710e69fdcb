//! Lemke's method on bare complementarity problems `w = q + M z`: against enumeration of all
//! complementary bases, and on the problems that are hardest for it.

mod common;

use common::dense::{Elimination, best_margin, difference, dot, largest, norm};
use common::problems::{decades, definite, semidefinite, uniform, vector};
use fastrand::Rng;
use signorini::{Lcp, LcpSolution, Monitor, Settings, Status, solve_lcp};

/// A problem with its arrays, `m` column-major.
#[derive(Clone, Debug)]
struct Data {
    n: usize,
    m: Vec<f64>,
    q: Vec<f64>,
}

impl Data {
    fn solve(&self, settings: &Settings) -> LcpSolution {
        let lcp = Lcp::new(self.n, &self.m, self.n.max(1), &self.q, None).unwrap();
        solve_lcp(&lcp, settings, &mut Monitor::new(settings, None)).unwrap()
    }

    fn row(&self, i: usize) -> Vec<f64> {
        (0..self.n).map(|j| self.m[i + j * self.n]).collect()
    }

    fn column(&self, j: usize) -> &[f64] {
        &self.m[j * self.n..(j + 1) * self.n]
    }

    /// How strictly the best complementary basis can be filled, relative to `q`; negative: there is
    /// no solution. In each, `w_i` or `z_i` is free to be positive for every `i`, a square system;
    /// a singular one that is consistent has a flat of candidates, searched by elimination.
    fn margin(&self) -> f64 {
        let n = self.n;
        let unit = largest(&self.q).max(f64::MIN_POSITIVE);
        let mut best = f64::NEG_INFINITY;
        for choice in 0..1_usize << n {
            // Rows of: sum over chosen z of -M_j z_j + sum over chosen w of e_j w_j = q.
            let mut basis = vec![0.0; n * n];
            for j in 0..n {
                for i in 0..n {
                    basis[i * n + j] = match choice >> j & 1 {
                        0 => f64::from(u8::from(i == j)),
                        _ => -self.m[i + j * n],
                    };
                }
            }
            let elimination = Elimination::new(n, &basis);
            let (point, left) = elimination.solve(&self.q);
            if left <= 1e-9 * unit {
                best = best.max(best_margin(&point, &elimination.kernel()) / unit);
            }
        }
        best
    }

    /// Why `solution` is not one, or proves nothing.
    fn flaw(&self, solution: &LcpSolution, tolerance: f64) -> Option<String> {
        let LcpSolution { w, z, .. } = solution;
        if w.iter().chain(z).any(|x| !(*x >= 0.0)) {
            return Some("negative".into());
        }
        match solution.status {
            Status::Solved => {
                if (0..self.n).any(|i| w[i] != 0.0 && z[i] != 0.0) {
                    return Some("not complementary".into());
                }
                let product: Vec<f64> = (0..self.n).map(|i| dot(&self.row(i), z)).collect();
                // The tolerance is on min(w, m z) with w = q + M z; the returned w is cut off by
                // that much at most. Twice, as the rounding of M z is counted here again.
                let error: Vec<f64> = (0..self.n).map(|i| self.q[i] + product[i] - w[i]).collect();
                let scale = norm(&self.q).max(norm(&product));
                let excess = norm(&error) > 2.0 * tolerance * scale;
                excess.then(|| format!("w = q + M z is {error:?} off"))
            }
            Status::NoEquilibrium => {
                // Farkas: y >= 0, Mᵀ y <= 0, q.y < 0 leave no w, z >= 0, as w.y = q.y + z.Mᵀy.
                // Zero is anything below 1e-10 of the parts.
                let size = |j: usize| largest(self.column(j)) * largest(z);
                let bad = (0..self.n).find(|&j| dot(self.column(j), z) > 1e-10 * size(j));
                match bad {
                    Some(j) => Some(format!("(Mᵀ y)[{j}] = {:e} > 0", dot(self.column(j), z))),
                    None if dot(&self.q, z) < 0.0 => None,
                    None => Some("q.y is not negative".into()),
                }
            }
            Status::Stalled => None,
            other => Some(format!("no reason to end with {other:?}")),
        }
    }
}

/// Solves `count` problems; returns how many were solved, proved infeasible, and given up.
fn run(
    count: u64,
    make: impl Fn(&mut Rng, usize) -> Vec<f64>,
    allowed: impl Fn(Status) -> bool,
) -> [usize; 3] {
    let settings = Settings { max_iterations: 2000, ..Settings::default() };
    let mut counts = [0; 3];
    for seed in 0..count {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(1..=8);
        let mut data = Data { n, m: make(&mut rng, n), q: right_hand_side(&mut rng, n) };
        if rng.u8(0..4) == 0 {
            duplicate(&mut rng, &mut data);
        }
        let solution = data.solve(&settings);
        let context = || format!("seed {seed}\n{data:?}\n{solution:?}");
        assert!(allowed(solution.status), "{}", context());
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{}", context());
        // Decisions closer than this are left to rounding: bases of condition 1e6.
        let margin = data.margin();
        match solution.status {
            Status::Solved => assert!(margin > -1e-7, "margin {margin}: {}", context()),
            Status::NoEquilibrium => assert!(margin < -1e-12, "margin {margin}: {}", context()),
            _ => {}
        }
        counts[match solution.status {
            Status::Solved => 0,
            Status::NoEquilibrium => 1,
            _ => 2,
        }] += 1;
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
fn duplicate(rng: &mut Rng, data: &mut Data) {
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
/// feasible (Cottle, Pang, Stone, *The Linear Complementarity Problem*, 3.1.2 and 4.4.11).
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
/// (minors keep their sign). Exactly one solution (Cottle, Pang, Stone, 3.3.7).
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
/// is feasible (Cottle, Pang, Stone, 4.4.11).
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

/// Of a general matrix nothing is known; the answer may be that nothing was found, never wrong.
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
}

/// Unit lower triangular with 2 below the diagonal, `q_i = -(2^(n-i) + … + 2^n)`: the path visits
/// every complementary basis. The solution is `z = 2^n e_0`, `w_i = 2^(n-i)` for `i > 0`.
/// K. G. Murty, Mathematical Programming Study 7 (1978) 61-73; Cottle, Pang, Stone, 6.6.
#[test]
fn takes_two_to_the_n_pivots_on_murtys_worst_case() {
    for n in [4_usize, 6, 8, 10] {
        let power = |e: usize| 2_f64.powi(e as i32);
        let m = (0..n * n)
            .map(|k| match (k % n).cmp(&(k / n)) {
                std::cmp::Ordering::Less => 0.0,
                std::cmp::Ordering::Equal => 1.0,
                std::cmp::Ordering::Greater => 2.0,
            })
            .collect();
        let q = (0..n).map(|i| -(n - i..=n).map(power).sum::<f64>()).collect();
        let data = Data { n, m, q };
        let solution = data.solve(&Settings::default());
        assert_eq!(solution.status, Status::Solved);
        assert_eq!(solution.iterations, 1 << n);
        let z: Vec<f64> = (0..n).map(|i| if i == 0 { power(n) } else { 0.0 }).collect();
        let w: Vec<f64> = (0..n).map(|i| if i == 0 { 0.0 } else { power(n - i) }).collect();
        // Whole numbers below 2^11: a few units of rounding of the largest.
        assert!(largest(&difference(&solution.z, &z)) <= 1e-12 * power(n), "{solution:?}");
        assert!(largest(&difference(&solution.w, &w)) <= 1e-12 * power(n), "{solution:?}");

        let budget = (1 << n) - 1;
        let short = data.solve(&Settings { max_iterations: budget, ..Settings::default() });
        assert_eq!(short.status, Status::IterationLimit);
        assert_eq!(short.iterations, budget);
        let enough = data.solve(&Settings { max_iterations: budget + 1, ..Settings::default() });
        assert_eq!(enough.status, Status::Solved);
    }
}

/// `M = L Lᵀ` with that triangular `L`, `q = -1`: definite, and `z = e_0`, `w = (0, 1, …, 1)` since
/// the first column of `M` is `(1, 2, …, 2)`. Y. Fathi, Mathematical Programming 17 (1979) 335-344.
#[test]
fn solves_fathis_problem() {
    for n in [1_usize, 2, 4, 8, 16, 32] {
        let lower = |i: usize, j: usize| {
            if i == j {
                1.0
            } else if i > j {
                2.0
            } else {
                0.0
            }
        };
        let m =
            (0..n * n).map(|k| (0..n).map(|l| lower(k % n, l) * lower(k / n, l)).sum()).collect();
        let data = Data { n, m, q: vec![-1.0; n] };
        let solution = data.solve(&Settings { max_iterations: 1 << 20, ..Settings::default() });
        assert_eq!(solution.status, Status::Solved, "{n}: {}", solution.message);
        let z: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == 0))).collect();
        // Condition of M below 9^2 n^2 = 1e5, rounding 1e-16.
        assert!(largest(&difference(&solution.z, &z)) <= 1e-10, "{n}: {:?}", solution.z);
    }
}
