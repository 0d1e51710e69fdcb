//! Problems built to be hard for Lemke's method, with answers in closed form.

mod common;

use common::bare::Bare;
use common::dense::{difference, largest};
use signorini::{Settings, Status};

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
