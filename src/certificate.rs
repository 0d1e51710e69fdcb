//! How good a candidate is, computed from the problem alone, never from a solver's counters.
//!
//! The measure is the residual of the natural map, in forces, relative to the larger of the loads
//! and the contact forces:
//!
//! ```text
//! e_n = K_nn (d_n - min(gap, d_n - F_n / K_nn))                  F = K d - f
//! e_t = K_tt (delta - shrink(delta - F_t / K_tt, g / K_tt))      delta = d_t - slip
//! eta = |e| / max(|f|, |F|)                                      g = mu max(0, -F_n), or given
//! ```
//!
//! It is zero at solutions only and has no unit. Two facts of double precision are taken into
//! account:
//!
//! - Where contact moves a body as a whole, by a gap that closes or a slip that has been, these
//!   displacements cancel in `K d` up to rounding only. `|e|` is counted from 16 units of the
//!   rounding of displacements up to 1000 times that size on, which a body that turns may reach.
//! - Where the rounding of `K d` is itself comparable with the forces (`rounding > 1e-6`) nothing is
//!   certified: displacements of a body that nothing holds would pass as a solution if they are only
//!   large enough. Without loads there is nothing to drive them, and the first kind does not count.

use crate::law::{self, Pair, State};
use crate::linalg::small::{largest, norm};
use crate::problem::{ContactProblem, FrictionLaw};

