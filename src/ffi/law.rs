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
/// Coulomb with cohesion and a tension cut-off: F_n <= a, (d_n - gap) (F_n - a) = 0,
/// |F_t| <= b - mu F_n. friction holds three numbers for each pair, (mu, b, a): mu >= 0; a >= 0,
/// the tension at which the pair opens, force; b >= mu a, the cohesion, force. The law has no
/// memory: an open pair carries the tension F_n = a and a friction of up to b - mu a, however far
/// it is open (gap +inf too). To let a pair break, the host sets its b and a to 0 in the load steps
/// after it opened.
pub const SIGNORINI_LAW_COHESIVE: i32 = 3;
/// Orthotropic, 3D only: (F_1 / mu1)^2 + (F_2 / mu2)^2 <= F_n^2, an ellipse. friction holds three
/// numbers for each pair, (mu1, mu2, angle): the coefficients along axis 1 and 2, both > 0 and at
/// most 1e6 times apart, and the angle of axis 1 from t1 towards t2 in radians. The pair slips along
/// the normal of the ellipse at -F_t (associated rule): of all forces in the ellipse F_t takes the
/// most work from the slip.
pub const SIGNORINI_LAW_ORTHOTROPIC: i32 = 4;
/// The same ellipse and numbers; the pair slips opposite to F_t (collinear rule).
pub const SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR: i32 = 5;

/// The last of the laws, which are numbered without gaps.
pub(super) const LAST_LAW: i32 = SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR;

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
        SIGNORINI_LAW_COHESIVE => ("the cohesive law: mu, b, a", FrictionLaw::Cohesive),
        SIGNORINI_LAW_ORTHOTROPIC => {
            ("the orthotropic law: mu1, mu2, angle", FrictionLaw::Orthotropic)
        }
        SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR => {
            ("the orthotropic law: mu1, mu2, angle", FrictionLaw::OrthotropicCollinear)
        }
        other => {
            let message = format!(
                "law is {other}, it must be SIGNORINI_LAW_FRICTIONLESS (0), _COULOMB (1), \
                 _TRESCA (2), _COHESIVE (3), _ORTHOTROPIC (4) or _ORTHOTROPIC_COLLINEAR (5)"
            );
            return Err(Failure::argument(position, message));
        }
    };
    if friction.is_null() && pairs > 0 {
        let message =
            format!("friction is NULL, it must hold the parameters of {name} of each pair");
        return Err(Failure::argument(position + 1, message));
    }
    let count = pairs.saturating_mul(of(&[]).parameters());
    // SAFETY: by the caller's contract.
    Ok(of(unsafe { arrays.required(position + 1, "friction", friction, count)? }))
}

pub(super) fn code(law: Law) -> i32 {
    match law {
        Law::Frictionless => SIGNORINI_LAW_FRICTIONLESS,
        Law::Coulomb => SIGNORINI_LAW_COULOMB,
        Law::Tresca => SIGNORINI_LAW_TRESCA,
        Law::Cohesive => SIGNORINI_LAW_COHESIVE,
        Law::Orthotropic => SIGNORINI_LAW_ORTHOTROPIC,
        Law::OrthotropicCollinear => SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR,
    }
}
