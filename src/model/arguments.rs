//! Checks of a model's arrays.

use crate::error::{Argument, Error, entry, index};
use crate::law::{first_open_tie, first_penetration, first_tension};
use crate::problem::{FrictionLaw, Named, check_count, check_finite};

/// Refuses a vector of the wrong length, or with entries that are not finite.
pub(super) fn check_vector(named: Named<'_>, values: &[f64], length: usize) -> Result<(), Error> {
    check_count(named, values.len(), length)?;
    check_finite(named, values)
}

/// Refuses a penetration, and the gap of a tie, that supports on both sides of a pair hold: no displacement takes it away. A
/// tension would pull the supports alone: it is refused too.
pub(super) fn check_fixed_gaps(
    fixed_components: &[usize],
    dim: usize,
    gaps: &[f64],
    law: FrictionLaw<'_>,
) -> Result<(), Error> {
    let normals = fixed_components.iter().filter(|&component| component % dim == 0);
    let normals = normals.map(|component| component / dim);
    if let Some((pair, gap)) = first_open_tie((gaps, law), normals.clone()) {
        return Argument::Gap.refuse(format!(
            "{} is {gap}, and the pair is tied, but both sides are fixed along its normal: set the gap to 0, release \
             a side, or leave the pair out",
            entry("gap", [pair])
        ));
    }
    if let Some((pair, tension)) = first_tension((gaps, law), normals.clone()) {
        return Argument::Law.refuse(format!(
            "pair {} has a tension of {tension}, but both sides are fixed along its normal: set a and b to 0, release a \
             side, or leave the pair out",
            index(pair)
        ));
    }
    let Some((pair, gap)) = first_penetration(gaps, normals) else { return Ok(()) };
    Argument::Gap.refuse(format!(
        "{} is {gap}, a penetration, but both sides of the pair are fixed along its normal: nothing can part \
         them: set the gap to 0, release a side, or leave the pair out",
        entry("gap", [pair])
    ))
}
