//! The certificate of LCPs near the limits of doubles, against exact whole numbers and closed forms.

use crate::common::bare::Bare;
use fastrand::Rng;
use signorini::{Argument, Error, Lcp, LcpSolution, Method, Monitor, Settings, Status, solve_lcp};

const METHODS: [Method; 3] = [Method::Auto, Method::Lemke, Method::BlockPivoting];

fn solve(data: &Bare, method: Method) -> LcpSolution {
    data.solve(&Settings { method, max_iterations: 5000, ..Settings::default() })
}

/// `2^e`.
fn power(e: i32) -> f64 {
    2_f64.powi(e)
}

/// Rows 2 and 3 are `w = q - (...)` with `q < 0` and nothing positive: there is no solution, though `z` may grow until
/// some `w` is 1e12 times as large as `q`.
#[test]
fn a_variable_that_grows_hides_no_row() {
    let (a, b) = (6_291_456.0, power(-16));
    #[rustfmt::skip]
    let m = vec![
        0.0, -0.5, -1280.0, a,
        0.5, 0.0, -b, 0.125,
        1280.0, b, 0.0, 0.0,
        -a, -0.125, 0.0, 0.0,
    ];
    let data = Bare { n: 4, m, q: vec![-12288.0, -12.0 * power(-14), -0.1875, -3072.0] };
    for method in METHODS {
        let solution = solve(&data, method);
        assert_ne!(solution.status, Status::Solved, "{solution:?}");
    }
}

/// Skew-symmetric problems of small whole numbers in units that are powers of two: what is called solved is so beside `q`,
/// however large `z` is, and a proof is one in whole numbers.
#[test]
fn answers_hold_beside_q_in_any_units() {
    let mut counts = [0; 3];
    for seed in 0..20_000 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(2..=5);
        let unit: Vec<f64> = (0..n).map(|_| power(rng.i32(-16..=16))).collect();
        let mut m = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..i {
                let entry = f64::from(rng.i32(-3..=3)) * unit[i] * unit[j];
                (m[i + j * n], m[j + i * n]) = (entry, -entry);
            }
        }
        let q = unit.iter().map(|unit| f64::from(rng.i32(-3..=1)) * unit).collect();
        let data = Bare { n, m, q };
        for method in [Method::Auto, Method::Lemke] {
            let solution = solve(&data, method);
            let tolerance = Settings::default().tolerance;
            assert_eq!(data.flaw(&solution, tolerance), None, "{seed} {data:?}\n{solution:?}");
            counts[match solution.status {
                Status::Solved => 0,
                Status::NoEquilibrium => 1,
                _ => 2,
            }] += 1;
        }
    }
    assert!(counts[0] > 5000 && counts[1] > 10_000, "{counts:?}: one-sided");
}

/// `M = [1, -1; -1, 1 + e]` has the determinant `e > 0`, so that it is positive definite and every `q` has a solution;
/// with `q = (-1, 1 - d)` that is `z = (1 + d / e, d / e)`, in exact doubles. With `e = 0` there is none: `y = (1, 1)`.
#[test]
fn a_small_determinant_is_no_proof() {
    for b in 0..=28 {
        let q = vec![-1.0, if b == 0 { -1.0 } else { 1.0 - power(-b) }];
        let matrix = |e: f64| vec![1.0, -1.0, -1.0, 1.0 + e];
        // In a proof each entry may change by 8 units in its last digit: rows of two lose an e of 32 units, and none of 64.
        for a in 10..=46 {
            let data = Bare { n: 2, m: matrix(power(-a)), q: q.clone() };
            for method in METHODS {
                let solution = solve(&data, method);
                assert_ne!(solution.status, Status::NoEquilibrium, "{a} {b} {solution:?}");
            }
        }
        let singular = Bare { n: 2, m: matrix(0.0), q };
        for method in [Method::Auto, Method::Lemke] {
            let solution = solve(&singular, method);
            assert_eq!(solution.status, Status::NoEquilibrium, "{b} {solution:?}");
            assert_eq!(solution.infeasible_by.as_deref(), Some(&[1.0, 1.0][..]), "{b}");
        }
    }
}

