//! The friction laws with their parameters, as the host gives them.

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

/// Names of the parameters.
const COHESIVE: [&str; 3] = ["mu", "b", "a"];
const ORTHOTROPIC: [&str; 3] = ["mu1", "mu2", ANGLE];

/// The parameter that may have either sign.
const ANGLE: &str = "angle";

/// How far apart both coefficients of an ellipse may be: slips are scaled by the squares of their quotient, of which
/// a few digits must be left.
const FLATTEST: f64 = 1e6;

/// Units in the last place by which `b` may fall below `mu a`: the host has rounded a product.
const ROUNDED: f64 = 4.0 * f64::EPSILON;

impl<'a> FrictionLaw<'a> {
    /// The parameters, pair by pair.
    pub fn values(&self) -> &'a [f64] {
        match *self {
            FrictionLaw::Frictionless => &[],
            FrictionLaw::Coulomb(values)
            | FrictionLaw::Tresca(values)
            | FrictionLaw::Cohesive(values)
            | FrictionLaw::Orthotropic(values)
            | FrictionLaw::OrthotropicCollinear(values) => values,
        }
    }

    /// The same law with other parameters.
    pub fn with_values(self, values: &'a [f64]) -> Self {
        match self {
            FrictionLaw::Frictionless => self,
            FrictionLaw::Coulomb(_) => FrictionLaw::Coulomb(values),
            FrictionLaw::Tresca(_) => FrictionLaw::Tresca(values),
            FrictionLaw::Cohesive(_) => FrictionLaw::Cohesive(values),
            FrictionLaw::Orthotropic(_) => FrictionLaw::Orthotropic(values),
            FrictionLaw::OrthotropicCollinear(_) => FrictionLaw::OrthotropicCollinear(values),
        }
    }

    /// Names of the parameters of each pair, in their order.
    pub fn names(&self) -> &'static [&'static str] {
        match self {
            FrictionLaw::Frictionless => &[],
            FrictionLaw::Coulomb(_) => &["mu"],
            FrictionLaw::Tresca(_) => &["g"],
            FrictionLaw::Cohesive(_) => &COHESIVE,
            FrictionLaw::Orthotropic(_) | FrictionLaw::OrthotropicCollinear(_) => &ORTHOTROPIC,
        }
    }

    /// Number of parameters of each pair.
    pub fn parameters(&self) -> usize {
        self.names().len()
    }

    /// The parameters of a pair.
    pub fn of_pair(&self, pair: usize) -> &'a [f64] {
        let count = self.parameters();
        &self.values()[count * pair..count * (pair + 1)]
    }

    /// Whether the law depends on the direction in the tangent plane.
    pub fn is_orthotropic(&self) -> bool {
        matches!(self, FrictionLaw::Orthotropic(_) | FrictionLaw::OrthotropicCollinear(_))
    }

    /// When the law is none of friction, in words.
    pub fn frictionless_if(&self) -> &'static str {
        match self {
            FrictionLaw::Frictionless => "always",
            FrictionLaw::Coulomb(_) => "every mu must be 0",
            FrictionLaw::Tresca(_) => "every g must be 0",
            FrictionLaw::Cohesive(_) => "every mu and every b must be 0",
            FrictionLaw::Orthotropic(_) | FrictionLaw::OrthotropicCollinear(_) => {
                "Coulomb's with every mu 0"
            }
        }
    }

    /// The same law of the first `pairs` pairs.
    pub(super) fn truncated(self, pairs: usize) -> Self {
        self.with_values(&self.values()[..self.parameters() * pairs])
    }

    /// Refuses parameters that are out of range.
    pub(super) fn check(self, dim: usize) -> Result<(), Error> {
        if self.is_orthotropic() && dim == 2 {
            let message = "the law is orthotropic, and dim is 2: a pair in the plane has one tangent, \
                           use Coulomb's law";
            return Err(Error::invalid(Argument::LawChoice, message));
        }
        let pairs = self.values().len().checked_div(self.parameters());
        for pair in 0..pairs.unwrap_or(0) {
            self.check_pair(pair).map_err(|message| Error::invalid(Argument::Law, message))?;
        }
        Ok(())
    }

    fn check_pair(&self, pair: usize) -> Result<(), String> {
        let numbers = self.of_pair(pair);
        for (k, (&name, &value)) in self.names().iter().zip(numbers).enumerate() {
            let place = || self.place(pair, k);
            if !value.is_finite() {
                return Err(place() + " is not finite");
            }
            if name == ANGLE {
                continue;
            }
            if self.is_orthotropic() && value <= 0.0 {
                return Err(format!("{} is {value}, it must be positive", place()));
            }
            if value < 0.0 {
                return Err(format!("{} is {value}, it must not be negative", place()));
            }
        }
        if self.is_orthotropic()
            && let [first, second, _] = numbers
            && first.max(*second) > FLATTEST * first.min(*second)
        {
            let place = self.place(pair, usize::from(second < first));
            return Err(format!(
                "{place} is {:e}, and the other coefficient {:e}: they may be {FLATTEST:e} times apart: \
                 raise it, the friction of so small a coefficient is lost beside the other",
                first.min(*second),
                first.max(*second)
            ));
        }
        if let (FrictionLaw::Cohesive(_), [mu, b, a]) = (self, numbers)
            && *b < mu * a * (1.0 - ROUNDED)
        {
            let place = self.place(pair, 1);
            let least = mu * a;
            return Err(format!(
                "{place} is {b}, it must be at least mu a = {mu} * {a} = {least}: friction would be \
                 negative under the tension a"
            ));
        }
        Ok(())
    }

    /// A parameter in words: `mu[3]`, or `friction[10], b of pair 3,` of a law with several.
    fn place(&self, pair: usize, parameter: usize) -> String {
        let name = self.names()[parameter];
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
