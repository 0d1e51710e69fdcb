//! Rows that depend on each other: `d = C z + o`, `K z = f + Cᵀ F`.
//!
//! Displacements do not determine forces here, which the other methods need. So each pair gets a soft
//! spring in series, of stiffness `D / e`, that is stretched to the forces of the round before:
//!
//! ```text
//! F = F_k + D / e (d - C z - o)
//! ```
//!
//! With it the variables can be condensed, and the others solve for `d`. Round by round the springs are
//! stretched anew, until their change and with it the error is nothing: a proximal iteration on the forces
//! (R. T. Rockafellar: *Monotone operators and the proximal point algorithm*. SIAM Journal on Control and
//! Optimization 14 (1976) 877–898). From `F_0 = 0` it takes, where states do not change on the way, the
//! smallest of the forces that dependent rows leave open, in the norm of `D⁻¹`.
//!
//! Where the forces grow without end there is no solution near: they balance each other and wedge the bodies,
//! or the gaps contradict each other. The second is proved by normal forces `p >= 0` with `Cᵀ p = 0` and
//! `sum p (gap - o) < 0`.

mod growth;
mod sprung;

use super::result::{Solution, Status};
use crate::error::{Argument, Error};
use crate::law::{Contact, without_friction};
use crate::linalg::sparse_matrix::{OutOfMemory, column, from_entries, transposed};
use crate::linalg::sparse_schur::{FactorProgress, Failure, RigidModeCheck, SparseSchur, Stopped};
use crate::linalg::vector::norm_inf;
use crate::monitor::{Monitor, Stop};
use crate::problem::{ContactProblem, DependentRows, Relation};
use crate::settings::{Method, SMALLEST_TOLERANCE, Settings};
pub use growth::{Growth, contradicts, named, sentence};
pub use sprung::{measured, step, stopped};

/// `e`, the compliance of the springs beside that of the bodies. A round divides the error by the compliance
/// of the least compliant pattern of forces over `e`; the condensed matrix loses as many digits as `e` has.
const COMPLIANCE: f64 = 1e-4;

/// Most rounds: patterns of forces with a compliance of `e` itself halve their error in each.
const ROUNDS: usize = 60;

/// Part of the tolerance that the problem with springs is solved to, as far as that can be had: the springs
/// leave the first rounds fewer digits, and later ones mend it.
const INNER: f64 = 0.1;

/// Part of the error before a round that is enough for the round.
const ROUGH: f64 = 1e-3;

/// The error before the first round, where there is no measure of it: that of the springs.
const FIRST: f64 = COMPLIANCE;

/// Part of the least error that is left where a round has made progress.
const HALF: f64 = 0.5;

/// So many rounds that do not halve the least error show that rounding is reached.
const IDLE_ROUNDS: usize = 12;

/// Most rounds after the first solution, until the forces settle. Rows that nearly depend on each other enlarge
/// the loads on their variables, and `eta`, which is relative to these, is small before the forces are right.
const LAST_ROUNDS: usize = 4;

/// The problem that a round works on.
struct Sprung<'p> {
    problem: &'p ContactProblem<'p, DependentRows<'p>>,
    contact: Contact<'p, DependentRows<'p>>,
    condensed: &'p SparseSchur,
}

/// Solves the problem from the displacements `start`.
pub fn solve(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    let condensed = &match condensed(problem.relation(), monitor)? {
        Ok(condensed) => condensed,
        Err(stop) => {
            let d = problem.relation().relative(&begun(problem.relation(), start));
            let force = vec![0.0; d.len()];
            return Ok(stopped(&Contact::new(problem), (d, &force), settings, stop));
        }
    };
    let sprung = Sprung { problem, contact: Contact::new(problem), condensed };
    let (mut solution, growth) = sprung.rounds(settings, start, monitor)?;
    if solution.status == Status::Stalled {
        let mut pattern = growth.pattern().map(<[f64]>::to_vec);
        let mut proved = pattern.as_deref().is_some_and(|pattern| contradicts(problem, pattern));
        if !proved && let Some(found) = contradiction(problem, condensed, settings, monitor)? {
            (pattern, proved) = (Some(found), true);
        }
        let eta = solution.certificate.eta;
        solution.message = sentence(problem, pattern.as_deref(), proved, eta, &|pair| pair).into();
    }
    Ok(solution)
}

