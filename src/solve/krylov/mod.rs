//! Contact on bodies whose stiffness `K_rel` is never formed: Newton's method on the normal map
//! (`law::normal_map`) with products and solutions only (D. A. Knoll and D. E. Keyes, *Jacobian-free
//! Newton-Krylov methods*, J. Comput. Phys. 193 (2004) 357-397, for the family).

mod condensed;
mod counted;
mod directions;
mod newton;
mod point;
mod step;
mod thresholds;
mod walk;

use super::candidate::Ending;
use super::outcome::{Solution, Status};
use super::remarks::of_problem;
use crate::certificate::{Certificate, measure_spread};
use crate::error::{Argument, Error};
use crate::law::{Contact, gaps_within_reach};
use crate::monitor::Monitor;
use crate::problem::{Bodies, ContactProblem, FrictionLaw, Restriction, Unformed};
use crate::settings::{Method, Search, Settings};
use counted::{Counted, Counts};
use newton::{Ended, Goal};
use point::{Displacements, Equations, Point};

/// A load case on such bodies.
pub struct Case<'a> {
    /// Components of a pair.
    pub dim: usize,
    /// Loads of all unknowns of the bodies.
    pub load: &'a [f64],
    pub gap: &'a [f64],
    pub law: FrictionLaw<'a>,
    pub reference_slip: Option<&'a [f64]>,
}

/// Refuses settings that need a stiffness.
pub fn check(settings: &Settings) -> Result<(), Error> {
    settings.validate()?;
    let refuse = |what: &str| {
        let message =
            format!("settings: {what} needs the condensed matrix, which this model does not form");
        Err(Error::invalid(Argument::Settings, message))
    };
    if !matches!(settings.method, Method::Auto | Method::Newton) {
        return refuse("a method other than auto and Newton's");
    }
    if settings.search == Search::Others {
        return refuse("the search for other solutions");
    }
    if settings.proof {
        return refuse("a proof that the solution exists");
    }
    Ok(())
}

/// How many times longer than the displacements that can be expected a gap must be to be left out: beside it the
/// loads lose their digits, as in `solve::far_obstacles`.
const FAR: f64 = 1e6;

/// Other vectors of all unknowns.
const VECTORS: usize = 60;

/// Most bytes that [`solve`] takes for so many unknowns, beside what the bodies take.
pub fn memory(unknowns: usize) -> u64 {
    condensed::memory(unknowns, memory_of_steps(unknowns)) + vectors(VECTORS, unknowns)
}

/// Most bytes of the directions of a step, which later ways to a solution have for themselves.
fn memory_of_steps(unknowns: usize) -> u64 {
    let directions = step::MOST_DIRECTIONS + directions::most_kept(unknowns);
    vectors(directions::VECTORS * directions, unknowns)
}

fn vectors(count: usize, unknowns: usize) -> u64 {
    (count * size_of::<f64>() * unknowns) as u64
}

/// Solves a load case from the displacements `start` (the pairs stuck at their gaps if `None`).
pub fn solve(
    bodies: &mut dyn Bodies,
    case: &Case<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    monitor: &mut Monitor<'_>,
) -> Result<Solution, Error> {
    check(settings)?;
    let bodies = &mut Counted::new(bodies);
    hold_all(bodies, case)?;
    let (at_zero, relative) = at_zero(bodies, case.load)?;
    let unformed = Unformed::new(bodies, case.dim, &relative);
    let problem = |gap| {
        let unformed = unformed.clone();
        ContactProblem::with_relation(unformed, case.dim, gap, case.law, case.reference_slip)
    };
    let whole = problem(case.gap)?;
    let contact = Contact::new(&whole);
    let work = Work { case, settings, start, at_zero: &at_zero, relative: &relative };
    let mut solution = None;
    let gaps = gaps_within_reach(&contact, &[], FAR);
    if let Some(gaps) = &gaps {
        let near = problem(gaps)?;
        let found = work.solve(&contact, &Contact::new(&near), bodies, monitor)?;
        solution = Some(found).filter(|found| found.status != Status::Stalled);
    }
    let solution = match solution {
        Some(solution) => solution,
        None => work.solve(&contact, &contact, bodies, monitor)?,
    };
    let Counts { solutions, factorisations } = bodies.counts;
    Ok(Solution { factorisations, outer_iterations: solutions, ..solution })
}

/// A load case with what is known of it.
struct Work<'a> {
    case: &'a Case<'a>,
    settings: &'a Settings,
    start: Option<&'a [f64]>,
    /// Displacements where those of the pairs are zero.
    at_zero: &'a Displacements,
    /// The relative loads.
    relative: &'a [f64],
}

impl Work<'_> {
    /// Solves the contact `near`, and measures the result on `contact`, which has further obstacles.
    fn solve(
        &self,
        contact: &Contact<'_, Unformed<'_>>,
        near: &Contact<'_, Unformed<'_>>,
        bodies: &mut dyn Bodies,
        monitor: &mut Monitor<'_>,
    ) -> Result<Solution, Error> {
        let (inner, load) = (bodies.inner(), self.case.load);
        let mut at = self.at_zero.clone();
        if contact.is_unloaded() && rests(contact, bodies, &at, load, self.settings)? {
            return certified(contact, bodies, (load, at), self.settings, None);
        }
        let held = hold_all(bodies, self.case)?;
        let references = near.pairs().iter().flat_map(|law| {
            let reference = law.reference();
            reference.into_iter().take(self.case.dim)
        });
        match self.start {
            Some(start) => at.x[inner..].copy_from_slice(&near.admissible(start)),
            None => at.x[inner..].iter_mut().zip(references).for_each(|(x, held)| *x = held),
        }
        let at = at.in_equilibrium(bodies, load)?;
        let equations = Equations::new(near, bodies, load, self.relative);
        let goal = Goal { tolerance: self.settings.tolerance, systems: newton::MOST_SYSTEMS };
        let ended = from(&equations, bodies, (at.clone(), held), goal, monitor)?;
        certified(contact, bodies, (load, at), self.settings, Some(ended))
    }
}

