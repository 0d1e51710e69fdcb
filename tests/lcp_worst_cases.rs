//! Problems that are hard for Lemke's method: built to be, with answers in closed form, or
//! degenerate at every pivot.

mod common;

use common::bare::Bare;
use common::dense::{difference, largest};
use fastrand::Rng;
use signorini::{Lcp, Settings, Status};

/// Unit lower triangular with 2 below the diagonal, `q_i = -(2^(n-i) + … + 2^n)`: the path visits
/// every complementary basis. The solution is `z = 2^n e_0`, `w_i = 2^(n-i)` for `i > 0`.
/// K. G. Murty, *Linear Complementarity, Linear and Nonlinear Programming* (1988), chapter 6.
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
        let data = Bare { n, m, q };
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
        let data = Bare { n, m, q: vec![-1.0; n] };
        let solution = data.solve(&Settings { max_iterations: 1 << 20, ..Settings::default() });
        assert_eq!(solution.status, Status::Solved, "{n}: {}", solution.message);
        let z: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == 0))).collect();
        // Condition of M below 9^2 n^2 = 1e5, rounding 1e-16.
        assert!(largest(&difference(&solution.z, &z)) <= 1e-10, "{n}: {:?}", solution.z);
    }
}

/// Ties at every pivot: without a rule the path may return to where it was. There are at
/// most `n 2^(n-1) + 1` bases on it, 193 for the 6 unknowns here: 1000 pivots would be a cycle.
#[test]
fn does_not_cycle_on_degenerate_problems() {
    let settings = Settings { max_iterations: 1000, ..Settings::default() };
    let check = |data: Bare, seed| {
        let solution = data.solve(&settings);
        assert_eq!(data.flaw(&solution, settings.tolerance), None, "{seed} {data:?}\n{solution:?}");
    };
    #[rustfmt::skip]
    let five = [
        1.0, -1.0, 1.0, 0.0, 1.0, -1.0, 1.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 1.0, 0.0, -1.0,
        1.0, 1.0, 0.0, -1.0, 1.0, -1.0, 1.0, 0.0,
    ];
    check(Bare { n: 5, m: five.to_vec(), q: vec![-1.0; 5] }, 0);
    #[rustfmt::skip]
    let six = [
        0.0, -1.0, 0.0, -1.0, -1.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 1.0,
        0.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0, -1.0, -1.0, -1.0, 0.0, 0.0, 1.0, -1.0, 1.0, 1.0, -1.0,
        1.0, 0.0,
    ];
    check(Bare { n: 6, m: six.to_vec(), q: vec![0.0, 0.0, -1.0, -1.0, -1.0, -1.0] }, 0);
    for seed in 1..200_000 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(2..=6);
        let m = (0..n * n).map(|_| f64::from(rng.i32(-1..=1))).collect();
        let q = (0..n).map(|_| f64::from(rng.i32(-1..=0))).collect();
        check(Bare { n, m, q }, seed);
    }
}

/// `q = (0, -1)` is feasible with `M = diag(0, 1)`, by `z = (0, 1)`. A vector that is `e_0` but for
/// rounding does not prove the contrary, though all of its little `q.y` is negative.
#[test]
fn rounding_does_not_prove_infeasibility() {
    let lcp = Lcp::new(2, &[0.0, 0.0, 0.0, 1.0], 2, &[0.0, -1.0], None).unwrap();
    for noise in [0.0, 1e-17, 1e-16, 1e-15] {
        assert!(!lcp.is_infeasible_by(&[1.0, noise]), "{noise}");
    }
    // Without the 1 it is not feasible, and e_1 proves it.
    let lcp = Lcp::new(2, &[0.0; 4], 2, &[0.0, -1.0], None).unwrap();
    assert!(lcp.is_infeasible_by(&[0.0, 1.0]) && lcp.is_infeasible_by(&[1e-17, 1.0]));
    assert!(!lcp.is_infeasible_by(&[0.0, -1.0]) && !lcp.is_infeasible_by(&[0.0, 0.0]));
}
