//! Checks of the arrays of a call.

use std::fmt::Display;

use crate::error::{Argument, Error, entry};
use crate::linalg::matrix::{Matrix, can_exist, required_length};
use crate::linalg::vector::first_not_finite;

/// The host's name of an array, and the argument that it is.
pub(crate) type Named<'a> = (&'a str, Argument);

/// The arguments of the first or only matrix of a call.
pub(crate) const OF_MATRIX: (Argument, Argument) = (Argument::Matrix, Argument::LeadingDimension);

/// A dense square matrix of so many rows, column-major with a leading dimension. `matrix` and `leading` are the
/// arguments at fault.
///
/// # Errors
/// A leading dimension or an array that is too small.
pub(crate) fn dense<'a>(
    name: &str,
    (values, ld): (&'a [f64], usize),
    rows: usize,
    (matrix, leading): (Argument, Argument),
) -> Result<Matrix<'a>, Error> {
    let entries = required_length(name, rows, ld).or_else(|wrong| leading.refuse(wrong))?;
    check_length((name, matrix), values.len(), entries)?;
    Ok(Matrix::new(rows, values, ld))
}

/// The first `length` entries of a vector.
///
/// # Errors
/// A vector that is shorter; the first of these entries that is not finite.
pub(super) fn vector<'a>(
    named: Named<'_>,
    values: &'a [f64],
    length: usize,
) -> Result<&'a [f64], Error> {
    check_length(named, values.len(), length)?;
    check_finite(named, &values[..length])?;
    Ok(&values[..length])
}

/// Refuses an array with fewer entries than are needed.
pub(super) fn check_length(named: Named<'_>, given: usize, needed: usize) -> Result<(), Error> {
    check_count(named, given.min(needed), needed)
}

/// Refuses an array with more entries or fewer than are needed.
pub(crate) fn check_count(
    (name, argument): Named<'_>,
    given: usize,
    needed: usize,
) -> Result<(), Error> {
    if given == needed {
        return Ok(());
    }
    argument.refuse(format!("{name} has {given} entries, it must have {needed}"))
}

/// Refuses the first entry that is not finite.
pub(crate) fn check_finite((name, argument): Named<'_>, values: &[f64]) -> Result<(), Error> {
    match first_not_finite(values) {
        Some(i) => argument.refuse(entry(name, [i]) + " is not finite"),
        None => Ok(()),
    }
}

/// Refuses the first entry of a matrix that is not finite.
pub(crate) fn check_finite_matrix(
    (name, argument): Named<'_>,
    matrix: &Matrix<'_>,
) -> Result<(), Error> {
    for j in 0..matrix.size() {
        if let Some(i) = first_not_finite(matrix.column(j)) {
            return argument.refuse(entry(name, [i, j]) + " is not finite");
        }
    }
    Ok(())
}

/// A space dimension, which must be 2 or 3.
pub(crate) fn checked_dim<T: Copy + Display + TryInto<usize>>(dim: T) -> Result<usize, Error> {
    match dim.try_into() {
        Ok(dim @ (2 | 3)) => Ok(dim),
        _ => Argument::Dimension.refuse(format!("dim is {dim}, it must be 2 or 3")),
    }
}

/// Number of unknowns `dim * pairs`, if a matrix of that size can exist.
pub(crate) fn unknowns(dim: usize, pairs: usize) -> Result<usize, Error> {
    match dim.checked_mul(pairs) {
        Some(size) if can_exist(size) => Ok(size),
        _ => Argument::Size.refuse(format!("pairs is {pairs}: the matrix cannot exist")),
    }
}

/// Refuses a gap that is neither a number nor `+inf`.
pub(crate) fn check_gaps(gap: &[f64]) -> Result<(), Error> {
    let wrong = gap.iter().position(|&gap| gap.is_nan() || gap == f64::NEG_INFINITY);
    let Some(i) = wrong else { return Ok(()) };
    let (place, gap) = (entry("gap", [i]), gap[i]);
    Argument::Gap.refuse(format!("{place} is {gap}, it must be a number or +inf (never touches)"))
}
