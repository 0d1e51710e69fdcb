//! `K d - f`, enclosed.

use crate::law::{Contact, by_pairs};
use crate::linalg::ball::{Ball, BallVector, UNIT, product_up, sum_of_products_up, sum_up};
use crate::problem::{ContactProblem, Relation};

/// Bounds on the entries of `|K| x`, of an `x` that has no negative entry.
pub fn bound_of_product(problem: &ContactProblem<'_>, x: &[f64]) -> Vec<f64> {
    let sums = problem.relation().magnitude(x);
    sums.into_iter().map(|sum| sum_of_products_up(sum, x.len())).collect()
}

/// `K (d + low) - f` of each pair, enclosed, of the `computed` one.
///
/// The sum is taken in twice the precision, off by at most `16 u² (n + 2)²` of the sum of its sizes
/// (`linalg::matrix::Matrix::residual`), and rounded once.
pub fn enclosed_force(
    contact: &Contact<'_>,
    (d, low): (&[f64], &[f64]),
    computed: &[f64],
) -> Vec<BallVector> {
    let problem = contact.problem();
    let sizes: Vec<f64> = d.iter().zip(low).map(|(d, low)| sum_up(d.abs(), low.abs())).collect();
    let terms = bound_of_product(problem, &sizes);
    let twice = 16.0 * ((d.len() + 4) as f64 * UNIT).powi(2);
    let enclosed = |i: usize| {
        let size = sum_up(terms[i], problem.load()[i].abs());
        let rounding = sum_up(product_up(twice, size), product_up(UNIT, computed[i].abs()));
        Ball::new(computed[i], sum_of_products_up(rounding, d.len()))
    };
    let balls: Vec<Ball> = (0..d.len()).map(enclosed).collect();
    by_pairs(contact.dim(), &balls)
}
