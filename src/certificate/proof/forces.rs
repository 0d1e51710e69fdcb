//! `K d - f`, enclosed.

use crate::law::Contact;
use crate::linalg::ball::{Ball, BallVector, UNIT, product_up, sum_of_products_up, sum_up};
use crate::problem::{ContactProblem, Relation};

/// Bounds on the entries of `|K| x`, of an `x` that has no negative entry.
pub fn bound_of_product(problem: &ContactProblem<'_>, x: &[f64]) -> Vec<f64> {
    let sums = problem.relation().magnitude(x);
    sums.into_iter().map(|sum| sum_of_products_up(sum, x.len())).collect()
}

/// `K (d + low) - f` of each pair, enclosed.
///
/// The sum is taken in twice the precision and rounded once. Of `n` terms its second part has `3 n` terms of
/// at most one unit of the sizes' sum each, added in single precision: `4 (n + 4)² u²` bounds its rounding.
pub fn enclosed_force(contact: &Contact<'_>, d: &[f64], low: &[f64]) -> Vec<BallVector> {
    let problem = contact.problem();
    let computed = problem.relation().residual_of_parts(d, low);
    let sizes: Vec<f64> = d.iter().zip(low).map(|(d, low)| sum_up(d.abs(), low.abs())).collect();
    let terms = bound_of_product(problem, &sizes);
    let twice = 4.0 * ((d.len() + 4) as f64 * UNIT).powi(2);
    let enclosed = |i: usize| {
        let force = computed[i];
        let size = sum_up(terms[i], problem.load()[i].abs());
        let rounding = sum_up(product_up(twice, size), product_up(UNIT, force.abs()));
        Ball::new(force, sum_of_products_up(rounding, d.len()))
    };
    let dim = contact.dim();
    let of_pair = |pair: usize| {
        let mut force = BallVector::default();
        force[..dim]
            .iter_mut()
            .enumerate()
            .for_each(|(c, force)| *force = enclosed(dim * pair + c));
        force
    };
    (0..contact.pairs().len()).map(of_pair).collect()
}
