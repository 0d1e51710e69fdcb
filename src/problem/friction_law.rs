//! The friction laws with their parameters, as the host gives them.

use super::law_table::{Law, Parameter};
use crate::error::{Argument, Error, entry, index, number};

/// The friction law of all pairs, or that of each, with the parameters pair by pair.
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
    /// A law of its own for each pair. Four numbers a pair: [`Law::number`] of its law, and the parameters of that
    /// law, followed by zeros.
    ByPair(&'a [f64]),
    /// A tie: `d_n = gap` and `d_t = slip0`, whatever the force. A pair with the gap `+inf` is free. No parameters.
    Tied,
}

impl Law {
    /// The law with its parameters, pair by pair.
    pub fn with(self, values: &[f64]) -> FrictionLaw<'_> {
        match self {
            Law::Frictionless => FrictionLaw::Frictionless,
            Law::Coulomb => FrictionLaw::Coulomb(values),
            Law::Tresca => FrictionLaw::Tresca(values),
            Law::Cohesive => FrictionLaw::Cohesive(values),
            Law::Orthotropic => FrictionLaw::Orthotropic(values),
            Law::OrthotropicCollinear => FrictionLaw::OrthotropicCollinear(values),
            Law::ByPair => FrictionLaw::ByPair(values),
            Law::Tied => FrictionLaw::Tied,
        }
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
            FrictionLaw::ByPair(values) => (Law::ByPair, values),
            FrictionLaw::Tied => (Law::Tied, &[]),
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

    /// The numbers that the host has given for a pair.
    pub fn numbers(&self, pair: usize) -> &'a [f64] {
        let count = self.parameters();
        &self.values()[count * pair..count * (pair + 1)]
    }

    /// The law that a pair has by itself, and its parameters.
    pub fn of_pair(&self, pair: usize) -> (Law, &'a [f64]) {
        match (self.law(), self.numbers(pair)) {
            (Law::ByPair, [number, own @ ..]) => {
                let law = Law::of_number(*number).unwrap_or(Law::Frictionless);
                (law, &own[..law.parameters().len()])
            }
            both => both,
        }
    }

    /// Numbers of each pair before the parameters of its law: the number of that law, if each pair has its own.
    fn numbers_before(&self) -> usize {
        usize::from(self.law() == Law::ByPair)
    }

    /// Returns `true` if the law ties some pair, whatever its gap.
    pub fn has_ties(&self) -> bool {
        let own = self.values().chunks_exact(self.parameters().max(1));
        match self.law() {
            Law::ByPair => own.into_iter().any(|numbers| numbers[0] == Law::Tied.number()),
            law => law == Law::Tied,
        }
    }

    /// Returns `true` if a pair with this gap is tied.
    pub fn is_tied(&self, pair: usize, gap: f64) -> bool {
        self.of_pair(pair).0 == Law::Tied && gap < f64::INFINITY
    }

    /// Names and meanings of the numbers of a pair: those of its own law where it has one.
    fn meanings(&self, pair: usize) -> impl Iterator<Item = (&'static str, Parameter)> + use<> {
        let (all, own) = (self.law().parameters(), self.of_pair(pair).0.parameters());
        let (before, after) = (self.numbers_before(), self.numbers_before() + own.len());
        all[..before].iter().chain(own).chain(&all[after..]).copied()
    }

    /// All numbers of the host with their meanings.
    pub fn each(&self) -> impl Iterator<Item = (Parameter, f64)> {
        let pairs = self.values().len().checked_div(self.parameters()).unwrap_or(0);
        (0..pairs).flat_map(|pair| {
            let numbers = self.numbers(pair).iter();
            self.meanings(pair).zip(numbers).map(|((_, meaning), &value)| (meaning, value))
        })
    }

    /// When the law is none of friction, in words.
    pub fn frictionless_if(&self) -> &'static str {
        self.law().statement().frictionless_if
    }

    /// Refuses parameters that are out of range.
    pub(crate) fn check(self, dim: usize) -> Result<(), Error> {
        const IN_PLANE: &str =
            "orthotropic, and dim is 2: a pair in the plane has one tangent, use Coulomb's law";
        if self.law().is_orthotropic() && dim == 2 {
            return Argument::LawChoice.refuse(format!("the law is {IN_PLANE}"));
        }
        let pairs = self.values().len().checked_div(self.parameters());
        for pair in 0..pairs.unwrap_or(0) {
            let checked = match self.of_pair(pair).0.is_orthotropic() && dim == 2 {
                true => Err((0, format!(" is {IN_PLANE}"))),
                false => self.check_pair(pair),
            };
            checked.or_else(|(k, what)| Argument::Law.refuse(self.place(pair, k) + &what))?;
        }
        Ok(())
    }

    /// Refuses parameters of a pair: which of its numbers, and what is wrong with it.
    fn check_pair(&self, pair: usize) -> Result<(), (usize, String)> {
        let (law, own) = self.of_pair(pair);
        for (k, ((_, meaning), &value)) in self.meanings(pair).zip(self.numbers(pair)).enumerate() {
            let must = match meaning {
                _ if !value.is_finite() => return Err((k, " is not finite".into())),
                Parameter::Axis if value <= 0.0 => "be positive".into(),
                Parameter::Coefficient | Parameter::Force if value < 0.0 => {
                    "not be negative".into()
                }
                Parameter::OwnLaw if Law::of_number(value).is_none() => Law::numbers_in_words(),
                Parameter::OfOwnLaw if value != 0.0 => {
                    format!("be 0: the pair has {}, and no more parameters", law.title())
                }
                _ => continue,
            };
            return Err((k, format!(" is {}, it must {must}", number(value))));
        }
        let shifted = |(k, what)| Err((self.numbers_before() + k, what));
        (law.statement().check)(own).map_or(Ok(()), shifted)
    }

    /// A number of a pair in words: `mu[3]`, or `friction[10] (b of pair 3)` where a pair has several.
    fn place(&self, pair: usize, number: usize) -> String {
        let name = self.meanings(pair).nth(number).map_or("", |(name, _)| name);
        match self.parameters() {
            1 => entry(name, [pair]),
            count => {
                let place = entry("friction", [count * pair + number]);
                format!("{place} ({name} of pair {})", index(pair))
            }
        }
    }
}
