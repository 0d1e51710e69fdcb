//! The friction laws with their parameters, as the host gives them, and a table with what is said of each.

use crate::error::{Argument, Error, entry, index};

/// The friction law of all pairs, with its parameters pair by pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionLaw<'a> {
    /// No friction: `F_t = 0`. No parameters.
    Frictionless,
    /// Coulomb: `|F_t| <= mu |F_n|`, with the coefficient `mu >= 0`.
    Coulomb(&'a [f64]),
    /// Tresca: `|F_t| <= g`, with the threshold `g >= 0` (a force), whether the pair is open or closed.
    Tresca(&'a [f64]),
    /// Coulomb with cohesion and a tension cut-off: `F_n <= a`, `(d_n - gap) (F_n - a) = 0`,
    /// `|F_t| <= b - mu F_n`. Three numbers a pair, `mu >= 0`, `b >= mu a` and `a >= 0`; `a` and `b` are
    /// forces. The law has no memory: an open pair carries the tension `F_n = a` and friction up to
    /// `b - mu a`, also with a gap `+inf`. A host whose pairs break sets both to 0 for a pair that was
    /// open in an earlier load step.
    Cohesive(&'a [f64]),
    /// Orthotropic friction in 3D: `(F_1 / mu1)² + (F_2 / mu2)² <= F_n²` along axes of which the first is
    /// at `angle` (radians) from t1 towards t2. Three numbers a pair, `mu1 > 0`, `mu2 > 0`, up to 1e6 times
    /// apart, and `angle`.
    /// The slip is along the inward normal of the ellipse at the force (associated rule).
    Orthotropic(&'a [f64]),
    /// As [`FrictionLaw::Orthotropic`], with the slip opposite to the force (collinear rule).
    OrthotropicCollinear(&'a [f64]),
}

/// A friction law without its parameters. Its place is its number in the C interface.
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

/// The meaning of a parameter, with the values that it may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parameter {
    /// A coefficient of friction, at least 0.
    Coefficient,
    /// A coefficient along an axis of an ellipse, positive.
    Axis,
    /// A force, at least 0.
    Force,
    /// An angle of either sign.
    Angle,
}

/// A row of the table of laws.
struct Statement {
    /// The law in a problem file.
    name: &'static str,
    /// The law in a message.
    title: &'static str,
    /// The parameters of each pair, in their order.
    parameters: &'static [(&'static str, Parameter)],
    /// When the law is none of friction, in words.
    frictionless_if: &'static str,
    /// The check of a pair's parameters against each other: the parameter at fault, and why.
    check: fn(&[f64]) -> Option<(usize, String)>,
}

/// The laws, in the order of [`Law`].
const LAWS: [Statement; Law::ALL.len()] = [
    Statement {
        name: "frictionless",
        title: "no friction",
        parameters: &[],
        frictionless_if: "always",
        check: |_| None,
    },
    Statement {
        name: "coulomb",
        title: "Coulomb's law",
        parameters: &[("mu", Parameter::Coefficient)],
        frictionless_if: "every mu must be 0",
        check: |_| None,
    },
    Statement {
        name: "tresca",
        title: "Tresca's law",
        parameters: &[("g", Parameter::Force)],
        frictionless_if: "every g must be 0",
        check: |_| None,
    },
    Statement {
        name: "cohesive",
        title: "the cohesive law",
        parameters: &[
            ("mu", Parameter::Coefficient),
            ("b", Parameter::Force),
            ("a", Parameter::Force),
        ],
        frictionless_if: "every mu and every b must be 0",
        check: cohesion,
    },
    Statement { name: "orthotropic", ..ELLIPTIC },
    Statement { name: "orthotropic-collinear", ..ELLIPTIC },
];

/// The statement of both laws with an ellipse, which exist in space alone.
const ELLIPTIC: Statement = Statement {
    name: "",
    title: "the orthotropic law",
    parameters: &[("mu1", Parameter::Axis), ("mu2", Parameter::Axis), ("angle", Parameter::Angle)],
    frictionless_if: "Coulomb's with every mu 0",
    check: flatness,
};

/// How far apart both coefficients of an ellipse may be: slips are scaled by the squares of their quotient, of which
/// a few digits must be left.
const FLATTEST: f64 = 1e6;

/// Units in the last place by which `b` may fall below `mu a`: the host has rounded a product.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

/// Refuses a cohesion below what the tension asks for.
fn cohesion(numbers: &[f64]) -> Option<(usize, String)> {
    let &[mu, b, a] = numbers else { return None };
    let least = mu * a;
    (b < least * (1.0 - ROUNDED)).then(|| {
        let what = format!(
            " is {b}, it must be at least mu a = {mu} * {a} = {least}: friction would be negative under \
             the tension a"
        );
        (1, what)
    })
}

/// Refuses an ellipse that is too flat.
fn flatness(numbers: &[f64]) -> Option<(usize, String)> {
    let &[first, second, _] = numbers else { return None };
    let (small, large) = (first.min(second), first.max(second));
    (large > FLATTEST * small).then(|| {
        let what = format!(
            " is {small:e}, and the other coefficient {large:e}: they may be {FLATTEST:e} times apart: \
             raise it, the friction of so small a coefficient is lost beside the other"
        );
        (usize::from(second < first), what)
    })
}

impl Law {
    /// All of them, in the order of their numbers.
    pub const ALL: [Law; 6] = [
        Law::Frictionless,
        Law::Coulomb,
        Law::Tresca,
        Law::Cohesive,
        Law::Orthotropic,
        Law::OrthotropicCollinear,
    ];

    fn statement(self) -> &'static Statement {
        &LAWS[self as usize]
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

    /// Its name in a problem file.
    pub fn name(self) -> &'static str {
        self.statement().name
    }

    /// Its name in a message, with those of its parameters.
    pub(crate) fn title(self) -> String {
        format!("{}: {}", self.statement().title, self.names().join(", "))
    }

    /// Names and meanings of the parameters of each pair, in their order.
    pub fn parameters(self) -> &'static [(&'static str, Parameter)] {
        self.statement().parameters
    }

    /// Names of the parameters of each pair, in their order.
    pub(crate) fn names(self) -> Vec<&'static str> {
        self.parameters().iter().map(|(name, _)| *name).collect()
    }

    /// Returns `true` if the law depends on the direction in the tangent plane.
    fn is_orthotropic(self) -> bool {
        self.parameters().iter().any(|(_, meaning)| *meaning == Parameter::Axis)
    }
}

