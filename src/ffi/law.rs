//! The friction law of the pairs, as an argument with its parameters.

use super::args::At;
use super::guard::Outcome;
use super::numbers::{Numbered, numbers};
use crate::error::Argument;
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
/// A law for each pair. friction: (law, p1, p2, p3), its law and parameters, unused ones 0.
pub const SIGNORINI_LAW_BY_PAIR: i32 = 6;
/// Tied: d_n = gap, d_t = slip0, whatever F; gap +inf: free.
pub const SIGNORINI_LAW_TIED: i32 = 7;

numbers! {
    Law {
        Frictionless = SIGNORINI_LAW_FRICTIONLESS,
        Coulomb = SIGNORINI_LAW_COULOMB,
        Tresca = SIGNORINI_LAW_TRESCA,
        Cohesive = SIGNORINI_LAW_COHESIVE,
        Orthotropic = SIGNORINI_LAW_ORTHOTROPIC,
        OrthotropicCollinear = SIGNORINI_LAW_ORTHOTROPIC_COLLINEAR,
        ByPair = SIGNORINI_LAW_BY_PAIR,
        Tied = SIGNORINI_LAW_TIED,
    }
}

/// The last of the laws, which are numbered without gaps.
pub(super) const LAST_LAW: i32 = Law::ALL.len() as i32 - 1;

/// The arguments `law` and `friction` for `pairs` pairs.
pub(super) fn read<'a>(
    (at_law, law): (At<'_>, i32),
    (at_friction, friction): (At<'a>, *const f64),
    pairs: usize,
) -> Outcome<FrictionLaw<'a>> {
    let (at_law, at_friction) = (at_law.is(Argument::LawChoice), at_friction.is(Argument::Law));
    let Some(law) = Law::numbered(law) else {
        let known = Law::ALL.map(|law| {
            let name = law.name().to_uppercase().replace('-', "_");
            format!("_{name} ({})", Numbered::number(law))
        });
        return at_law.refuse(format!("is {law}, it must be SIGNORINI_LAW{}", known.join(", ")));
    };
    let parameters = law.parameters().len();
    if parameters == 0 {
        return Ok(law.with(&[]));
    }
    if friction.is_null() && pairs > 0 {
        let title = law.title();
        let wrong = format!("is NULL, it must hold the parameters of {title} of each pair");
        return at_friction.refuse(wrong);
    }
    Ok(law.with(at_friction.required(friction, pairs.saturating_mul(parameters))?))
}
