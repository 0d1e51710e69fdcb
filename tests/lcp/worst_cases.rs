//! Problems that are hard for methods of pivoting: built to be, with answers in closed form, or
//! degenerate at every pivot.

use crate::common::bare::Bare;
use crate::common::dense::{difference, largest};
use fastrand::Rng;
use signorini::{Lcp, LcpSolution, Method, Settings, Status};

fn lemke() -> Settings {
    Settings { method: Method::Lemke, ..Settings::default() }
}

/// Unit lower triangular with 2 below the diagonal.
fn lower(i: usize, j: usize) -> f64 {
    match i.cmp(&j) {
        std::cmp::Ordering::Less => 0.0,
        std::cmp::Ordering::Equal => 1.0,
        std::cmp::Ordering::Greater => 2.0,
    }
}

/// `M` is that triangle, `q_i = -(2^(n-i) + … + 2^n)`: Lemke's path visits every complementary
/// basis. The solution is `z = 2^n e_0`, `w_i = 2^(n-i)` for `i > 0`.
/// K. G. Murty, *Linear Complementarity, Linear and Nonlinear Programming* (1988), chapter 6.
fn murty(n: usize) -> Bare {
    let power = |e: usize| 2_f64.powi(e as i32);
    let m = (0..n * n).map(|k| lower(k % n, k / n)).collect();
    let q = (0..n).map(|i| -(n - i..=n).map(power).sum::<f64>()).collect();
    Bare { n, m, q }
}

/// Whole numbers below `2^(n+1)`: a few units of rounding of the largest.
fn assert_murtys_solution(solution: &LcpSolution) {
    let n = solution.z.len();
    let power = |e: usize| 2_f64.powi(e as i32);
    let z: Vec<f64> = (0..n).map(|i| if i == 0 { power(n) } else { 0.0 }).collect();
    let w: Vec<f64> = (0..n).map(|i| if i == 0 { 0.0 } else { power(n - i) }).collect();
    assert!(largest(&difference(&solution.z, &z)) <= 1e-12 * power(n), "{solution:?}");
    assert!(largest(&difference(&solution.w, &w)) <= 1e-12 * power(n), "{solution:?}");
}

#[test]
fn lemke_takes_two_to_the_n_pivots_on_murtys_worst_case() {
    for n in [4_usize, 6, 8, 10] {
        let data = murty(n);
        let solution = data.solve(&lemke());
        assert_eq!(solution.status, Status::Solved);
        assert_eq!(solution.iterations, 1 << n);
        assert_murtys_solution(&solution);

        let budget = (1 << n) - 1;
        let short = data.solve(&Settings { max_iterations: budget, ..lemke() });
        assert_eq!(short.status, Status::IterationLimit);
        assert_eq!(short.iterations, budget);
        let enough = data.solve(&Settings { max_iterations: budget + 1, ..lemke() });
        assert_eq!(enough.status, Status::Solved);
    }
}

/// With a budget that ends Lemke's method. (Exchanges of whole blocks take `n + 1` systems, as on
/// Fathi's problem; exchanges of single unknowns may take `2^n`.)
#[test]
fn the_default_solves_murtys_worst_case_in_a_small_budget() {
    for n in [4_usize, 8, 12, 16, 24, 32, 40] {
        let data = murty(n);
        let budget = Settings { max_iterations: 4 * n as u64, ..Settings::default() };
        if n >= 8 {
            let short = data.solve(&Settings { method: Method::Lemke, ..budget.clone() });
            assert_eq!(short.status, Status::IterationLimit, "{n}");
        }
        let solution = data.solve(&budget);
        assert_eq!(solution.status, Status::Solved, "{n}: {}", solution.message);
        // The least w is 2, and |q| up to 2e13: more than a tolerance of 1e-14 lets pass.
        let solution = data.solve(&Settings { tolerance: 1e-14, ..budget });
        assert_eq!(solution.status, Status::Solved, "{n}: {}", solution.message);
        assert_murtys_solution(&solution);
    }
}

/// `M = L Lᵀ` with that triangular `L`, `q = -1`: definite, and `z = e_0`, `w = (0, 1, …, 1)` since
/// the first column of `M` is `(1, 2, …, 2)`. Y. Fathi, Mathematical Programming 17 (1979) 335-344.
fn fathi(n: usize) -> Bare {
    let entry = |i: usize, j: usize| (0..n).map(|l| lower(i, l) * lower(j, l)).sum();
    let m = (0..n * n).map(|k| entry(k % n, k / n)).collect();
    Bare { n, m, q: vec![-1.0; n] }
}

fn assert_fathis_solution(solution: &LcpSolution, tolerance: f64) {
    let n = solution.z.len();
    assert_eq!(solution.status, Status::Solved, "{n}: {}", solution.message);
    let z: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == 0))).collect();
    let w: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i != 0))).collect();
    assert!(largest(&difference(&solution.z, &z)) <= tolerance, "{n}: {:?}", solution.z);
    assert!(largest(&difference(&solution.w, &w)) <= tolerance, "{n}: {:?}", solution.w);
}

#[test]
fn lemke_solves_fathis_problem() {
    for n in [1_usize, 2, 4, 8, 16, 32] {
        let solution = fathi(n).solve(&Settings { max_iterations: 1 << 20, ..lemke() });
        // Condition of M below 9^2 n^2 = 1e5, rounding 1e-16.
        assert_fathis_solution(&solution, 1e-10);
    }
}

