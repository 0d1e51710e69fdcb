//! Factors of systems, and a proved bound on their eigenvalues.

use super::definite::Definite;
use super::factor::Factor;
use super::tolerances::SINGULAR;
use super::watched::{BLOCK, SHORT};

/// Solutions of random systems with one block of columns and with several: the residual is that of elimination with
/// row pivots, `n u` of the entries and the solution, which are of size one, with a growth of ten. A work that is
/// ended gives no factor.
#[test]
fn factors_by_blocks_solve_their_systems() {
    let mut rng = fastrand::Rng::with_seed(1);
    for n in [1, SHORT, SHORT + 1, SHORT + 2 * BLOCK + 7] {
        for symmetric in [false, true] {
            let mut entries: Vec<f64> = (0..n * n).map(|_| rng.f64() - 0.5).collect();
            for j in 0..n {
                (0..j).for_each(|i| {
                    if symmetric {
                        entries[j + n * i] = entries[i + n * j];
                    }
                });
                entries[j * (n + 1)] += if symmetric { n as f64 } else { 0.0 };
            }
            let fill = |j: usize, column: &mut [f64]| {
                column.copy_from_slice(&entries[n * j..n * (j + 1)]);
            };
            let factor = Factor::new(n, symmetric, SINGULAR, fill, &mut || true);
            let factor = factor.expect("it is regular");
            let b: Vec<f64> = (0..n).map(|_| rng.f64() - 0.5).collect();
            let mut x = b.clone();
            factor.solve(&mut x);
            let size = x.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
            for i in 0..n {
                let row: f64 = (0..n).map(|j| entries[i + n * j] * x[j]).sum();
                let most =
                    10.0 * n as f64 * f64::EPSILON * size * entries[i * (n + 1)].abs().max(1.0);
                assert!((row - b[i]).abs() <= most, "{n}, {symmetric}, row {i}: {row} {}", b[i]);
            }
            let ended = Factor::new(n, symmetric, 0.0, fill, &mut || false).is_none();
            assert_eq!(ended, n > SHORT, "it is asked between blocks");
        }
    }
}

/// The sign of the determinant of a permutation, and of its triangle of ones.
#[test]
fn the_sign_counts_exchanges_in_all_blocks() {
    let n = SHORT + BLOCK;
    for shift in [0, 1, 2, 5] {
        let fill = |j: usize, column: &mut [f64]| {
            (0..=j).for_each(|i| column[(i + shift) % n] = 1.0);
        };
        // A rotation by one place of an even number of rows is odd.
        let sign = if shift % 2 == 0 { 1 } else { -1 };
        let factor = Factor::new(n, false, SINGULAR, fill, &mut || true);
        assert_eq!(factor.expect("it is regular").sign, sign);
    }
}

/// The matrix 2 on the diagonal, −1 beside it, has the least eigenvalue `4 sin²(π / (2 (n + 1)))`.
#[test]
fn the_bound_is_below_the_least_eigenvalue() {
    for n in [1_usize, 2, 5, 40, 200] {
        let fill = |j: usize, column: &mut [f64]| {
            column[j] = 2.0;
            for i in [j.wrapping_sub(1), j + 1] {
                if let Some(entry) = column.get_mut(i) {
                    *entry = -1.0;
                }
            }
        };
        let bound = Definite::new(n, fill, &mut || true).expect("it is definite").least;
        let exact = 4.0 * (std::f64::consts::PI / (2.0 * (n as f64 + 1.0))).sin().powi(2);
        assert!(bound <= exact && bound > 0.04 * exact, "{n}: {bound:e}, {exact:e}");
    }
    // Singular, and indefinite.
    for beside in [1.0, 1.5] {
        let fill = |j: usize, column: &mut [f64]| {
            column.fill(beside);
            column[j] = 1.0;
        };
        assert!(Definite::new(2, fill, &mut || true).is_none());
    }
}
