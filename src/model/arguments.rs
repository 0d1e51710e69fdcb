//! Checks of a model's arrays.

use crate::error::{Argument, Error, entry};
use crate::law::first_penetration;
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

/// Refuses a penetration that supports on both sides of a pair hold: no displacement takes it away.
pub(super) fn check_fixed_gaps(
    fixed_components: &[usize],
    dim: usize,
    gaps: &[f64],
) -> Result<(), Error> {
    let normals = fixed_components.iter().filter(|&component| component % dim == 0);
    let Some((pair, gap)) = first_penetration(gaps, normals.map(|component| component / dim))
    else {
        return Ok(());
    };
    let message = format!(
        "{} is {gap}, a penetration, but both sides of the pair are fixed along its normal: nothing can part \
         them: set the gap to 0, release a side, or leave the pair out",
        entry("gap", [pair])
    );
    Err(Error::invalid(Argument::Gap, message))
}