/// The measures of one candidate, forces and displacements in the units of the problem.
#[derive(Clone, Debug)]
pub struct Certificate {
    /// Residual of the natural map, dimensionless.
    pub eta: f64,
    /// Rounding of `K d` relative to the forces, dimensionless.
    pub rounding: f64,
    /// Largest `d_n - gap`, a length; 0 if none.
    pub penetration: f64,
    /// Largest tensile `F_n` of `F = K d - f`, a force; 0 if none.
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

/// See the module's documentation; it admits condition numbers up to about 1e10.
const ROUNDING_LIMIT: f64 = 1e-6;

/// See the module's documentation.
const LEVER: f64 = 1e3;

/// States closer than this part of the largest force are not told apart (see [`Pair::state`]).
const STATE_MARGIN: f64 = 1e-11;

/// Measures `d`, of any origin.
pub fn certify(problem: &ContactProblem<'_>, d: &[f64]) -> Certificate {
    let raw = problem.force(d);
    let scale = force_scale(problem, &raw);
    let (inherent, rest) = rounding(problem, d);
    let unloaded = largest(problem.load()) == 0.0;
    let residual = norm(&natural_residual(problem, d, &raw));
    let mut certificate = Certificate {
        // Written so that NaN stays NaN.
        eta: ratio(
            if residual <= 16.0 * inherent { 0.0 } else { residual - 16.0 * inherent },
            scale,
        ),
        rounding: ratio(if unloaded { rest } else { inherent + rest }, scale),
        penetration: 0.0,
        tension: 0.0,
        cone_excess: 0.0,
        equilibrium: 0.0,
        force: raw.clone(),
        states: Vec::with_capacity(problem.pairs()),
    };
    let margin = STATE_MARGIN * largest(problem.load()).max(largest(&raw));
    for_each_pair(problem, d, &raw, |index, pair| {
        let state = pair.state(margin);
        certificate.states.push(state);
        certificate.penetration = certificate.penetration.max(pair.opening);
        certificate.tension = certificate.tension.max(pair.normal_force);
        let excess = law::length(pair.tangential_force) - pair.threshold;
        certificate.cone_excess = certificate.cone_excess.max(excess);
        let (normal, tangential) = pair_mut(&mut certificate.force, problem.dim(), index);
        *normal = if state == State::Open { 0.0 } else { normal.min(0.0) };
        law::project_disc(tangential, problem.threshold(index, -*normal));
    });
    certificate.equilibrium =
        raw.iter().zip(&certificate.force).fold(0.0, |most, (a, b)| (a - b).abs().max(most));
    certificate
}

/// `eta` of `d` when `raw = K d - f` is at hand, without the rounding that only a full product
/// can tell: what a solver watches between two certificates.
pub fn eta(problem: &ContactProblem<'_>, d: &[f64], raw: &[f64]) -> f64 {
    ratio(norm(&natural_residual(problem, d, raw)), force_scale(problem, raw))
}

/// Whether the rigid motion `r` proves that no equilibrium exists.
///
/// `K r = 0` up to rounding, and for every pair that has an obstacle `-r_n >= mu |r_t|`: then the
/// contact forces can only do non-negative work `F . r >= sum |F_n| (|r_n| - mu |r_t|)`, while
/// equilibrium asks for `F . r = -f . r`. So `f . r > 0` excludes it. With given thresholds the
/// condition is `r_n <= 0` and `f . r > sum g |r_t|`.
pub fn is_escape(problem: &ContactProblem<'_>, r: &[f64]) -> bool {
    let n = problem.unknowns();
    let root: Vec<f64> = (0..n).map(|i| problem.diagonal(i).sqrt()).collect();
    let size = r.iter().zip(&root).fold(0.0, |most: f64, (r, root)| most.max((r * root).abs()));
    if size == 0.0 || !size.is_finite() {
        return false;
    }
    if problem.internal_force(r).iter().zip(&root).any(|(k, root)| k.abs() > RIGID * size * root) {
        return false;
    }
    let mut resisted = 0.0;
    for pair in 0..problem.pairs() {
        if problem.gap(pair) == f64::INFINITY && !matches!(problem.law(), FrictionLaw::Tresca(_)) {
            continue;
        }
        let i = problem.dim() * pair;
        let slide = law::length(&r[i + 1..i + problem.dim()]);
        let lift = match problem.law() {
            FrictionLaw::Frictionless => 0.0,
            FrictionLaw::Coulomb(mu) => mu[pair] * slide,
            FrictionLaw::Tresca(g) => {
                resisted += g[pair] * slide;
                0.0
            }
        };
        let bounded = problem.gap(pair) < f64::INFINITY;
        if bounded && (r[i] + lift) * root[i] > RIGID * size {
            return false;
        }
    }
    let load = problem.load();
    let work: f64 = load.iter().zip(r).map(|(f, r)| f * r).sum();
    let scale: f64 = load.iter().zip(&root).map(|(f, root)| size * (f / root).abs()).sum();
    work - resisted > WORK * scale
}

/// A motion is rigid when its internal forces are below this part of those of its components
/// alone: 100 times the rounding of a host's condensation, and beyond what can be certified.
const RIGID: f64 = 1e-11;

/// Least work of the loads, relative to what they could do on motions of that size, that tells
/// driving from balance.
const WORK: f64 = 1e-9;

fn natural_residual(problem: &ContactProblem<'_>, d: &[f64], raw: &[f64]) -> Vec<f64> {
    let mut residual = vec![0.0; raw.len()];
    for_each_pair(problem, d, raw, |index, pair| {
        let (normal, tangential) = pair_mut(&mut residual, problem.dim(), index);
        *normal = pair.normal_residual();
        pair.tangential_residual(tangential);
    });
    residual
}

fn force_scale(problem: &ContactProblem<'_>, raw: &[f64]) -> f64 {
    norm(problem.load()).max(norm(raw))
}

/// Norms of the rounding of `K d`: first that of displacements no larger than a body moves that
/// closes a gap or has slipped, then the rest.
fn rounding(problem: &ContactProblem<'_>, d: &[f64]) -> (f64, f64) {
    let dim = problem.dim();
    let mut prescribed = 0.0_f64;
    for pair in 0..problem.pairs() {
        let gap = problem.gap(pair);
        if d[dim * pair] >= gap {
            prescribed = prescribed.max(gap.abs());
        }
        for component in 0..dim - 1 {
            prescribed = prescribed.max(problem.reference_slip(pair, component).abs());
        }
    }
    let unit = f64::EPSILON / 2.0;
    let (mut inherent, mut rest) = (vec![0.0; d.len()], vec![0.0; d.len()]);
    for (j, dj) in d.iter().enumerate() {
        let size = unit * dj.abs();
        let prescribed = size.min(unit * LEVER * prescribed);
        if size > 0.0 {
            for ((k, inherent), rest) in problem.column(j).iter().zip(&mut inherent).zip(&mut rest)
            {
                *inherent += k.abs() * prescribed;
                *rest += k.abs() * (size - prescribed);
            }
        }
    }
    let inherent = norm(&inherent);
    (inherent, if inherent.is_finite() { norm(&rest) } else { f64::INFINITY })
}

fn for_each_pair(
    problem: &ContactProblem<'_>,
    d: &[f64],
    raw: &[f64],
    mut visit: impl FnMut(usize, &Pair<'_>),
) {
    let dim = problem.dim();
    for index in 0..problem.pairs() {
        let range = dim * index..dim * (index + 1);
        let (d, raw) = (&d[range.clone()], &raw[range]);
        let mut slip = [0.0; 2];
        for (component, slip) in slip[..dim - 1].iter_mut().enumerate() {
            *slip = d[1 + component] - problem.reference_slip(index, component);
        }
        let pair = Pair {
            opening: d[0] - problem.gap(index),
            slip: &slip[..dim - 1],
            normal_force: raw[0],
            tangential_force: &raw[1..],
            threshold: problem.threshold(index, (-raw[0]).max(0.0)),
            k_n: problem.diagonal(dim * index),
            k_t: problem.tangential_stiffness(index),
        };
        visit(index, &pair);
    }
}

fn pair_mut(values: &mut [f64], dim: usize, index: usize) -> (&mut f64, &mut [f64]) {
    let (normal, tangential) = values[dim * index..dim * (index + 1)].split_at_mut(1);
    (&mut normal[0], tangential)
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
