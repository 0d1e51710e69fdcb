//! Rows that depend on each other: `d = C z + o`, `K z = f + Cᵀ F`.
//!
//! Displacements do not determine forces here, which the other methods need. So each pair gets a soft
//! spring in series:
//!
//! ```text
//! F = F_k + D / e (d - C z - o)
//! ```
//!
//! With it the variables can be condensed, and the others solve for `d`, in [`super::rounds`]. What proves that the
//! gaps contradict each other are normal forces `p >= 0` with `Cᵀ p = 0` and `sum p (gap - o) < 0`.

use super::rounds::{
    COMPLIANCE, InSeries, changed, first_or_soft, rounds, solve as solve_by_rounds,
};
use super::step::{Means, ended};
use crate::error::{Argument, Error};
use crate::law::Contact;
use crate::linalg::sparse_matrix::{OutOfMemory, column, from_entries, transposed};
use crate::linalg::sparse_schur::{Failure, Plan, SparseSchur};
use crate::linalg::watched::unended;
use crate::monitor::{Stop, Watch};
use crate::problem::{ContactProblem, DependentRows, NEARLY_DEPENDENT, Relation};
use crate::solve::result::{Ending, Solution, Status};
use crate::solve::rigid::{Balance, RigidMotions};

/// Solves the problem from the displacements `start`; each round by `means`.
pub fn solve(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    means: Means<'_>,
    start: Option<&[f64]>,
) -> Result<Solution, Error> {
    let Means { settings, monitor, .. } = means;
    let relation = problem.relation();
    // Those of the stiffness with springs, which is ten thousand times as large, would carry its rounding.
    let scaled = relation.free_motions(&mut monitor.asking());
    let known = scaled.as_deref().unwrap_or(&[]);
    let first = match condensed((relation, known), COMPLIANCE, monitor)? {
        Ok(condensed) => condensed,
        Err(stop) => {
            let d = relation.relative(&begun(relation, start));
            let force = vec![0.0; d.len()];
            let how = (settings.method, &Ending::Stopped(stop), 0);
            return Ok(ended(&Contact::new(problem), (d, &force), settings, how));
        }
    };
    let motion =
        |v: &Vec<f64>| v.iter().zip(&relation.units).map(|(d, unit)| d / unit.sqrt()).collect();
    let free_motions: Option<Vec<Vec<f64>>> =
        scaled.as_ref().map(|scaled| scaled.iter().map(motion).collect());
    let (all, with_start) = (&|pair| pair, (settings, start));
    let (found, _) = solve_by_rounds(problem, all, with_start, |problem, settings, start| {
        let variables = begun(relation, start);
        let bodies = |softest: f64| Bodies {
            relation,
            first: &first,
            compliance: COMPLIANCE,
            softest,
            changed: None,
            known,
            free_motions: free_motions.as_deref(),
            before: variables.clone(),
            variables: variables.clone(),
            right: Vec::new(),
            monitor,
        };
        first_or_soft(problem, settings, |compliance, settings| {
            let mut bodies = bodies(compliance);
            bodies.set(compliance);
            let force = vec![0.0; relation.size()];
            rounds(problem, &mut bodies, force, Means { settings, ..means })
        })
    })?;
    match found.solution.status {
        Status::Stalled => {
            let found = found.solution;
            let rest = at_rest(problem, known, (means, &found));
            Ok(rest.unwrap_or(found))
        }
        _ => Ok(found.solution),
    }
}

/// Rigid bodies at rest, if none has a stiffness and forces in the friction cones of closed pairs balance the loads: masonry stands
/// if it can (J. Heyman: *The stone skeleton*. International Journal of Solids and Structures 2 (1966) 249–279).
fn at_rest(
    problem: &ContactProblem<'_, DependentRows<'_>>,
    known: &[Vec<f64>],
    (Means { settings, monitor, .. }, found): (Means<'_>, &Solution),
) -> Option<Solution> {
    let relation = problem.relation();
    let variables = relation.dependence.variables();
    if known.len() < variables {
        return None;
    }
    let d = relation.relative(&vec![0.0; variables]);
    let contact = Contact::new(problem);
    let motions = RigidMotions { root: problem.unit_roots(), basis: known.to_vec() };
    let is_closed = |pair: usize| contact.pairs()[pair].touches(d[problem.dim() * pair]);
    let force = Balance::of(&contact, motions, monitor, |_| false).balanced(is_closed).ok()?;
    let found =
        ended(&contact, (d, &force), settings, (found.method, &Ending::Done, found.factorisations));
    (found.status == Status::Solved).then_some(found)
}

/// The bodies between the pairs, with springs.
struct Bodies<'p> {
    relation: &'p DependentRows<'p>,
    first: &'p SparseSchur,
    compliance: f64,
    softest: f64,
    /// With other springs than the first ones.
    changed: Option<SparseSchur>,
    /// Those motions with each component times the root of its unit.
    known: &'p [Vec<f64>],
    free_motions: Option<&'p [Vec<f64>]>,
    variables: Vec<f64>,
    /// Those before the last round.
    before: Vec<f64>,
    /// The load of the round on the variables, and on the displacements beyond the springs.
    right: Vec<f64>,
    monitor: &'p dyn Watch,
}