/// `M = B Bᵀ` of whole numbers with `Bᵀ y = 0` for a `y > 0`, and `q . y < 0`: there is no solution, and the ray of Lemke's
/// method proves it, in any units.
#[test]
fn singular_problems_of_whole_numbers_are_proved_infeasible() {
    for seed in 0..2000 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(2..=9);
        let y: Vec<i32> = (0..n).map(|_| rng.i32(1..=5)).collect();
        let columns = rng.usize(1..n);
        // Columns y_j e_i - y_i e_j are orthogonal to y, and so are their sums.
        let mut b = vec![0; n * columns];
        for c in 0..columns {
            for _ in 0..2 {
                let (i, j, factor) = (rng.usize(0..n), rng.usize(0..n), rng.i32(-2..=2));
                b[i + c * n] += factor * y[j];
                b[j + c * n] -= factor * y[i];
            }
        }
        let unit: Vec<f64> = (0..n).map(|_| power(rng.i32(-3..=3))).collect();
        let mut m = vec![0.0; n * n];
        for i in 0..n {
            for j in 0..n {
                let product: i32 = (0..columns).map(|c| b[i + c * n] * b[j + c * n]).sum();
                m[i + j * n] = f64::from(product) * unit[i] * unit[j];
            }
        }
        let mut q: Vec<i32> = (0..n).map(|_| rng.i32(-5..=5)).collect();
        while q.iter().zip(&y).map(|(q, y)| q * y).sum::<i32>() >= 0 {
            q[rng.usize(0..n)] -= 1;
        }
        let q = q.iter().zip(&unit).map(|(q, unit)| f64::from(*q) * unit).collect();
        let data = Bare { n, m, q };
        for method in [Method::Auto, Method::Lemke] {
            let solution = solve(&data, method);
            assert_eq!(solution.status, Status::NoEquilibrium, "{seed} {data:?} {solution:?}");
            assert_eq!(data.flaw(&solution, 1e-10), None, "{seed} {data:?}\n{solution:?}");
        }
    }
}

/// Whole numbers `a < b < c` near `b` with `a c - b² = 3`.
fn of_determinant_three(b: i64) -> Option<(i64, i64)> {
    let product = b * b + 3;
    (b / 2..b).rev().find(|a| product % a == 0).map(|a| (a, product / a))
}

/// `M = [a, -b; -b, c]` has the determinant 3 and the condition number `(a + c)² / 3`; `z = (c p + b r, b p + a r) / 3` with
/// `q = -(p, r)`. Divided by 3, it has digits beyond doubles: `z + z_low` has them.
#[test]
fn digits_beyond_doubles_are_found() {
    let (mut solved, mut in_parts) = (0, 0);
    for b in (1000..30_000).step_by(7) {
        let Some((a, c)) = of_determinant_three(b) else { continue };
        let mut rng = Rng::with_seed(b as u64);
        let (p, r) = (rng.i64(1..1000), rng.i64(1..1000));
        let m = [a, -b, -b, c].map(|entry| entry as f64).to_vec();
        let data = Bare { n: 2, m, q: vec![-p as f64, -r as f64] };
        let thrice = [(c * p + b * r) as f64, (b * p + a * r) as f64];
        for method in METHODS {
            let solution = solve(&data, method);
            assert_eq!(solution.status, Status::Solved, "{a} {b} {c} {solution:?}");
            assert!(solution.eta <= 1e-10 && solution.w == [0.0; 2], "{solution:?}");
            solved += 1;
            if solution.z_low.is_empty() {
                continue;
            }
            in_parts += 1;
            for (i, thrice) in thrice.into_iter().enumerate() {
                // Exact, as it has few digits.
                let left = (-3.0_f64).mul_add(solution.z[i], thrice);
                let wrong = (left - 3.0 * solution.z_low[i]).abs();
                // w is 1e-10 of q at most, and the inverse of M has entries up to c / 3.
                assert!(wrong <= 1e-10 * (p + r) as f64 * (b + c) as f64, "{b} {solution:?}");
            }
        }
    }
    assert!(solved > 300 && in_parts > 30, "{solved} {in_parts}: too few");
}

