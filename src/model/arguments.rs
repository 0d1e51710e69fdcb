//! Checks of a model's arrays.

use crate::error::{Argument, Error, entry};
use crate::linalg::matrix::required_length;
use crate::linalg::vector::first_not_finite;

/// Refuses a dense matrix of a wrong length, or a wrong leading dimension.
pub(super) fn check_length(
    name: &str,
    (given, ld): (&[f64], usize),
    size: usize,
    (matrix, leading): (Argument, Argument),
) -> Result<(), Error> {
    let entries =
        required_length(name, size, ld).map_err(|message| Error::invalid(leading, message))?;
    if given.len() < entries {
        let given = given.len();
        let message = format!("{name} has {given} entries, it must have {entries}");
        return Err(Error::invalid(matrix, message));
    }
    Ok(())
}

/// Refuses a vector of the wrong length, or with entries that are not finite.
pub(super) fn check_vector(
    argument: Argument,
    name: &str,
    values: &[f64],
    length: usize,
) -> Result<(), Error> {
    if values.len() != length {
        let message = format!("{name} has {} entries, it must have {length}", values.len());
        return Err(Error::invalid(argument, message));
    }
    match first_not_finite(values) {
        Some(i) => Err(Error::invalid(argument, entry(name, [i]) + " is not finite")),
        None => Ok(()),
    }
}