impl Bodies<'_> {
    fn condensed(&self) -> &SparseSchur {
        self.changed.as_ref().unwrap_or(self.first)
    }

    /// Takes other springs. Those before are released first, and where there is no time for others the first ones come back.
    fn set(&mut self, compliance: f64) {
        if compliance == self.compliance {
            return;
        }
        (self.compliance, self.changed) = (COMPLIANCE, None);
        if compliance != COMPLIANCE
            && let Ok(Ok(condensed)) =
                condensed((self.relation, self.known), compliance, self.monitor)
        {
            (self.compliance, self.changed) = (compliance, Some(condensed));
        }
    }
}

impl InSeries for Bodies<'_> {
    fn compliance(&self) -> f64 {
        self.compliance
    }

    fn displacements(&self, _: &[f64]) -> Vec<f64> {
        self.relation.relative(&self.variables)
    }

    fn stiffness(&self) -> &[f64] {
        &self.condensed().schur
    }

    fn free_motions(&self) -> Option<&[Vec<f64>]> {
        self.free_motions
    }

    fn load(&mut self, force: &[f64]) -> Vec<f64> {
        self.right = self.relation.unbalanced(&self.variables, force);
        self.right.extend(force.iter().map(|force| -force));
        unended(|goes_on| self.condensed().condense(&self.right, goes_on))
    }

    fn advance(&mut self, step: &[f64]) {
        let step = unended(|goes_on| self.condensed().recover(&self.right, step, goes_on));
        self.before.clone_from(&self.variables);
        self.variables.iter_mut().zip(&step).for_each(|(z, step)| *z += step);
    }

    /// Softer ones begin where the round did that less compliant ones have failed in.
    fn change(&mut self, softer: bool) {
        let compliance = changed(self.compliance, softer, self.softest);
        if softer {
            self.variables.clone_from(&self.before);
        }
        self.set(compliance);
    }

    fn are_softest(&self) -> bool {
        self.compliance >= self.softest
    }

    fn are_solved_by_all_means(&self) -> bool {
        true
    }
}

/// The stiffness of the variables and the springs, condensed on the displacements beyond the springs, or why that
/// was stopped.
fn condensed(
    (relation, known): (&DependentRows<'_>, &[Vec<f64>]),
    compliance: f64,
    monitor: &dyn Watch,
) -> Result<Result<SparseSchur, Stop>, Error> {
    let memory = |_: OutOfMemory| Error::OutOfMemory("the stiffness of dependent rows");
    let (stiffness, dependence) = (relation.stiffness, relation.dependence);
    let (kept, size) = (dependence.variables(), relation.size());
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    for j in 0..kept {
        let below = (j..kept).filter(|&i| i == j || stiffness.at(i, j) != 0.0);
        entries.extend(below.map(|i| (i, j, stiffness.at(i, j))));
    }
    let rows = transposed(&dependence.to_relative).map_err(memory)?;
    for i in 0..size {
        let spring = relation.units[i] / compliance;
        let (variables, coefficients) = column(&rows, i);
        for (&j, c) in variables.iter().zip(coefficients) {
            entries.push((kept + i, j, -spring * c));
            let below = variables.iter().zip(coefficients).filter(|(k, _)| **k >= j);
            entries.extend(below.map(|(&k, other)| (k, j, spring * c * other)));
        }
        entries.push((kept + i, kept + i, spring));
    }
    let all = from_entries((kept + size, kept + size), entries.into_iter()).map_err(memory)?;
    let mut stopped = None;
    let watched = &mut |_| {
        monitor.goes_on().map_err(|stop| {
            stopped = Some(stop);
            Failure::Stopped
        })
    };
    let made = Plan::new(&all, kept, None, watched)
        .and_then(|plan| SparseSchur::new(plan, all, Some(known), watched));
    match (made, stopped) {
        (Ok(made), _) => Ok(Ok(made)),
        (Err(_), Some(stop)) => Ok(Err(stop)),
        (Err(Failure::OutOfMemory), None) => {
            Err(Error::OutOfMemory("the factor of dependent rows"))
        }
        (Err(_), None) => Err(Error::invalid(
            Argument::Matrix,
            format!(
                "the stiffness of the bodies between dependent pairs cannot be told from rounding: {NEARLY_DEPENDENT}"
            ),
        )),
    }
}

/// The variables of the displacements `start`, without forces.
fn begun(relation: &DependentRows<'_>, start: Option<&[f64]>) -> Vec<f64> {
    let force = vec![0.0; relation.size()];
    start.map_or_else(
        || vec![0.0; relation.dependence.variables()],
        |start| relation.variables(start, &force),
    )
}
