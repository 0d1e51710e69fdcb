//! The friction law of the pairs, as an argument with its parameters.

use super::args::Arrays;
use super::guard::Failure;
use crate::problem::{FrictionLaw, Law};

/// No friction: F_t = 0.
pub const SIGNORINI_LAW_FRICTIONLESS: i32 = 0;
/// Coulomb: |F_t| <= mu |F_n|. friction: mu >= 0.
pub const SIGNORINI_LAW_COULOMB: i32 = 1;
/// Tresca: |F_t| <= g, open or closed. friction: g >= 0; force.
pub const SIGNORINI_LAW_TRESCA: i32 = 2;
/// Coulomb with cohesion and a tension cut-off: F_n <= a, (d_n - gap) (F_n - a) = 0,
/// |F_t| <= b - mu F_n. friction: (mu, b, a), mu >= 0, the tension a >= 0 at which the pair opens,
/// the cohesion b >= mu a; forces. No memory: an open pair, even with gap +inf, carries
/// a, and friction up to b - mu a; a pair breaks if its b and a are 0 in later load steps.
pub const SIGNORINI_LAW_COHESIVE: i32 = 3;
/// Orthotropic, 3D only: (F_1 / mu1)^2 + (F_2 / mu2)^2 <= F_n^2. friction: (mu1, mu2, angle),
/// coefficients > 0, at most 1e6 times apart, and the angle of axis 1 from t1 towards t2, radians.
/// The pair slips along the normal of this ellipse at -F_t (associated rule).
pub const SIGNORINI_LAW_ORTHOTROPIC: i32 = 4;
/// As SIGNORINI_LAW_ORTHOTROPIC, but the pair slips opposite to F_t (collinear rule).
pub const SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR: i32 = 5;
/// A law for each pair. friction: (law, p1, p2, p3), the pair's law and its parameters,
/// unused ones 0.
pub const SIGNORINI_LAW_BY_PAIR: i32 = 6;
/// Tied: d_n = gap, d_t = slip0, whatever F; gap +inf: free.
pub const SIGNORINI_LAW_TIED: i32 = 7;

/// The laws, in the order of [`Law`]; numbered without gaps.
const NUMBERS: [i32; Law::ALL.len()] = [
    SIGNORINI_LAW_FRICTIONLESS,
    SIGNORINI_LAW_COULOMB,
    SIGNORINI_LAW_TRESCA,
    SIGNORINI_LAW_COHESIVE,
    SIGNORINI_LAW_ORTHOTROPIC,
    SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR,
    SIGNORINI_LAW_BY_PAIR,
    SIGNORINI_LAW_TIED,
];

/// The last of the laws.
pub(super) const LAST_LAW: i32 = NUMBERS[NUMBERS.len() - 1];

/// The arguments `law`, number `position`, and `friction`, the next one, for `pairs` pairs.
pub(super) fn read<'h>(
    arrays: &mut Arrays<'h>,
    position: i32,
    (law, friction): (i32, *const f64),
    pairs: usize,
) -> Result<FrictionLaw<'h>, Failure> {
    let Some(law) = Law::ALL.into_iter().find(|known| code(*known) == law) else {
        let known = Law::ALL.map(|law| {
            let name = law.name().to_uppercase().replace('-', "_");
            format!("_{name} ({})", code(law))
        });
        let known = known.join(", ");
        let message = format!("law is {law}, it must be SIGNORINI_LAW{known}");
        return Err(Failure::argument(position, message));
    };
    let parameters = law.parameters().len();
    if parameters == 0 {
        return Ok(law.with(&[]));
    }
    if friction.is_null() && pairs > 0 {
        let title = law.title();
        let message =
            format!("friction is NULL, it must hold the parameters of {title} of each pair");
        return Err(Failure::argument(position + 1, message));
    }
    let count = pairs.saturating_mul(parameters);
    Ok(law.with(arrays.required(position + 1, "friction", friction, count)?))
}

/// The number of a law.
pub(super) fn code(law: Law) -> i32 {
    NUMBERS[law as usize]
}
