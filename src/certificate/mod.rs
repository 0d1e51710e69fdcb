//! How good a candidate is, computed from the problem alone, never from a solver's counters.
//!
//! The measure is the residual of the natural map, in forces, relative to the larger of the loads and
//! the contact forces:
//!
//! ```text
//! e_n = K_nn (d_n - min(gap, d_n - F_n / K_nn))                  F = K d - f
//! e_t = K_tt (delta - shrink(delta - F_t / K_tt, g / K_tt))      delta = d_t - slip0
//! eta = |e| / max(|f|, |F|)                                      g = mu max(0, -F_n), or given
//! ```
//!
//! For other laws see `law::natural_map`.
//!
//! It is zero at solutions only and has no unit. On a relation in which `d` does not determine `F`, the
//! candidate is the pair `(d, F)` and the residual of the relation counts in `|e|` too.
//!
//! Two facts of double precision are taken into account:
//!
//! - A closing gap or an earlier slip may translate or rotate a body rigidly. These displacements
//!   cancel in `K d` up to rounding only, so that a residual below [`FORGIVEN`] units of their rounding
//!   counts as zero. Displacements up to [`LEVER`] times the largest gap or slip qualify: a body that
//!   turns about a contact moves as much more at its far end as its length exceeds the contact's.
//! - Where the rounding of `K d` is itself comparable with the forces (`rounding >` [`ROUNDING_LIMIT`])
//!   nothing is certified: an unconstrained body would be "solved" by moving it far enough. Without
//!   loads there is nothing to drive such motions, and the first kind does not count.

mod escape;

pub use escape::is_escape;
pub(crate) use escape::{is_escape_of, lifts};

use crate::law::{Contact, State, Violation};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{NormSum, largest_of, norm, norm_inf};
use crate::problem::{ContactProblem, Relation};

/// The measures of one candidate, forces and displacements in the units of the problem.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// Residual of the natural map, dimensionless.
    pub eta: f64,
    /// Rounding of `K d` relative to the forces, dimensionless.
    pub rounding: f64,
    /// Largest `d_n - gap`, a length; 0 if none.
    pub penetration: f64,
    /// Largest tensile `F_n` of `F = K d - f` beyond the tension that the law allows, a force; 0 if none.
    pub tension: f64,
    /// Largest `|F_t|` beyond its bound, a force; 0 if none.
    pub cone_excess: f64,
    /// Largest `|K d - f - F|` with the `F` returned here, a force.
    pub equilibrium: f64,
    /// Contact forces that obey the law: `K d - f`, projected.
    pub force: Vec<f64>,
    /// State of each pair.
    pub states: Vec<State>,
}

impl Certificate {
    /// Whether the candidate may be called a solution.
    pub fn holds(&self, tolerance: f64) -> bool {
        self.eta <= tolerance && !self.runs_away()
    }

    /// Whether the displacements are so large that rounding hides the forces.
    pub fn runs_away(&self) -> bool {
        self.rounding > ROUNDING_LIMIT
    }

    /// Number of pairs in a state.
    pub fn count(&self, state: State) -> usize {
        self.states.iter().filter(|&&other| other == state).count()
    }
}

/// Largest relative rounding of `K d` that is certified. At the condition number `c` the rounding is
/// about `1e-16 c`: condition numbers up to 1e10 pass.
pub const ROUNDING_LIMIT: f64 = 1e-6;

/// Displacements of a turning body beside the gap or slip that turns it: lever arms up to 1000.
pub const LEVER: f64 = 1e3;

/// Units of the rounding of rigid displacements that a residual may have: a sum of `n` rounded terms
/// is off by about `sqrt(n)` units, and 16 cover some hundred terms.
pub const FORGIVEN: f64 = 16.0;

/// Measures displacements of any origin, on a relation in which they determine the contact forces.
pub fn certify(problem: &ContactProblem<'_>, d: &[f64]) -> Certificate {
    measure_pair(&Contact::new(problem), d, problem.force(d), &[])
}

/// Measures a displacement and a contact force of any origin, on any relation.
pub fn certify_pair<R: Relation>(
    problem: &ContactProblem<'_, R>,
    d: &[f64],
    force: &[f64],
) -> Certificate {
    let residual = problem.relation().residual(d, force);
    measure_pair(&Contact::new(problem), d, force.to_vec(), &residual)
}

/// Measures the candidate `(d, force)` of a solver, on a problem whose laws are worked out. Where `d`
/// determines the contact forces they are taken from the host's data, not from the solver.
pub(crate) fn measure<R: Relation>(
    contact: &Contact<'_, R>,
    d: &[f64],
    force: &[f64],
) -> Certificate {
    let relation = contact.problem().relation();
    match relation.force(d) {
        Some(force) => measure_pair(contact, d, force, &[]),
        None => measure_pair(contact, d, force.to_vec(), &relation.residual(d, force)),
    }
}