/// Normal forces which prove that the gaps contradict each other, from the problem without friction: with
/// friction they may hide behind forces that wedge.
fn contradiction(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    condensed: &SparseSchur,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Option<Vec<f64>>, Error> {
    let problem = &without_friction(problem);
    let settings = Settings { method: Method::Auto, ..settings.clone() };
    let sprung = Sprung { problem, contact: Contact::new(problem), condensed };
    let (_, growth) = sprung.rounds(&settings, None, monitor)?;
    let pattern = growth.pattern().filter(|pattern| contradicts(problem, pattern));
    Ok(pattern.map(<[f64]>::to_vec))
}

/// Ends a factorisation when the time is up or the callback cancels.
struct Watched<'m, 'c> {
    monitor: &'m mut Monitor<'c>,
    stop: Option<Stop>,
}

impl FactorProgress for Watched<'_, '_> {
    fn has_done(&mut self, _: f64) -> Result<(), Stopped> {
        self.monitor.goes_on().map_err(|stop| {
            self.stop = Some(stop);
            Stopped
        })
    }
}

/// The stiffness of the variables and the springs, condensed on the displacements beyond the springs, or why that
/// was stopped.
fn condensed(
    relation: &DependentRows<'_>,
    monitor: &mut Monitor<'_>,
) -> Result<Result<SparseSchur, Stop>, Error> {
    let memory = |_: OutOfMemory| Error::OutOfMemory("the stiffness of dependent rows");
    let (stiffness, dependence) = (relation.stiffness(), relation.dependence());
    let (kept, size) = (dependence.variables(), relation.size());
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for j in 0..kept {
        let below = (j..kept).filter(|&i| i == j || stiffness.at(i, j) != 0.0);
        entries.extend(below.map(|i| (i, j, stiffness.at(i, j))));
    }
    let rows = transposed(dependence.to_relative()).map_err(memory)?;
    for i in 0..size {
        let spring = relation.units()[i] / COMPLIANCE;
        let (variables, coefficients) = column(&rows, i);
        for (&j, c) in variables.iter().zip(coefficients) {
            entries.push((kept + i, j, -spring * c));
            let below = variables.iter().zip(coefficients).filter(|(k, _)| **k >= j);
            entries.extend(below.map(|(&k, other)| (k, j, spring * c * other)));
        }
        entries.push((kept + i, kept + i, spring));
    }
    let all = from_entries((kept + size, kept + size), entries.into_iter()).map_err(memory)?;
    let workers = monitor.workers();
    let mut watched = Watched { monitor, stop: None };
    let made = SparseSchur::new(all, kept, None, RigidModeCheck::Always, workers, &mut watched);
    match (made, watched.stop) {
        (Ok(made), _) => Ok(Ok(made)),
        (Err(_), Some(stop)) => Ok(Err(stop)),
        (Err(Failure::OutOfMemory), None) => {
            Err(Error::OutOfMemory("the factor of dependent rows"))
        }
        (Err(_), None) => Err(Error::invalid(
            Argument::Matrix,
            "the stiffness of the bodies between dependent pairs cannot be told from rounding: if two surfaces are \
             each other's slaves, let one side be the slave; if slaves along a plane of symmetry are finer than what \
             they face, name the plane where they are paired, or let the other side be the slave",
        )),
    }
}

/// True if forces whose last two changes are `changes` will change by no more than `allowed`: each change is the
/// same part of the one before.
pub fn settles([before, last]: [f64; 2], allowed: f64) -> bool {
    last <= allowed || last < before && before.is_finite() && last * (last / before) <= allowed
}

/// The variables of the displacements `start`.
fn begun(relation: &DependentRows<'_>, start: Option<&[f64]>) -> Vec<f64> {
    let dependence = relation.dependence();
    start.map_or_else(|| vec![0.0; dependence.variables()], |start| dependence.of_relative(start))
}

impl Sprung<'_> {
    fn relation(&self) -> &DependentRows<'_> {
        self.problem.relation()
    }

    /// The best result of all rounds, and how the forces have grown.
    fn rounds(
        &self,
        settings: &Settings,
        start: Option<&[f64]>,
        monitor: &mut Monitor<'_>,
    ) -> Result<(Solution, Growth), Error> {
        let relation = self.relation();
        let mut variables = begun(relation, start);
        let mut force = vec![0.0; relation.size()];
        let mut growth = Growth::default();
        let mut best: Option<Solution> = None;
        let (mut last, mut least, mut idle) = (FIRST, f64::INFINITY, 0);
        let (mut changes, mut solved) = ([f64::INFINITY; 2], 0);
        for _ in 0..ROUNDS {
            let wanted = (INNER * settings.tolerance).max(ROUGH * last.min(FIRST));
            let inner = Settings { tolerance: wanted.max(SMALLEST_TOLERANCE), ..settings.clone() };
            let d = relation.relative(&variables);
            let round = self.round(&inner, (&variables, &d, &force), monitor)?;
            if matches!(round.0.status, Status::Solved | Status::Stalled) {
                let change = round.0.certificate.force.iter().zip(&force).map(|(a, b)| a - b);
                let change: Vec<f64> = change.collect();
                changes = [changes[1], norm_inf(&change)];
                growth.add(change);
                force.clone_from(&round.0.certificate.force);
                variables.iter_mut().zip(&round.1).for_each(|(z, step)| *z += step);
            }
            let result = (relation.relative(&variables), &force[..]);
            let found = measured(&self.contact, round.0, result, settings);
            last = found.certificate.eta;
            idle = if last < HALF * least { 0 } else { idle + 1 };
            least = least.min(last);
            let is_solved = found.status == Status::Solved;
            solved += usize::from(is_solved || solved > 0);
            let ends = match found.status {
                Status::Solved => settles(changes, settings.tolerance * norm_inf(&force)),
                Status::Stalled => growth.pattern().is_some() || idle >= IDLE_ROUNDS,
                _ => true,
            } || solved > LAST_ROUNDS;
            let is_best = |best: &Solution| match best.status {
                Status::Solved => is_solved,
                _ => {
                    found.status != Status::Stalled || found.certificate.eta < best.certificate.eta
                }
            };
            if best.as_ref().is_none_or(is_best) {
                best = Some(found);
            }
            if ends {
                break;
            }
        }
        let best = best.ok_or(Error::OutOfMemory("a round of dependent rows"))?;
        Ok((best, growth))
    }

    /// Solves the problem with springs, from where the bodies and their forces are; returns with it the step
    /// of the variables.
    fn round(
        &self,
        settings: &Settings,
        (variables, d, force): (&[f64], &[f64], &[f64]),
        monitor: &mut Monitor<'_>,
    ) -> Result<(Solution, Vec<f64>), Error> {
        let kept = variables.len();
        let mut right = self.relation().unbalanced(variables, force);
        right.extend(force.iter().map(|force| -force));
        let load = self.condensed.condense(&right);
        let system = (self.condensed.schur(), &load[..]);
        let solution = step(self.problem, system, d, settings, monitor)?;
        let mut step = self.condensed.recover(&right, &solution.d);
        step.truncate(kept);
        Ok((solution, step))
    }
}
