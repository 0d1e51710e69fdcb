//! The measures of a candidate.

use std::iter::repeat;

use crate::law::{Contact, State, Violation, natural_sum};
use crate::linalg::ball::UNIT;
use crate::linalg::matrix::Residual;
use crate::linalg::tolerances::{FEW_OPERATIONS, NEGLIGIBLE, ROUNDING_OF_SUM};
use crate::linalg::vector::{NormSum, dot, largest_of, norm, norm_inf, sizes};
use crate::problem::{ChangesUnits, ContactProblem, Relation, in_units};

/// The measures of one candidate, forces and displacements in the units of the problem.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// Residual of the natural map, dimensionless.
    pub eta: f64,
    /// `eta` with the rounding of its own evaluation: the true one is not above.
    pub residual: f64,
    /// The most that rounding `d` to doubles may add to `eta`, dimensionless: the rounding of `K d` relative to the
    /// forces, times the most that the law makes of it.
    pub rounding: f64,
    /// Rounding of `K d`, relative to the forces, that a motion which nothing holds may hide behind, dimensionless.
    pub(crate) hidden: f64,
    /// `true` if `K` resists `d` by more than rounding of its entries; looked at where `hidden` is above [`ROUNDING_LIMIT`].
    pub is_resisted: bool,
    /// `true` if the forces are so small that products have lost their digits.
    pub(crate) underflows: bool,
    /// `true` if the residual is larger than the loads, although nothing but these makes forces: no gap that closes, no slip before.
    pub(crate) hides_loads: bool,
    /// Largest `d_n - gap`, a length; 0 if none.
    pub penetration: f64,
    /// Largest tensile `F_n` of `F = K d - f` beyond the tension that the law allows, a force; 0 if none.
    pub tension: f64,
    /// Largest `|F_t|` beyond its bound, a force; 0 if none.
    pub cone_excess: f64,
    /// Largest `|K d - f - F|` with the `F` returned here, a force; of displacements in two parts that of `d` rounded.
    pub equilibrium: f64,
    /// Contact forces that obey the law: `K d - f`, projected.
    pub force: Vec<f64>,
    /// State of each pair.
    pub states: Vec<State>,
    /// The contact forces that equilibrium needs, before they are projected.
    pub(crate) raw: Vec<f64>,
}

impl Certificate {
    /// Returns `true` if the candidate may be called a solution.
    pub fn holds(&self, tolerance: f64) -> bool {
        self.eta <= tolerance && self.doubt().is_none()
    }

    /// A copy with the rounding of its evaluation in `eta`, as far as a tolerance that `eta` meets; 0 with more rounding stays.
    pub(crate) fn with_rounding(self, tolerance: f64) -> Self {
        let eta = if self.residual <= tolerance {
            self.residual
        } else if self.eta > 0.0 {
            self.eta.max(tolerance)
        } else {
            self.eta
        };
        Certificate { eta, ..self }
    }

    /// Returns `true` if the displacements are so large that rounding hides the forces.
    pub fn runs_away(&self) -> bool {
        self.hidden > ROUNDING_LIMIT && !self.is_resisted
    }

    /// Why a candidate is not certified, whatever its `eta`.
    pub(crate) fn doubt(&self) -> Option<&'static str> {
        let doubts = [
            (self.runs_away(), "the displacements are so large that rounding hides the forces"),
            (self.underflows, "the forces are so small that products have lost their digits"),
            (self.hides_loads, "the forces are off equilibrium by more than the loads"),
        ];
        doubts.into_iter().find(|(holds, _)| *holds).map(|(_, doubt)| doubt)
    }

    /// Number of pairs in a state.
    pub fn count(&self, state: State) -> usize {
        self.states.iter().filter(|&&other| other == state).count()
    }
}

/// Largest relative rounding of `K d` that is certified whatever causes it. At the condition number `c` the
/// rounding is about `1e-16 c`: condition numbers up to 1e10 pass. Above, the energy of `d` decides.
pub const ROUNDING_LIMIT: f64 = 1e-6;

