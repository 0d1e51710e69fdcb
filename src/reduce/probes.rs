//! Vectors by which an operator is checked and measured.

use crate::error::{Argument, Error, entry};
use crate::linalg::perturbation::Perturbation;
use crate::linalg::vector::{dot, first_not_finite, norm, norm_of};

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

fn is_unit(unit: f64) -> bool {
    unit > 0.0 && unit.is_finite()
}

/// Refuses units that are not positive and finite.
pub(super) fn check_units(units: &[f64]) -> Result<(), Error> {
    match units.iter().position(|unit| !is_unit(*unit)) {
        Some(i) => refuse(format!("{} must be positive and finite", entry("units", [i]))),
        None => Ok(()),
    }
}

/// The images of two probes, if a map has them that `agrees` to this with a linear, symmetric, positive semi-definite and
/// reproducible one.
pub(super) fn checked_images(
    (name, agrees): (&str, f64),
    [x, y]: &[Vec<f64>; 2],
    image: impl Fn(&[f64]) -> Result<Vec<f64>, Error>,
) -> Result<[Vec<f64>; 2], Error> {
    let (of_x, of_y) = (image(x)?, image(y)?);
    let apart = |a: &[f64], b: &[f64]| norm_of(a.iter().zip(b).map(|(a, b)| a - b));
    let size = norm(&of_x) + norm(&of_y);
    if apart(&image(x)?, &of_x) > agrees * size {
        return refuse(format!("{name} is not reproducible: the same vector gives another one"));
    }
    let sum =
        |a: &[f64], b: &[f64]| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a - 2.0 * b).collect() };
    if apart(&image(&sum(x, y))?, &sum(&of_x, &of_y)) > agrees * size {
        return refuse(format!("{name} is not linear"));
    }
    let terms = norm(x) * norm(&of_y) + norm(y) * norm(&of_x);
    let (one, other) = (dot(x, &of_y), dot(y, &of_x));
    if (one - other).abs() > agrees * terms {
        return refuse(format!(
            "{name} is not symmetric: x . {name} y is {one:e}, y . {name} x is {other:e}"
        ));
    }
    if dot(x, &of_x).min(dot(y, &of_y)) < -agrees * terms {
        return refuse(format!("{name} is not positive semi-definite: x . {name} x is negative"));
    }
    Ok([of_x, of_y])
}

/// Calls the host for a vector, in which nothing may stay unwritten.
pub(super) fn called(
    name: &str,
    size: usize,
    call: impl FnOnce(&mut [f64]) -> Result<(), i32>,
) -> Result<Vec<f64>, Error> {
    let mut y = vec![f64::NAN; size];
    if let Err(number) = call(&mut y) {
        return refuse(format!("the host's function for {name} has returned {number}, not 0"));
    }
    match first_not_finite(&y) {
        Some(i) => refuse(format!(
            "the host's function for {name}: {} is not finite, or was not written",
            entry("y", [i])
        )),
        None => Ok(y),
    }
}

pub(super) fn refuse<T>(message: String) -> Result<T, Error> {
    Argument::Matrix.refuse(message)
}