/// Measures `(d, raw)`, which lack `residual` to equilibrium, nothing if it is empty.
fn measure_pair<R: Relation>(
    contact: &Contact<'_, R>,
    d: &[f64],
    raw: Vec<f64>,
    residual: &[f64],
) -> Certificate {
    let relation = contact.problem().relation();
    let scale = force_scale(relation.load(), &raw);
    let (inherent, rest) = rounding(contact, d);
    let unloaded = norm_inf(contact.shifted_load()) == 0.0;
    let size = norm(&natural_residual(contact, d, &raw)).hypot(norm(residual));
    let forgiven = FORGIVEN * inherent;
    // Written so that NaN stays NaN.
    let eta = ratio(if size <= forgiven { 0.0 } else { size - forgiven }, scale);
    let rounding = ratio(if unloaded { rest } else { inherent + rest }, scale);
    let margin = NEGLIGIBLE * norm_inf(relation.load()).max(norm_inf(&raw));
    let dim = contact.dim();
    let mut worst = Violation::default();
    let mut admissible = Vec::with_capacity(raw.len());
    let mut states = Vec::with_capacity(contact.pairs().len());
    for (law, d, raw) in contact.each(d, &raw) {
        let state = law.state(d, raw, margin);
        worst = worst.or_worse(law.violation(d, raw));
        states.push(state);
        admissible.extend_from_slice(&law.admissible_force(raw, state)[..dim]);
    }
    let lacking = raw.iter().zip(&admissible).map(|(a, b)| a - b);
    let equilibrium = match residual {
        [] => largest_of(lacking),
        _ => largest_of(lacking.zip(residual).map(|(lacking, residual)| lacking + residual)),
    };
    let Violation { penetration, tension, cone_excess } = worst;
    Certificate {
        eta,
        rounding,
        penetration,
        tension,
        cone_excess,
        equilibrium,
        force: admissible,
        states,
    }
}

/// `eta` of `d` when `raw = K d - f` is at hand, without the rounding that only a full product
/// can tell: what a solver watches between two certificates.
pub fn eta(problem: &ContactProblem<'_>, d: &[f64], raw: &[f64]) -> f64 {
    eta_of(&Contact::new(problem), d, raw)
}

/// [`eta`], on a problem whose laws are worked out.
pub(crate) fn eta_of(contact: &Contact<'_>, d: &[f64], raw: &[f64]) -> f64 {
    // Nothing is stored: this runs once for each linear system, and every few sweeps.
    let mut sum = NormSum::default();
    let mut residual = [0.0; 3];
    for (law, d, raw) in contact.each(d, raw) {
        law.natural_residual(d, raw, &mut residual);
        residual[..d.len()].iter().for_each(|&e| sum.add(e));
    }
    ratio(sum.root(), force_scale(contact.problem().load(), raw))
}

fn natural_residual<R: Relation>(contact: &Contact<'_, R>, d: &[f64], raw: &[f64]) -> Vec<f64> {
    let mut residual = vec![0.0; raw.len()];
    let parts = residual.chunks_exact_mut(contact.dim());
    for ((law, d, raw), residual) in contact.each(d, raw).zip(parts) {
        law.natural_residual(d, raw, residual);
    }
    residual
}

fn force_scale(load: &[f64], raw: &[f64]) -> f64 {
    norm(load).max(norm(raw))
}

/// Norms of the rounding of `K d`: first that of displacements no larger than a body moves that
/// closes a gap or has slipped, then the rest.
fn rounding<R: Relation>(contact: &Contact<'_, R>, d: &[f64]) -> (f64, f64) {
    let normals = d.iter().step_by(contact.dim());
    let prescribed =
        largest_of(contact.pairs().iter().zip(normals).map(|(law, &d_n)| law.prescribed(d_n)));
    let unit = f64::EPSILON / 2.0;
    let limit = unit * LEVER * prescribed;
    let relation = contact.problem().relation();
    let size = |d: &f64| unit * d.abs();
    let part = |part: &dyn Fn(f64) -> f64| {
        let sizes: Vec<f64> = d.iter().map(|d| part(size(d))).collect();
        norm(&relation.magnitude(&sizes))
    };
    let inherent = if limit > 0.0 { part(&|size| size.min(limit)) } else { 0.0 };
    let rest = part(&|size| size - size.min(limit));
    // Not finite where a displacement is not: nothing is certified then.
    if inherent.is_finite() { (inherent, rest) } else { (inherent, f64::INFINITY) }
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