/// Components of a pair in the plane.
const PLANE: usize = 2;

/// Newton's method from displacements whose inner ones are in equilibrium, and what follows where it fails.
fn from(
    equations: &Equations<'_>,
    bodies: &mut dyn Bodies,
    (at, held): (Displacements, Option<Restriction>),
    goal: Goal,
    monitor: &mut Monitor<'_>,
) -> Result<Ended, Error> {
    let fails = |ended: &Ended| matches!(ended.ending, Ending::Stalled(_));
    let point = equations.held_at(at.clone(), bodies)?;
    let mut best = newton::solve(equations, bodies, point, held, goal, monitor)?;
    if fails(&best) && best.point.merit.is_finite() && equations.contact.is_coupled() {
        best = thresholds::solve(equations, bodies, at, best, goal, monitor)?;
    }
    if fails(&best) && best.point.merit.is_finite() && equations.contact.dim() == PLANE {
        best = walk::solve(equations, bodies, best, goal, monitor)?;
    }
    match fails(&best) && best.point.merit.is_finite() {
        true => {
            let room = memory_of_steps(equations.load.len());
            condensed::solve(equations, bodies, best, room, goal, monitor)
        }
        false => Ok(best),
    }
}

/// Measures displacements `d` of the pairs, of any origin, on a load case.
pub fn certify(bodies: &mut dyn Bodies, case: &Case<'_>, d: &[f64]) -> Result<Certificate, Error> {
    let (inner, load) = (bodies.inner(), case.load);
    hold_all(bodies, case)?;
    let (mut at, relative) = at_zero(bodies, load)?;
    let unformed = Unformed::new(bodies, case.dim, &relative);
    let (gap, slip) = (case.gap, case.reference_slip);
    let problem = ContactProblem::with_relation(unformed, case.dim, gap, case.law, slip)?;
    at.x[inner..].copy_from_slice(d);
    for _ in 0..REFINEMENTS {
        at = at.in_equilibrium(bodies, load)?;
    }
    let residual = bodies.residual(&at.x, &at.low, load)?;
    Ok(measure_spread(&Contact::new(&problem), bodies, &at.x, &residual))
}

/// Solutions for the inner unknowns of given `d`, each with the residual of the one before.
const REFINEMENTS: usize = 2;

/// Holds all pairs, if bodies can hold any.
fn hold_all(bodies: &mut dyn Bodies, case: &Case<'_>) -> Result<Option<Restriction>, Error> {
    if !bodies.can_hold() {
        return Ok(None);
    }
    let all = Restriction::all(case.dim, (case.load.len() - bodies.inner()) / case.dim);
    bodies.hold(&all, &mut || true)?;
    Ok(Some(all))
}

/// Whether no displacement at all is the solution.
fn rests(
    contact: &Contact<'_, Unformed<'_>>,
    bodies: &mut dyn Bodies,
    at: &Displacements,
    load: &[f64],
    settings: &Settings,
) -> Result<bool, Error> {
    let residual = bodies.residual(&at.x, &at.low, load)?;
    Ok(measure_spread(contact, bodies, &at.x, &residual).holds(settings.tolerance))
}

/// Displacements where those of the pairs are zero and held, and the relative loads: minus the forces there.
fn at_zero(bodies: &mut dyn Bodies, load: &[f64]) -> Result<(Displacements, Vec<f64>), Error> {
    let inner = bodies.inner();
    let mut at = Displacements::new(vec![0.0; load.len()], inner);
    if inner == 0 {
        return Ok((at, load.to_vec()));
    }
    at = at.in_equilibrium(bodies, load)?;
    let forces = bodies.residual(&at.x, &at.low, load)?;
    let relative = forces[inner..].iter().map(|f| -f).collect();
    Ok((at, relative))
}

/// The result, measured on the data of the bodies.
fn certified(
    contact: &Contact<'_, Unformed<'_>>,
    bodies: &mut dyn Bodies,
    (load, at_rest): (&[f64], Displacements),
    settings: &Settings,
    ended: Option<Ended>,
) -> Result<Solution, Error> {
    let (x, residual, ending, systems) = match ended {
        None => {
            let residual = bodies.residual(&at_rest.x, &at_rest.low, load)?;
            (at_rest.x, residual, Ending::Done, 0)
        }
        Some(Ended { point: Point { at, residual, .. }, ending, systems, .. }) => {
            (at.x, residual, ending, systems)
        }
    };
    let certificate =
        measure_spread(contact, bodies, &x, &residual).with_rounding(settings.tolerance);
    let accuracy = format!("eta is {:.1e}", certificate.eta);
    let wanted = format!("{accuracy}, wanted {:.1e}", settings.tolerance);
    let (status, message) = match ending {
        _ if certificate.holds(settings.tolerance) => {
            (Status::Solved, format!("solved: {accuracy}"))
        }
        Ending::Stopped(stop) => stop.status(settings, &wanted),
        ending => (Status::Stalled, format!("{}; {wanted}", ending.reason(&certificate))),
    };
    let d = x[bodies.inner()..].to_vec();
    Ok(Solution {
        remarks: of_problem(contact.problem()),
        iterations: systems,
        ..Solution::of(Method::Newton, (status, message), d, certificate)
    })
}