/// Displacements of a turning body beside the gap or slip that turns it: lever arms up to 1000.
pub const LEVER: f64 = 1e3;

/// The smallest number, a bound on what a product loses that is smaller than all numbers with full digits.
pub(super) const LEAST: f64 = f64::from_bits(1);

/// Measures displacements of any origin, on a relation in which they determine the contact forces.
pub fn certify(problem: &ContactProblem<'_>, d: &[f64]) -> Certificate {
    certify_in_units(problem, d, &[])
}

/// Measures a displacement and a contact force of any origin, on a relation of this library, in units in which its
/// numbers are ordinary. Where `d` determines the contact forces, the given one is not looked at.
pub(crate) fn certify_in_units<R: ChangesUnits>(
    problem: &ContactProblem<'_, R>,
    d: &[f64],
    force: &[f64],
) -> Certificate {
    let in_units = in_units(problem, |units, problem| {
        let (d, force) = (units.length.all(d)?, units.force.all(force)?);
        Some(measure(&Contact::new(problem), (&d, &[]), &force).to_host(units))
    });
    in_units.flatten().unwrap_or_else(|| measure(&Contact::new(problem), (d, &[]), force))
}

/// Measures a displacement and a contact force of any origin, on any relation. The force is taken as it is.
pub fn certify_pair<R: Relation>(
    problem: &ContactProblem<'_, R>,
    d: &[f64],
    force: &[f64],
) -> Certificate {
    let contact = Contact::new(problem);
    let residual = problem.relation().residual(d, force);
    let terms = Terms::new(&contact, d, None);
    measure_pair(&contact, (d, &[]), &terms, force.to_vec(), (&residual, &[]))
}

/// Measures a candidate of a solver, `d + low` in two parts and `force`, on a problem whose laws are worked out. Where
/// the displacements determine the contact forces they are taken from the host's data, not from the solver; otherwise
/// `low` is left out.
pub(crate) fn measure<R: Relation>(
    contact: &Contact<'_, R>,
    (d, low): (&[f64], &[f64]),
    force: &[f64],
) -> Certificate {
    let relation = contact.problem().relation();
    match relation.force(d, low) {
        Some(Residual { values, terms, base }) => {
            let terms = Terms::new(contact, d, Some((terms, base)));
            measure_pair(contact, (d, low), &terms, values, NOTHING)
        }
        None => {
            let terms = Terms::new(contact, d, None);
            let residual = relation.residual(d, force);
            measure_pair(contact, (d, &[]), &terms, force.to_vec(), (&residual, &[]))
        }
    }
}

/// No residual: the displacements determine the forces.
const NOTHING: (&[f64], &[f64]) = (&[], &[]);