/// Block pivoting takes `n + 1` systems: each exchanges one more unknown for good. Condition of `M`
/// below 9^2 n^2 = 4e5, rounding 1e-16.
#[test]
fn block_pivoting_takes_n_plus_1_systems_on_fathis_problem() {
    for n in 4_usize..=64 {
        for method in [Method::BlockPivoting, Method::Auto] {
            let solution = fathi(n).solve(&Settings { method, ..Settings::default() });
            assert_eq!(solution.method, Method::BlockPivoting, "{n}: {solution:?}");
            assert_fathis_solution(&solution, 1e-10);
            let systems = solution.iterations;
            assert!(systems <= n as u64 + 1, "{n}: {systems} systems by {method:?}");
        }
    }
}

/// Ties at every pivot: without a rule the path may return to where it was. There are at
/// most `n 2^(n-1) + 1` bases on it, 193 for the 6 unknowns here: 1000 pivots would be a cycle.
#[test]
fn does_not_cycle_on_degenerate_problems() {
    let settings = Settings { max_iterations: 1000, ..lemke() };
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

/// With `M = I` every problem has a solution. `y = -q` satisfies `Mᵀ y <= 0` and `q . y < 0` where `q > 0`:
/// without `y >= 0` it proves nothing, and neither does one negative entry among others.
#[test]
fn a_ray_with_a_negative_entry_proves_nothing() {
    for n in 1..6 {
        let identity: Vec<f64> =
            (0..n * n).map(|k| f64::from(u8::from(k % (n + 1) == 0))).collect();
        let q = vec![1.0; n];
        let lcp = Lcp::new(n, &identity, n, &q, None).unwrap();
        assert_eq!(lcp.eta(&vec![0.0; n]), 0.0, "z = 0 is a solution");
        assert!(!lcp.is_infeasible_by(&vec![-1.0; n]));
        for i in 0..n {
            let mut y = vec![0.0; n];
            y[i] = -1.0;
            assert!(!lcp.is_infeasible_by(&y), "{y:?}");
        }
    }
    // M = [[1, 1], [3, 2]], all positive, is feasible for every q: Mᵀ y = (-1, 0), q . y = -1.
    let lcp = Lcp::new(2, &[1.0, 3.0, 1.0, 2.0], 2, &[-1.0, -1.0], None).unwrap();
    assert!(!lcp.is_infeasible_by(&[2.0, -1.0]));
}

/// `eta` of candidates that are no solutions: by its formula, and the same whatever the units of `w` and of
/// `z` (powers of two, so that nothing rounds).
#[test]
fn eta_has_no_unit() {
    let mut rng = Rng::with_seed(11);
    for _ in 0..300 {
        let n = rng.usize(1..=5);
        let mut random =
            |count: usize| -> Vec<f64> { (0..count).map(|_| f64::from(rng.i32(-8..=8))).collect() };
        let (m, q) = (random(n * n), random(n));
        let z: Vec<f64> = random(n).iter().map(|z| z.abs()).collect();
        let mut residual = 0.0_f64;
        let mut product = vec![0.0; n];
        for i in 0..n {
            product[i] = (0..n).map(|j| m[i + j * n] * z[j]).sum::<f64>();
            let row_and_column = (0..n).flat_map(|j| [i + j * n, j + i * n]);
            let largest = row_and_column.fold(0.0_f64, |s, k| s.max(m[k].abs()));
            let unit = if largest == 0.0 { 1.0 } else { largest };
            residual = residual.hypot((q[i] + product[i]).min(unit * z[i]));
        }
        let norm = |x: &[f64]| x.iter().fold(0.0_f64, |s, x| s.hypot(*x));
        let sizes = (0..n).map(|i| (0..n).map(|j| (m[i + j * n] * z[j]).abs()).sum::<f64>());
        let terms = norm(&sizes.collect::<Vec<f64>>());
        if norm(&q) == 0.0 {
            continue;
        }
        let expected = residual / norm(&q);
        // Sums of n terms and q in twice the precision, rounded up to a power of two.
        let lost = 2.0 * (2.0 * f64::EPSILON * (n + 2) as f64).powi(2) * (1.0 + terms / norm(&q));
        let eta = |w_unit: f64, z_unit: f64| {
            let m: Vec<f64> = m.iter().map(|m| m * w_unit / z_unit).collect();
            let q: Vec<f64> = q.iter().map(|q| q * w_unit).collect();
            let z: Vec<f64> = z.iter().map(|z| z * z_unit).collect();
            Lcp::new(n, &m, n, &q, None).unwrap().eta(&z)
        };
        // Some ten roundings of norms of five entries.
        let plain = eta(1.0, 1.0);
        assert!(
            (plain - expected).abs() <= 1e-14 * expected + lost,
            "{plain} {expected} {m:?} {q:?} {z:?}"
        );
        if m.iter().all(|m| *m == 0.0) {
            continue;
        }
        for exponent in [-300, -60, -1, 3, 60, 300] {
            let unit = 2_f64.powi(exponent);
            assert_eq!(eta(unit, unit), plain, "2^{exponent} {m:?} {q:?} {z:?}");
            assert_eq!(eta(unit, 1.0), plain, "2^{exponent} {m:?} {q:?} {z:?}");
        }
    }
}
