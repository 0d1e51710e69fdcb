//! Residuals in twice the precision.

use super::ball::UNIT;
use super::matrix::Matrix;
use super::vector::{norm, sizes};
use crate::common::quad::Quad;

/// A residual that cancels to the last digits of its terms, against inner products in twice the precision. Each of their
/// `2 n + 1` additions is off by `3 u²` of both parts, all together by `12 (n + 2) u²` of the sum of sizes: the bound that
/// the residual is documented with, `16 (n + 2)² u²`, and a quarter more are above both errors; the result is rounded.
#[test]
fn residuals_that_cancel_are_right() {
    let mut rng = fastrand::Rng::with_seed(2);
    for n in (1..40).chain([200]) {
        let mut number = || (rng.f64() - 0.5) * 10_f64.powi(rng.i32(-6..6));
        let entries: Vec<f64> = (0..n * n).map(|_| number()).collect();
        let x: Vec<f64> = (0..n).map(|_| number()).collect();
        let low: Vec<f64> = x.iter().map(|x| 0.3 * UNIT * x).collect();
        let matrix = Matrix::new(n, &entries, n);
        let (b, terms) = (matrix.product(&x), matrix.magnitude(&sizes(&x)));
        let residual = matrix.residual(&x, &low, &b, &terms);
        for i in 0..n {
            let times = |j: usize, x: f64| Quad::product(matrix.at(i, j), x);
            let exact: Quad = (0..n).map(|j| times(j, x[j]) + times(j, low[j])).sum();
            let error = (exact - Quad::from(b[i]) - Quad::from(residual[i])).value().abs();
            let squared = (UNIT * (n + 2) as f64).powi(2);
            let bound = 20.0 * squared * (terms[i] + b[i].abs()) + UNIT * residual[i].abs();
            assert!(error <= bound, "{n}: row {i}: {error:e} > {bound:e}");
        }
    }
}

/// One pass gives the terms of the product, and a residual that is off by what is documented: on a semi-definite matrix,
/// of which diagonal entries bound the others, on any other one, and where the residual cancels by so many digits that sums
/// on top of that bound would lose some of it. What is lost beyond the bound of two passes is below its rounding.
#[test]
fn one_pass_is_as_good_as_two() {
    let mut rng = fastrand::Rng::with_seed(5);
    let mut both = [0, 0];
    for n in (1..40).chain([200]) {
        for (is_gram, cancels) in [(true, false), (true, true), (false, false)] {
            let mut number = || rng.f64() - 0.5;
            let any: Vec<f64> = (0..n * n).map(|_| number()).collect();
            let gram = |i: usize, j: usize| -> f64 {
                let column = |j: usize| &any[n * j..n * (j + 1)];
                column(i).iter().zip(column(j)).map(|(a, b)| a * b).sum()
            };
            let entries: Vec<f64> = match is_gram {
                true => (0..n * n).map(|at| gram(at % n, at / n)).collect(),
                false => any.clone(),
            };
            let x: Vec<f64> = (0..n).map(|_| number()).collect();
            let low: Vec<f64> = x.iter().map(|x| 0.3 * UNIT * x).collect();
            let matrix = Matrix::new(n, &entries, n);
            let product = matrix.product(&x);
            let b: Vec<f64> = product.iter().map(|b| if cancels { *b } else { 1e-3 * b }).collect();
            let residual = matrix.residual_and_terms(&x, &low, &b);
            let terms = matrix.magnitude(&sizes(&x));
            assert_eq!(residual.terms, terms, "{n}");
            both[usize::from(residual.base == norm(&terms))] += 1;
            let squared = (UNIT * (n + 2) as f64).powi(2);
            let lost = 20.0 * squared * (residual.base + norm(&b));
            for (i, (&b, &value)) in b.iter().zip(&residual.values).enumerate() {
                let times = |j: usize, x: f64| Quad::product(matrix.at(i, j), x);
                let exact: Quad = (0..n).map(|j| times(j, x[j]) + times(j, low[j])).sum();
                let error = (exact - Quad::from(b) - Quad::from(value)).value().abs();
                assert!(error <= lost + UNIT * value.abs(), "{n}: row {i}: {error:e} > {lost:e}");
            }
            let of_terms = 20.0 * squared * (norm(&terms) + norm(&b));
            let rounding = UNIT * norm(&residual.values).max(norm(&b));
            assert!(lost <= of_terms + 2.0 * rounding, "{n}: {lost:e} > {of_terms:e}");
        }
    }
    assert!(both[0] > 0 && both[1] > 0, "{both:?}");
}

/// Powers of two are no rounding: scaled data give scaled bits, from small numbers to large ones.
#[test]
fn residuals_scale_with_their_data() {
    let (entries, x, b) = ([3.1, -2.7, 0.3, 1e-9], [0.7, 1.3], [1.4, 0.1]);
    let residual = |power: i32| -> Vec<f64> {
        let by = 2_f64.powi(power);
        let (entries, b) = (entries.map(|entry| by * entry), b.map(|b| by * b));
        let matrix = Matrix::new(2, &entries, 2);
        let residual = matrix.residual(&x, &[], &b, &matrix.magnitude(&x));
        residual.iter().map(|residual| residual / by).collect()
    };
    for power in [-800, -60, 1, 60, 1000] {
        assert_eq!(residual(power), residual(0), "2^{power}");
    }
}