impl<'a> FrictionLaw<'a> {
    /// The law without its parameters, and these, pair by pair.
    fn parts(self) -> (Law, &'a [f64]) {
        match self {
            FrictionLaw::Frictionless => (Law::Frictionless, &[]),
            FrictionLaw::Coulomb(values) => (Law::Coulomb, values),
            FrictionLaw::Tresca(values) => (Law::Tresca, values),
            FrictionLaw::Cohesive(values) => (Law::Cohesive, values),
            FrictionLaw::Orthotropic(values) => (Law::Orthotropic, values),
            FrictionLaw::OrthotropicCollinear(values) => (Law::OrthotropicCollinear, values),
        }
    }

    /// The law without its parameters.
    pub fn law(&self) -> Law {
        self.parts().0
    }

    /// The parameters, pair by pair.
    pub fn values(&self) -> &'a [f64] {
        self.parts().1
    }

    /// Copies the law with other parameters.
    pub fn with_values(self, values: &'a [f64]) -> Self {
        self.law().with(values)
    }

    /// Number of parameters of each pair.
    pub fn parameters(&self) -> usize {
        self.law().parameters().len()
    }

    /// The parameters of a pair.
    pub fn of_pair(&self, pair: usize) -> &'a [f64] {
        let count = self.parameters();
        &self.values()[count * pair..count * (pair + 1)]
    }

    /// When the law is none of friction, in words.
    pub fn frictionless_if(&self) -> &'static str {
        self.law().statement().frictionless_if
    }

    /// Copies the law of the first `pairs` pairs.
    pub(super) fn truncated(self, pairs: usize) -> Self {
        self.with_values(&self.values()[..self.parameters() * pairs])
    }

    /// Refuses parameters that are out of range.
    pub(super) fn check(self, dim: usize) -> Result<(), Error> {
        if self.law().is_orthotropic() && dim == 2 {
            let message = "the law is orthotropic, and dim is 2: a pair in the plane has one tangent, \
                           use Coulomb's law";
            return Err(Error::invalid(Argument::LawChoice, message));
        }
        let pairs = self.values().len().checked_div(self.parameters());
        for pair in 0..pairs.unwrap_or(0) {
            self.check_pair(pair).map_err(|(parameter, what)| {
                Error::invalid(Argument::Law, self.place(pair, parameter) + &what)
            })?;
        }
        Ok(())
    }

    /// Refuses parameters of a pair: which one, and what is wrong with it.
    fn check_pair(&self, pair: usize) -> Result<(), (usize, String)> {
        let numbers = self.of_pair(pair);
        for (k, ((_, meaning), &value)) in self.law().parameters().iter().zip(numbers).enumerate() {
            let must = match meaning {
                _ if !value.is_finite() => return Err((k, " is not finite".into())),
                Parameter::Axis if value <= 0.0 => "be positive",
                Parameter::Coefficient | Parameter::Force if value < 0.0 => "not be negative",
                _ => continue,
            };
            return Err((k, format!(" is {value}, it must {must}")));
        }
        (self.law().statement().check)(numbers).map_or(Ok(()), Err)
    }

    /// A parameter in words: `mu[3]`, or `friction[10], b of pair 3,` of a law with several.
    fn place(&self, pair: usize, parameter: usize) -> String {
        let name = self.law().names()[parameter];
        match self.parameters() {
            1 => entry(name, [pair]),
            count => {
                let number = index(pair);
                let place = entry("friction", [count * pair + parameter]);
                format!("{place} ({name} of pair {number})")
            }
        }
    }
}