/// The exact solution `z = (1 + 2^8, 2^8)`, off by a last digit, leaves `w = 2^-44`: `eta` is not 0.
#[test]
fn eta_is_zero_of_no_other_than_a_solution() {
    let lcp = |z: [f64; 2]| {
        let (m, q) = ([1.0, -1.0, -1.0, 1.0 + power(-36)], [-1.0, 1.0 - power(-28)]);
        signorini::Lcp::new(2, &m, 2, &q, None).unwrap().eta(&z)
    };
    // Both down by 2^-30: w = (0, -2^-66), and sums in doubles show none of it.
    let off = power(-30);
    let size = 1_f64.hypot(1.0 - power(-28));
    let eta = lcp([257.0 - off, 256.0 - off]);
    // Sums of two terms up to 514 and q in twice the precision: 16 u² 4² of the norm of these, and a power of two.
    let rounding = 2.0 * 256.0 * power(-106) * 1000.0;
    assert!((eta * size - power(-66)).abs() <= rounding, "{eta:e}");
    assert!(lcp([257.0, 256.0]) * size <= rounding);
}

/// Single exchanges on `M = [1, 3; 1, 2]`, which is no P-matrix, go round: the call ends where a set comes back, and says so.
#[test]
fn block_pivoting_that_cycles_ends() {
    let data = Bare { n: 2, m: vec![1.0, 1.0, 3.0, 2.0], q: vec![-1.0, -3.0] };
    let settings = Settings { method: Method::BlockPivoting, ..Settings::default() };
    let solution = data.solve(&settings);
    assert_eq!(solution.status, Status::Stalled, "{solution:?}");
    // There are four sets; remembered ones are 1, 2 and 4 exchanges old, after two of patience.
    assert!(solution.iterations <= 13, "{solution:?}");
    assert!(solution.message.contains("it cycles"), "{solution:?}");
    // By the other method it is solved: z = (0, 1.5).
    assert_eq!(data.solve(&Settings::default()).z, [0.0, 1.5]);
}

/// Skew problems of whole numbers with a row and a column of zeros, whose `q` is negative there: nothing solves that row. Whatever the
/// unit of `M`, they are proved infeasible.
#[test]
fn a_row_of_zeros_is_proved_infeasible_in_any_unit() {
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        let n = rng.usize(2..=6);
        let zero = rng.usize(0..n);
        let mut entries = vec![0_i32; n * n];
        for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let entry = if i == zero || j == zero { 0 } else { rng.i32(-2..=2) };
            (entries[i + n * j], entries[j + n * i]) = (entry, -entry);
        }
        let of_row = |i| if i == zero { -3 } else { rng.i32(-3..=3) };
        let q: Vec<f64> = (0..n).map(of_row).map(f64::from).collect();
        for unit in [0, 30, -30, 150, -150] {
            let m = entries.iter().map(|entry| f64::from(*entry) * power(unit)).collect();
            let data = Bare { n, m, q: q.clone() };
            let solution = solve(&data, Method::Auto);
            assert_eq!(solution.status, Status::NoEquilibrium, "{seed} {data:?} {solution:?}");
            assert_eq!(data.flaw(&solution, 1e-10), None, "{seed} {data:?}\n{solution:?}");
        }
    }
}

/// A method for contact problems alone is named; there are no settings in Fortran 77.
#[test]
fn methods_that_solve_none_are_named() {
    let lcp = Lcp::new(1, &[1.0], 1, &[-1.0], None).unwrap();
    for (method, name) in [
        (Method::SorNested, "nested sweeps"),
        (Method::SorDiagonal, "diagonal sweeps"),
        (Method::Newton, "Newton's method"),
        (Method::Path, "the path"),
    ] {
        let settings = Settings { method, ..Settings::default() };
        let monitor = &mut Monitor::new(&settings, None);
        let Err(Error::Invalid { argument, message }) = solve_lcp(&lcp, &settings, monitor) else {
            panic!("{method:?} has solved an LCP");
        };
        assert_eq!(argument, Argument::Settings);
        let words = "method: an LCP is solved by auto, block pivoting and Lemke, not by";
        assert_eq!(message.to_string(), format!("{words} {name}"));
    }
}
