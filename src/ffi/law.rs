//! The friction law of the pairs, as an argument with its parameters.

use super::args::Arrays;
use super::guard::Failure;
use crate::file::Law;
use crate::problem::FrictionLaw;

/// No friction: F_t = 0. friction may be NULL and is not read.
pub const SIGNORINI_LAW_FRICTIONLESS: i32 = 0;
/// Coulomb: |F_t| <= mu |F_n|. friction holds mu >= 0, one for each pair.
pub const SIGNORINI_LAW_COULOMB: i32 = 1;
/// Tresca: |F_t| <= g, open or closed. friction holds g >= 0, one for each pair; force.
pub const SIGNORINI_LAW_TRESCA: i32 = 2;

/// The arguments `law`, number `position`, and `friction`, the next one, for `pairs` pairs.
///
/// # Safety
/// A pointer that is not NULL has as many elements as the header demands.
pub(super) unsafe fn read<'a>(
    arrays: &mut Arrays,
    position: i32,
    (law, friction): (i32, *const f64),
    pairs: usize,
) -> Result<FrictionLaw<'a>, Failure> {
    let (name, of): (_, fn(&'a [f64]) -> FrictionLaw<'a>) = match law {
        SIGNORINI_LAW_FRICTIONLESS => return Ok(FrictionLaw::Frictionless),
        SIGNORINI_LAW_COULOMB => ("Coulomb's law: mu", FrictionLaw::Coulomb),
        SIGNORINI_LAW_TRESCA => ("Tresca's law: g", FrictionLaw::Tresca),
        other => {
            let message = format!(
                "law is {other}, it must be SIGNORINI_LAW_FRICTIONLESS (0), _COULOMB (1) or \
                 _TRESCA (2)"
            );
            return Err(Failure::argument(position, message));
        }
    };
    if friction.is_null() && pairs > 0 {
        let message =
            format!("friction is NULL, it must hold the parameters of {name} of each pair");
        return Err(Failure::argument(position + 1, message));
    }
    // SAFETY: by the caller's contract.
    Ok(of(unsafe { arrays.required(position + 1, "friction", friction, pairs)? }))
}

pub(super) fn code(law: Law) -> i32 {
    match law {
        Law::Frictionless => SIGNORINI_LAW_FRICTIONLESS,
        Law::Coulomb => SIGNORINI_LAW_COULOMB,
        Law::Tresca => SIGNORINI_LAW_TRESCA,
    }
}