/// Measures `(d + low, raw)`, `low` nothing if it is empty, which lack `residual` to equilibrium at the pairs, and
/// `inner` at unknowns beside them.
pub(super) fn measure_pair<R: Relation>(
    contact: &Contact<'_, R>,
    (d, low): (&[f64], &[f64]),
    terms: &Terms,
    raw: Vec<f64>,
    (residual, inner): (&[f64], &[f64]),
) -> Certificate {
    let relation = contact.problem().relation();
    let load = norm(relation.load());
    // The branches of the law and `max` drop NaN, which sums in twice the precision make of an overflow.
    let scale = match raw.iter().all(|force| force.is_finite()) {
        true => load.max(relation.size_of_force(&raw)),
        false => f64::INFINITY,
    };
    let pulled = norm(contact.load_with_tension());
    let natural = Natural::new(contact, (d, low), &raw);
    let size = natural.size.root().hypot(norm(residual)).hypot(norm(inner));
    let inherent = UNIT * terms.inherent;
    let eta = ratio(size, scale);
    // The error of products in twice the precision, `Matrix::residual`, and what products of the smallest numbers lose.
    let count = (d.len() + 2) as f64;
    let underflow = if d.iter().chain(low).all(|&d| d == 0.0) { 0.0 } else { count * LEAST };
    let products = (4.0 * UNIT * count).powi(2) * (terms.base + load) + underflow;
    let doubt = natural.doubt.root() + natural.sensitivity * products;
    // Those of one component of the residual, of its norm and of the quotient.
    let upper = ratio((size + doubt) * (1.0 + FEW_OPERATIONS), scale);
    let hidden = ratio(UNIT * terms.rest + if pulled == 0.0 { 0.0 } else { inherent }, scale);
    let rounding = ratio(natural.sensitivity * (UNIT * terms.rest + inherent), scale);
    let determines = residual.is_empty() && inner.is_empty();
    let is_resisted = hidden > ROUNDING_LIMIT && determines && is_resisted(relation, d, &raw);
    let Natural { worst, admissible, states, .. } = natural;
    let at_pairs = residual.iter().copied().chain(repeat(0.0));
    let in_parts = if low.is_empty() { 0.0 } else { UNIT };
    let lacking = raw.iter().zip(&admissible).zip(at_pairs).zip(&terms.each);
    let lacking = lacking.map(|(((a, b), r), term)| (a - b + r).abs() + in_parts * term);
    let equilibrium = largest_of(lacking).max(norm_inf(inner));
    let Violation { penetration, tension, cone_excess } = worst;
    Certificate {
        eta,
        residual: upper,
        rounding,
        hidden,
        is_resisted,
        underflows: underflow > UNIT * scale.max(norm(&terms.each)),
        hides_loads: pulled > 0.0 && size > load.max(pulled) && terms.inherent == 0.0,
        penetration,
        tension,
        cone_excess,
        equilibrium,
        force: admissible,
        states,
        raw,
    }
}

/// `eta` of `d` when `raw = K d - f` is at hand, without the rounding that only a full product
/// can tell: what a solver watches between two certificates.
pub fn eta(problem: &ContactProblem<'_>, d: &[f64], raw: &[f64]) -> f64 {
    eta_of(&Contact::new(problem), d, raw)
}

/// [`eta`], on a problem whose laws are worked out.
pub(crate) fn eta_of(contact: &Contact<'_>, d: &[f64], raw: &[f64]) -> f64 {
    let load = norm(contact.problem().relation().load());
    ratio(natural_sum(contact.each(d, raw)).root(), load.max(norm(raw)))
}

/// The measures by the laws of all pairs for displacements `d + low` and forces.
#[derive(Default)]
struct Natural {
    /// Norm of the natural residual.
    size: NormSum,
    /// Bound on its rounding.
    doubt: NormSum,
    /// Largest change of it by a change of a force.
    sensitivity: f64,
    worst: Violation,
    admissible: Vec<f64>,
    states: Vec<State>,
}

impl Natural {
    fn new<R: Relation>(contact: &Contact<'_, R>, (d, low): (&[f64], &[f64]), raw: &[f64]) -> Self {
        let dim = contact.dim();
        let margin = NEGLIGIBLE * norm_inf(contact.problem().relation().load()).max(norm_inf(raw));
        let mut natural = Natural {
            admissible: Vec::with_capacity(raw.len()),
            states: Vec::with_capacity(contact.pairs().len()),
            ..Natural::default()
        };
        let mut residual = [0.0; 3];
        for (pair, (law, d, raw)) in contact.each(d, raw).enumerate() {
            let low = if low.is_empty() { &[0.0; 3][..dim] } else { &low[dim * pair..][..dim] };
            let v = &law.beyond_reference(d, low)[..dim];
            let law = law.at_its_reference();
            law.natural_residual(v, raw, &mut residual);
            residual[..dim].iter().for_each(|&e| natural.size.add(e));
            natural.doubt.add(law.natural_rounding(v, raw));
            natural.sensitivity = natural.sensitivity.max(law.sensitivity());
            let state = law.state(v, raw, margin);
            natural.worst = natural.worst.or_worse(law.violation(v, raw));
            natural.states.push(state);
            natural.admissible.extend_from_slice(&law.admissible_force(raw, state)[..dim]);
        }
        natural
    }
}

