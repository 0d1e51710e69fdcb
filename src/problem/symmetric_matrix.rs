//! Validation of a host's dense symmetric matrix.

use super::arguments::{Named, check_finite_matrix};
use crate::error::{Error, entry, index, number};
use crate::linalg::factor::first_not_definite;
use crate::linalg::matrix::{Matrix, tiles};
use crate::linalg::tolerances::{AGREES, CONDENSATION, FREE};

/// Returns `true` if entries agree with those across the diagonal, up to rounding relative to the squares of `root`, which
/// are those of a positive diagonal or of units.
pub(crate) fn is_symmetric_beside(matrix: &Matrix<'_>, root: &[f64]) -> bool {
    matrix.agrees_across(root, AGREES, f64::INFINITY)
        || across(matrix, root).all(|Across { apart, scale, .. }| apart <= AGREES * scale)
}

/// Roots of the diagonal entries, each with the rounding that a host's condensation leaves in the place of a zero, a part
/// of the largest entry of its `group`; NaN where one is further below zero.
fn roots(matrix: &Matrix<'_>, group: usize) -> Vec<f64> {
    let units = matrix.units_of_groups(group, 0.0).enumerate();
    units.map(|(i, unit)| (matrix.at(i, i) + FREE * CONDENSATION * unit).sqrt()).collect()
}

/// Refuses entries that are not finite, negative diagonals, zeros on the diagonal of rows that are not zero,
/// a matrix of zeros, asymmetry beyond rounding, and entries that a positive semi-definite matrix
/// cannot have, each but for what a condensation leaves beside the entries of the same `group` of components.
///
/// A row of zeros is a component that a free body moves without a force: a foot along its normal, if the
/// body stands on two feet in the plane, or on three in space.
pub(crate) fn check(matrix: &Matrix<'_>, group: usize, named: Named<'_>) -> Result<(), Error> {
    check_beside(matrix, &roots(matrix, group), named)?;
    check_not_zero(matrix, named)
}

/// As [`check`], of a matrix that the library condensed from terms of the sizes `units`: beside a positive diagonal entry, which
/// may be that of a soft spring, others have their rounding, that of an energy which is told from none.
pub(crate) fn check_condensed(
    matrix: &Matrix<'_>,
    units: &[f64],
    named: Named<'_>,
) -> Result<(), Error> {
    let root = |(i, unit): (usize, &f64)| {
        let own = matrix.at(i, i);
        let rounding = if own > 0.0 { FREE * f64::EPSILON * unit } else { 0.0 };
        (own + rounding).sqrt()
    };
    let root: Vec<f64> = units.iter().enumerate().map(root).collect();
    check_beside(matrix, &root, named)?;
    check_not_zero(matrix, named)
}

/// As [`check`], beside these roots of the diagonal; a matrix of zeros passes.
pub(super) fn check_beside(
    matrix: &Matrix<'_>,
    root: &[f64],
    named: Named<'_>,
) -> Result<(), Error> {
    // One pass over the matrix: entries that are not finite agree with nothing. The others find what is wrong where it is,
    // or that differences are many and small.
    if root.iter().all(|root| root.is_finite()) && matrix.agrees_across(root, AGREES, 1.0 + AGREES)
    {
        return Ok(());
    }
    check_columns(matrix, root, named)?;
    check_across(matrix, root, named)
}

/// An entry below the diagonal: how far it is from the one across, and what the diagonal allows.
struct Across {
    place: (usize, usize),
    apart: f64,
    scale: f64,
}

/// The entries below the diagonal, by tiles.
fn across(matrix: &Matrix<'_>, root: &[f64]) -> impl Iterator<Item = Across> {
    let below = tiles(matrix.size()).flat_map(|(columns, rows)| {
        columns.flat_map(move |j| (rows.start.max(j + 1)..rows.end).map(move |i| (i, j)))
    });
    below.map(|(i, j)| Across {
        place: (i, j),
        apart: (matrix.at(i, j) - matrix.at(j, i)).abs(),
        scale: root[i] * root[j],
    })
}

/// Refuses asymmetry beyond rounding and entries that a diagonal with these roots does not allow.
fn check_across(
    matrix: &Matrix<'_>,
    root: &[f64],
    (name, argument): Named<'_>,
) -> Result<(), Error> {
    for Across { place: (i, j), apart, scale } in across(matrix, root) {
        let (lower, upper) = (matrix.at(i, j), matrix.at(j, i));
        let message = if apart > AGREES * scale {
            let (below, above) = (entry(name, [i, j]), entry(name, [j, i]));
            let remedy =
                format!("average {below} and {above}, or compute both in double precision");
            not_symmetric(name, (i, j), (lower, upper), scale, &remedy)
        } else if lower.abs() > (1.0 + AGREES) * scale {
            beyond_diagonal(name, (i, j), lower, scale)
        } else {
            continue;
        };
        return argument.refuse(message);
    }
    Ok(())
}

