//! The table of the friction laws: their names, their parameters, and what is said of each.

use crate::error::number;
use crate::linalg::tolerances::FEW_OPERATIONS;

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
    /// A law of its own for each pair.
    ByPair,
    /// No relative motion, whatever the force.
    Tied,
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
    /// The number of the pair's own law.
    OwnLaw,
    /// A parameter of the pair's own law, 0 if that has fewer.
    OfOwnLaw,
}

/// A row of the table of laws.
pub(super) struct Statement {
    /// The law in a problem file.
    name: &'static str,
    /// The law in a message.
    title: &'static str,
    /// The parameters of each pair, in their order.
    parameters: &'static [(&'static str, Parameter)],
    /// When the law is none of friction, in words.
    pub(super) frictionless_if: &'static str,
    /// The check of a pair's parameters against each other: the parameter at fault, and why.
    pub(super) check: fn(&[f64]) -> Option<(usize, String)>,
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
    Statement {
        name: "by-pair",
        title: "a law for each pair",
        parameters: &[
            ("law", Parameter::OwnLaw),
            ("p1", Parameter::OfOwnLaw),
            ("p2", Parameter::OfOwnLaw),
            ("p3", Parameter::OfOwnLaw),
        ],
        frictionless_if: "that of every pair must be without friction",
        check: |_| None,
    },
    Statement {
        name: "tied",
        title: "a tie",
        parameters: &[],
        frictionless_if: "every pair must be tied",
        check: |_| None,
    },
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
pub(crate) const FLATTEST: f64 = 1e6;

/// Refuses a cohesion below what the tension asks for.
fn cohesion(numbers: &[f64]) -> Option<(usize, String)> {
    let &[mu, b, a] = numbers else { return None };
    let least = mu * a;
    // The host has rounded a product: half of what ten operations leave.
    let rounding = least * (FEW_OPERATIONS / 2.0);
    (b < least - rounding).then(|| {
        let [mu, b, a, least] = [mu, b, a, least].map(number);
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
    pub const ALL: [Law; 8] = [
        Law::Frictionless,
        Law::Coulomb,
        Law::Tresca,
        Law::Cohesive,
        Law::Orthotropic,
        Law::OrthotropicCollinear,
        Law::ByPair,
        Law::Tied,
    ];

    /// The law that a pair can have by itself, with this number.
    pub fn of_number(number: f64) -> Option<Law> {
        Law::ALL.into_iter().find(|&law| law != Law::ByPair && law.number() == number)
    }

    /// Its number in the C interface.
    pub fn number(self) -> f64 {
        self as i32 as f64
    }

    pub(super) fn statement(self) -> &'static Statement {
        &LAWS[self as usize]
    }

    /// Its name in a problem file.
    pub fn name(self) -> &'static str {
        self.statement().name
    }

    /// Its name in a message, with those of its parameters.
    pub(crate) fn title(self) -> String {
        match self.names() {
            names if names.is_empty() => self.statement().title.into(),
            names => format!("{}: {}", self.statement().title, names.join(", ")),
        }
    }

    /// The numbers that a pair's own law may have, in words.
    pub(super) fn numbers_in_words() -> String {
        let own = Law::ALL.into_iter().filter(|&law| law != Law::ByPair);
        let numbers: Vec<_> = own.map(|law| format!("{} ({})", law.number(), law.name())).collect();
        format!("be the number of a law: {}", numbers.join(", "))
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
    pub(super) fn is_orthotropic(self) -> bool {
        self.parameters().iter().any(|(_, meaning)| *meaning == Parameter::Axis)
    }
}
