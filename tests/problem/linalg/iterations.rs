//! Solutions by products, and the least squares that serve them.

use super::conjugate_gradients::conjugate_gradients;
use super::gmres::gmres;
use super::least_squares::{Columns, least_squares};
use super::vector::{dot, norm};

/// Random systems of `n` unknowns end in `n` directions at the latest (Cayley and Hamilton), with the
/// solution to the rounding of a matrix of condition about 10.
#[test]
fn solves_in_as_many_steps_as_unknowns() {
    let mut rng = fastrand::Rng::with_seed(3);
    for n in 1..20 {
        let matrix: Vec<Vec<f64>> = (0..n)
            .map(|i| {
                let row = (0..n).map(|j| if i == j { 3.0 } else { 0.0 });
                row.map(|d| d + (rng.f64() - 0.5) / n as f64).collect()
            })
            .collect();
        let exact: Vec<f64> = (0..n).map(|_| rng.f64() - 0.5).collect();
        let times = |x: &[f64]| -> Vec<f64> { matrix.iter().map(|row| dot(row, x)).collect() };
        let right = times(&exact);
        let mut directions: Vec<Vec<f64>> = Vec::new();
        let (coefficients, _) = gmres(&right, 0.0, n, |v| {
            directions.push(v.to_vec());
            Ok::<_, ()>(times(v))
        })
        .unwrap();
        let mut x = vec![0.0; n];
        for (c, v) in coefficients.iter().zip(&directions) {
            x.iter_mut().zip(v).for_each(|(x, v)| *x += c * v);
        }
        let error = norm(&x.iter().zip(&exact).map(|(a, b)| a - b).collect::<Vec<_>>());
        assert!(error <= 1e-13, "{n}: {error:e}");
    }
}

/// A singular system whose right side is no image: the residual is what is left of it, and nothing is divided
/// by zero.
#[test]
fn a_singular_system_leaves_its_residual() {
    let times = |x: &[f64]| vec![x[0], 0.0];
    let (coefficients, residual) = gmres(&[3.0, 4.0], 0.0, 5, |v| Ok::<_, ()>(times(v))).unwrap();
    assert!((residual - 4.0).abs() <= 1e-14 * 4.0);
    assert!(coefficients.iter().all(|c| c.is_finite()));
}

/// `[4 1; 1 3] [1; -2] = [2; -5]`, exact after two steps but for rounding.
#[test]
fn two_unknowns_take_two_steps() {
    let times = |x: &[f64]| vec![4.0 * x[0] + x[1], x[0] + 3.0 * x[1]];
    let x = conjugate_gradients(times, &[2.0, -5.0], || Ok::<(), ()>(())).unwrap();
    assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] + 2.0).abs() < 1e-14, "{x:?}");
}

/// `2 + 3 x - x²` at four places with a rest `±1` that is orthogonal to all three, `(1, -3, 3, -1)`, and a column
/// twice.
#[test]
fn a_polynomial_is_found_beside_what_no_column_has() {
    let x = [0.0, 1.0, 2.0, 3.0_f64];
    let column = |power: i32| x.iter().map(|x| x.powi(power)).collect::<Vec<f64>>();
    let rest = [1.0, -3.0, 3.0, -1.0];
    let target: Vec<f64> =
        x.iter().zip(rest).map(|(x, rest)| 2.0 + 3.0 * x - x * x + rest).collect();
    let found = least_squares([0, 1, 0, 2].map(column).into_iter(), &target);
    for (found, exact) in found.iter().zip([2.0, 3.0, 0.0, -1.0]) {
        // A hundred roundings.
        assert!((found - exact).abs() < 1e-13, "{found}, {exact}");
    }
}

/// A sum of images is found again by its shares, also where some images follow from others.
#[test]
fn shares_of_a_sum_of_images() {
    let mut rng = fastrand::Rng::with_seed(1);
    let mut vector = || -> Vec<f64> { (0..12).map(|_| rng.f64() - 0.5).collect() };
    let mut images: Vec<Vec<f64>> = (0..6).map(|_| vector()).collect();
    images[3] = images[1].iter().zip(&images[2]).map(|(a, b)| a - 2.0 * b).collect();
    let sum: Vec<f64> = (0..12).map(|i| images[0][i] + images[3][i] - images[5][i]).collect();
    let all = Columns::new(images.iter().cloned(), 1e-4);
    let mut left = sum.clone();
    let shares = all.take_out(&mut left);
    let shares = all.coefficients(shares);
    assert_eq!(shares.len(), images.len());
    for i in 0..12 {
        let again: f64 = shares.iter().zip(&images).map(|(share, image)| share * image[i]).sum();
        // Rounding of twelve terms, and of a basis of a condition about 10.
        assert!((again - sum[i]).abs() <= 1e-13, "{again} {}", sum[i]);
        assert!(left[i].abs() <= 1e-13, "{}", left[i]);
    }
}
