//! Vectors by which an operator is checked and measured.

use crate::linalg::perturbation::Perturbation;

/// A vector without a pattern, of either sign and sizes between 1 and 2: the same in each run. Two vectors of
/// signs alone would hide what is wrong with few components.
pub(super) fn probe(size: usize, seed: u64) -> Vec<f64> {
    let mut numbers = Perturbation::new(seed);
    let beyond_one = |number: f64| number + number.signum();
    (0..size).map(|_| beyond_one(numbers.next())).collect()
}

/// A unit for each direction of the pairs: a mean of the diagonal, by vectors `x` of random signs, of which
/// `x . K x` has the sum of `x_i^2 K_ii` as its mean (M. F. Hutchinson, *A stochastic estimator of the trace of the
/// influence matrix*, Commun. Stat. Simul. Comput. 19 (1990) 433-450). `None`: it is not positive.
pub(super) fn measured_units(
    dim: usize,
    probes: &[Vec<f64>; 2],
    products: &[Vec<f64>; 2],
) -> Option<Vec<f64>> {
    let mean = |first: usize, step: usize| {
        let (mut energy, mut weight) = (0.0, 0.0);
        for (x, product) in probes.iter().zip(products) {
            for (x, product) in x.iter().zip(product).skip(first).step_by(step) {
                energy += x * product;
                weight += x * x;
            }
        }
        energy / weight
    };
    let all = mean(0, 1);
    if !is_unit(all) {
        return None;
    }
    let unit = |c: usize| if is_unit(mean(c, dim)) { mean(c, dim) } else { all };
    let of_pair: Vec<f64> = (0..dim).map(unit).collect();
    Some(of_pair.iter().copied().cycle().take(probes[0].len()).collect())
}

pub(super) fn is_unit(unit: f64) -> bool {
    unit > 0.0 && unit.is_finite()
}