/// Why an entry is refused that is larger than `scale`, which the diagonal allows.
pub(crate) fn beyond_diagonal(
    name: &str,
    (i, j): (usize, usize),
    value: f64,
    scale: f64,
) -> String {
    let place = entry(name, [i, j]);
    format!(
        "{name} is not positive semi-definite: {place} is {}, more than its diagonal allows ({})",
        number(value),
        number(scale)
    )
}

/// Refuses a checked matrix, of `dim` components for each pair, that a motion makes work: with a negative
/// eigenvalue, scaled to a unit diagonal, that is no rounding ([`AGREES`]), with what a condensation leaves on the
/// diagonal. `go_on` is asked now and then; if it ends the check, the answer is none to use.
pub(crate) fn check_semidefinite(
    matrix: &Matrix<'_>,
    dim: usize,
    (name, argument): Named<'_>,
    go_on: &mut dyn FnMut() -> bool,
) -> Result<(), Error> {
    let inverse = |root: f64| if root > 0.0 { root.recip() } else { 0.0 };
    let scale: Vec<f64> = roots(matrix, dim).into_iter().map(inverse).collect();
    let entry = |i: usize, j: usize| match i == j {
        true => 1.0 + AGREES,
        false => scale[i] * matrix.at(i, j) * scale[j],
    };
    let Some(component) = first_not_definite(matrix.size(), entry, go_on) else { return Ok(()) };
    argument.refuse(format!(
        "{name} is not positive semi-definite: a motion of the components up to {}, the last of pair {}, has \
         a negative energy: is {name} a stiffness, with the signs of its mixed entries in the frames of \
         the pairs?",
        index(component),
        index(component / dim)
    ))
}

/// Refuses entries that are not finite, negative diagonals, zeros on the diagonal of columns that are not
/// zero, and a matrix of zeros.
pub(crate) fn check_diagonal(matrix: &Matrix<'_>, named: Named<'_>) -> Result<(), Error> {
    check_columns(matrix, &matrix.diagonal_roots(), named)?;
    check_not_zero(matrix, named)
}

fn check_not_zero(matrix: &Matrix<'_>, (name, argument): Named<'_>) -> Result<(), Error> {
    if matrix.size() > 0 && matrix.largest_diagonal() == 0.0 {
        let message = format!(
            "{name} is zero: no motion of the pairs meets a stiffness; if the host holds the components fixed, put \
             positive numbers on the diagonal, and if contact alone holds a body, give it soft springs"
        );
        return Err(Error::invalid(argument, message));
    }
    Ok(())
}

/// Refuses entries that are not finite, and a diagonal entry that is negative, or zero in a column that is not, where
/// its root is none.
fn check_columns(
    matrix: &Matrix<'_>,
    root: &[f64],
    (name, argument): Named<'_>,
) -> Result<(), Error> {
    let at = |i: usize, j: usize| entry(name, [i, j]);
    check_finite_matrix((name, argument), matrix)?;
    for j in 0..matrix.size() {
        let column = matrix.column(j);
        if root[j].is_nan() {
            return argument.refuse(format!(
                "{} is {}, it must be positive",
                at(j, j),
                number(column[j])
            ));
        }
        let is_too_large = |i: &usize| column[*i].abs() > (1.0 + AGREES) * root[*i] * root[j];
        if column[j] == 0.0
            && let Some(i) = (0..column.len()).find(is_too_large)
        {
            return argument.refuse(format!(
                "{} is 0, it must be positive: {} is {}",
                at(j, j),
                at(i, j),
                number(column[i])
            ));
        }
    }
    Ok(())
}

/// Asymmetry up to this, relative to the diagonal, is that of entries rounded to single precision
/// (6e-8) or printed with seven digits (5e-7); more is another mistake.
const SINGLE_PRECISION: f64 = 1e-6;

/// How far two entries that mirror each other differ, relative to `scale`, which the diagonal allows them to be, and the
/// `remedy` if it is the rounding of single precision.
pub(crate) fn not_symmetric(
    name: &str,
    (i, j): (usize, usize),
    (below, above): (f64, f64),
    scale: f64,
    remedy: &str,
) -> String {
    let relative = (below - above).abs() / scale;
    let difference = match relative.is_finite() {
        true => format!("they differ by {relative:.0e} of the diagonal, {AGREES:.0e} is allowed"),
        false => "beside a zero on the diagonal both must be zero".into(),
    };
    let remedy = if relative <= SINGLE_PRECISION { format!(": {remedy}") } else { String::new() };
    let (lower, upper) = (entry(name, [i, j]), entry(name, [j, i]));
    let (below, above) = (number(below), number(above));
    format!("{name} is not symmetric: {lower} is {below}, {upper} is {above}: {difference}{remedy}")
}
