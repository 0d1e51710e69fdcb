//! The friction laws by their names in a file.

use crate::problem::FrictionLaw;

/// The friction law of a problem, without its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// No friction.
    Frictionless,
    /// Coulomb friction.
    Coulomb,
    /// Tresca friction: given thresholds.
    Tresca,
    /// Coulomb friction with cohesion and a tension cut-off.
    Cohesive,
    /// Orthotropic friction, associated rule.
    Orthotropic,
    /// Orthotropic friction, collinear rule.
    OrthotropicCollinear,
}

impl Law {
    /// All of them.
    pub(super) const ALL: [Law; 6] = [
        Law::Frictionless,
        Law::Coulomb,
        Law::Tresca,
        Law::Cohesive,
        Law::Orthotropic,
        Law::OrthotropicCollinear,
    ];

    /// The law of a problem.
    pub(super) fn of(law: &FrictionLaw<'_>) -> Law {
        match law {
            FrictionLaw::Frictionless => Law::Frictionless,
            FrictionLaw::Coulomb(_) => Law::Coulomb,
            FrictionLaw::Tresca(_) => Law::Tresca,
            FrictionLaw::Cohesive(_) => Law::Cohesive,
            FrictionLaw::Orthotropic(_) => Law::Orthotropic,
            FrictionLaw::OrthotropicCollinear(_) => Law::OrthotropicCollinear,
        }
    }

    /// The law with its parameters, pair by pair.
    pub fn with(self, values: &[f64]) -> FrictionLaw<'_> {
        match self {
            Law::Frictionless => FrictionLaw::Frictionless,
            Law::Coulomb => FrictionLaw::Coulomb(values),
            Law::Tresca => FrictionLaw::Tresca(values),
            Law::Cohesive => FrictionLaw::Cohesive(values),
            Law::Orthotropic => FrictionLaw::Orthotropic(values),
            Law::OrthotropicCollinear => FrictionLaw::OrthotropicCollinear(values),
        }
    }

    /// Its name in a file.
    pub(super) fn name(self) -> &'static str {
        match self {
            Law::Frictionless => "frictionless",
            Law::Coulomb => "coulomb",
            Law::Tresca => "tresca",
            Law::Cohesive => "cohesive",
            Law::Orthotropic => "orthotropic",
            Law::OrthotropicCollinear => "orthotropic-collinear",
        }
    }

    /// Names of the parameters of each pair.
    pub(super) fn parameters(self) -> &'static [&'static str] {
        self.with(&[]).names()
    }
}