/// The energy of the motion `d` under `internal` forces, `K d`, beside its terms: `d . K d / |d| . |K| |d|`; 0 if
/// nothing resists it.
pub(super) fn energy<R: Relation>(relation: &R, d: &[f64], internal: &[f64]) -> f64 {
    let terms = terms(relation, d);
    if terms == 0.0 { 0.0 } else { dot(d, internal) / terms }
}

/// The terms of the energy of the motion `d`: `|d| . |K| |d|`.
pub(super) fn terms<R: Relation>(relation: &R, d: &[f64]) -> f64 {
    let sizes = sizes(d);
    dot(&sizes, &relation.magnitude(&sizes))
}

fn is_resisted<R: Relation>(relation: &R, d: &[f64], raw: &[f64]) -> bool {
    let internal: Vec<f64> = relation.load().iter().zip(raw).map(|(f, raw)| f + raw).collect();
    // More than a host's condensation leaves of a zero: below it the stiffness may be rounding, as of a body that
    // turns about two points. Definite matrices of condition numbers up to 1e12 pass.
    energy(relation, d, &internal) > ROUNDING_OF_SUM
}

/// The terms of `K d`: `|K| |d|`, whose rounding is [`UNIT`] of it.
pub(super) struct Terms {
    /// Component by component.
    each: Vec<f64>,
    /// Norm of those of displacements no larger than a body moves that closes a gap or has slipped.
    inherent: f64,
    /// Norm of those of the rest.
    rest: f64,
    /// Norm of bounds on them, on top of which sums in twice the precision were taken.
    base: f64,
}

impl Terms {
    /// The terms of displacements; `all` of them may be known, with the norm of their bounds.
    fn new<R: Relation>(contact: &Contact<'_, R>, d: &[f64], all: Option<(Vec<f64>, f64)>) -> Self {
        let relation = contact.problem().relation();
        Self::of_all(contact, d, (d, all), &|sizes| relation.magnitude(sizes))
    }

    /// The terms of displacements `x` of which those of the pairs are `d`, with `|A| size`; `all` of them may be known, with
    /// the norm of their bounds.
    pub(super) fn of_all<R: Relation>(
        contact: &Contact<'_, R>,
        d: &[f64],
        (x, all): (&[f64], Option<(Vec<f64>, f64)>),
        magnitude: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Self {
        let normals = d.iter().step_by(contact.dim());
        let prescribed =
            largest_of(contact.pairs().iter().zip(normals).map(|(law, &d_n)| law.prescribed(d_n)));
        let limit = LEVER * prescribed;
        let part = |part: &dyn Fn(f64) -> f64| {
            let sizes: Vec<f64> = x.iter().map(|d| part(d.abs())).collect();
            magnitude(&sizes)
        };
        let (each, base) = all.unwrap_or_else(|| {
            let each = part(&|size| size);
            let base = norm(&each);
            (each, base)
        });
        let is_within = x.iter().all(|d| d.abs() <= limit);
        let [inherent, rest] = match (limit > 0.0, is_within) {
            (false, _) => [0.0, norm(&each)],
            (true, true) => [norm(&each), 0.0],
            (true, false) => {
                [norm(&part(&|size| size.min(limit))), norm(&part(&|size| (size - limit).max(0.0)))]
            }
        };
        Terms { each, inherent, rest, base }
    }

    /// The terms of a part of displacements, `each` being those of all.
    pub(super) fn among(self, each: Vec<f64>) -> Self {
        Terms { base: norm(&each), each, ..self }
    }
}

/// `part / whole`, and infinite where a number on the way overflowed: nothing is certified then.
fn ratio(part: f64, whole: f64) -> f64 {
    if !part.is_finite() || !whole.is_finite() {
        f64::INFINITY
    } else if part == 0.0 {
        0.0
    } else {
        part / whole
    }
}

#[cfg(test)]
mod tests;
