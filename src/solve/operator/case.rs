//! A load case on bodies whose stiffness is not formed: its solution, and the measure of a result.

use super::free_motions::FreeMotions;
use super::newton::{self, Outcome, Tried};
use super::past::CasePast;
use super::point::{Displacements, Equations, Point};
use super::session::Session;
use super::{condensed, thresholds};
use crate::certificate::{Certificate, is_spread_escape, measure_spread};
use crate::error::{Argument, Error};
use crate::law::{Contact, gaps_within_reach, references};
use crate::linalg::vector::{normalise, opposite};
use crate::monitor::{Monitor, Watch};
use crate::problem::{ContactProblem, FrictionLaw, MatrixFree, StiffnessOperator};
use crate::settings::{Method, Search, Settings};
use crate::solve::plan::{self, FAR, remark_on_data};
use crate::solve::result::{Ending, Solution, Solve, Status};
use crate::solve::rigid;

/// Part of the forces inside that is left at the start where there is a preconditioner alone: the relative loads are the
/// unit of `eta`, and the first system takes it away.
const LEFT_AT_START: f64 = 1e-3;

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
fn check(settings: &Settings) -> Result<(), Error> {
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

/// Solves a load case from the displacements `start` (the pairs stuck at their gaps if `None`), with what cases before it
/// have left in `past`. A factor with all pairs held is made where the load is no sum of loads before it, or the start
/// is not the last solution.
///
/// # Errors
/// Settings that need a stiffness, arguments out of range, memory that cannot be had, and what has failed in the host.
pub fn solve(
    bodies: &mut dyn StiffnessOperator,
    case: &Case<'_>,
    settings: &Settings,
    start: Option<&[f64]>,
    past: &mut CasePast,
    monitor: &dyn Watch,
) -> Result<Solution, Error> {
    check(settings)?;
    let mut bodies = Session::new(bodies, monitor);
    let loaded = Loaded::new(&mut bodies, (case, settings), past)?;
    let whole = loaded.problem(&bodies, case.gap)?;
    let contact = &Contact::new(&whole);
    let mut solution = None;
    if let Some(gaps) = gaps_within_reach(contact, &[], FAR) {
        let near = loaded.problem(&bodies, &gaps)?;
        let near = &Contact::new(&near);
        let found = loaded.solve((contact, near), &mut bodies, start, past)?;
        solution = Some(found).filter(|found| found.status != Status::Stalled);
    }
    let solution = match solution {
        Some(solution) => solution,
        None => loaded.solve((contact, contact), &mut bodies, start, past)?,
    };
    let Session { solutions, factorisations, .. } = bodies;
    Ok(Solution { factorisations, outer_iterations: solutions, ..solution })
}

/// Measures displacements `d` of the pairs, of any origin, on a load case.
///
/// # Errors
/// As [`solve`].
pub fn certify(
    bodies: &mut dyn StiffnessOperator,
    case: &Case<'_>,
    d: &[f64],
) -> Result<Certificate, Error> {
    let settings = &Settings::default();
    let endless = &Monitor::new(settings, None);
    let mut bodies = Session::new(bodies, endless);
    let loaded = Loaded::new(&mut bodies, (case, settings), &mut CasePast::default())?;
    let problem = loaded.problem(&bodies, case.gap)?;
    let mut at = loaded.at_zero.clone();
    at.x[bodies.operator.inner()..].copy_from_slice(d);
    at = ended(at.clone().settled((&mut bodies, case.dim), case.load))?.unwrap_or(at);
    let residual = bodies.residual(&at.x, &at.low, case.load)?;
    Ok(measure_spread(&Contact::new(&problem), bodies.operator, &at.x, &residual))
}

/// A load case with what the bodies say of it where all pairs are held.
struct Loaded<'a> {
    case: &'a Case<'a>,
    settings: &'a Settings,
    /// Displacements where those of the pairs are zero.
    at_zero: Displacements,
    /// The residual there.
    residual: Vec<f64>,
    /// The relative loads: minus the forces on the pairs there.
    relative: Vec<f64>,
    /// How the call ends if there was no time for a factor: nothing is in equilibrium then.
    stopped: Option<Ending>,
}

impl<'a> Loaded<'a> {
    fn new(
        bodies: &mut Session<'_>,
        (case, settings): (&'a Case<'a>, &'a Settings),
        past: &mut CasePast,
    ) -> Result<Self, Error> {
        let inner = bodies.operator.inner();
        let nothing = Displacements::zero(case.load.len(), inner);
        let found = past.at_zero(case.load, || {
            bodies.hold_all(case.dim)?;
            nothing.clone().in_equilibrium(bodies, (case.load, LEFT_AT_START))
        });
        let (at_zero, stopped) = match ended(found)? {
            Ok(at_zero) => (at_zero, None),
            Err(stopped) => (nothing, Some(stopped)),
        };
        let residual = bodies.residual(&at_zero.x, &at_zero.low, case.load)?;
        let relative = opposite(&residual[inner..]);
        Ok(Loaded { case, settings, at_zero, residual, relative, stopped })
    }

    /// The contact problem with these gaps.
    fn problem<'p>(
        &'p self,
        bodies: &Session<'_>,
        gap: &'p [f64],
    ) -> Result<ContactProblem<'p, MatrixFree<'p>>, Error> {
        let Case { dim, law, reference_slip, .. } = *self.case;
        let relation = MatrixFree::new(bodies.operator, dim, &self.relative, &self.at_zero.x);
        ContactProblem::with_relation(relation, dim, gap, law, reference_slip)
    }

    /// The first displacements: those of the pairs are `start`, or their references, and the inner ones in equilibrium.
    fn start(
        &self,
        near: &Contact<'_, MatrixFree<'_>>,
        bodies: &mut Session<'_>,
        (start, past): (Option<&[f64]>, &CasePast),
    ) -> Result<Displacements, Ending> {
        if let Some(stopped) = &self.stopped {
            return Err(stopped.clone());
        }
        if let Some(last) = start.and_then(|start| past.last(start)) {
            return Ok(last.clone());
        }
        bodies.hold_all(self.case.dim)?;
        let mut at = self.at_zero.clone();
        let of_pairs = &mut at.x[bodies.operator.inner()..];
        let references = || references(near.pairs(), self.case.dim).collect();
        of_pairs.copy_from_slice(&start.map_or_else(references, |start| near.admissible(start)));
        if of_pairs.iter().all(|x| *x == 0.0) && !bodies.operator.is_exact() {
            return Ok(at);
        }
        at.in_equilibrium(bodies, (self.case.load, LEFT_AT_START))
    }

    /// The pairs at zero without a relative load, if that is a solution: as it was found, or, where loads act far from the
    /// contact, without the rounding that they have left inside.
    fn rest(
        &self,
        contact: &Contact<'_, MatrixFree<'_>>,
        bodies: &mut Session<'_>,
        past: &mut CasePast,
    ) -> Result<Option<Solution>, Error> {
        let mut rest_at = |at: &Displacements, residual: &[f64], bodies: &mut Session<'_>| {
            let rest = self.result(contact, bodies, ((at, residual), &Ending::Done), past);
            Some(rest).filter(|rest| rest.status == Status::Solved)
        };
        let rest = rest_at(&self.at_zero, &self.residual, bodies);
        if rest.is_some() {
            return Ok(rest);
        }
        let Case { dim, load, .. } = *self.case;
        let settled = self.at_zero.clone().settled((bodies, dim), load);
        let Ok(at) = ended(settled)? else { return Ok(None) };
        let residual = bodies.residual(&at.x, &at.low, load)?;
        Ok(rest_at(&at, &residual, bodies))
    }

    /// Solves the contact `near`, and measures the result on `contact`, which has further obstacles.
    fn solve(
        &self,
        (contact, near): (&Contact<'_, MatrixFree<'_>>, &Contact<'_, MatrixFree<'_>>),
        bodies: &mut Session<'_>,
        start: Option<&[f64]>,
        past: &mut CasePast,
    ) -> Result<Solution, Error> {
        let at_zero = (&self.at_zero, &self.residual[..]);
        if contact.is_unloaded()
            && let Some(rest) = self.rest(contact, bodies, past)?
        {
            return Ok(rest);
        }
        let at = match ended(self.start(near, bodies, (start, past)))? {
            Ok(at) => at,
            Err(ending) => return Ok(self.result(contact, bodies, (at_zero, &ending), past)),
        };
        let tolerance = self.settings.tolerance;
        let equations = Equations::new(near, bodies.operator, self.case.load, tolerance);
        let Outcome { point, ending, .. } = by_attempts(&equations, bodies, &at)?;
        let found = ((&point.at, &point.residual[..]), &ending);
        let mut solution = self.result(contact, bodies, found, past);
        if let Ending::Recession(motion) = ending
            && solution.status == Status::Stalled
            && is_spread_escape(contact, bodies.operator, &motion)?
        {
            solution.status = Status::NoEquilibrium;
            let mut motion = motion[bodies.operator.inner()..].to_vec();
            normalise(&mut motion);
            solution.recession = Some(motion);
            describe(contact, bodies, &mut solution)?;
        }
        Ok(solution)
    }

    /// The result at displacements of all unknowns with their residual, by its certificate.
    fn result(
        &self,
        contact: &Contact<'_, MatrixFree<'_>>,
        bodies: &mut Session<'_>,
        ((at, residual), ending): ((&Displacements, &[f64]), &Ending),
        past: &mut CasePast,
    ) -> Solution {
        let settings = self.settings;
        let certificate = measure_spread(contact, bodies.operator, &at.x, residual);
        let certificate = certificate.with_rounding(settings.tolerance);
        let d = at.x[bodies.operator.inner()..].to_vec();
        if certificate.holds(settings.tolerance) {
            bodies.operator.remember(self.case.load, &at.x);
            past.solved(at.clone());
        }
        let told = ending.status(settings, &certificate);
        let mut solution = Solution::of(Method::Newton, told, d, certificate);
        remark_on_data(contact.problem(), settings, &mut solution);
        solution
    }
}

/// Newton's method, and what follows until the certificate calls one's result a solution: the balance of free motions,
/// the dense problem of the pairs that may touch, problems with given thresholds, inner displacements without the rounding
/// of systems with springs.
fn by_attempts(
    equations: &Equations<'_>,
    bodies: &mut Session<'_>,
    start: &Displacements,
) -> Result<Outcome, Error> {
    let point = equations.held_at(start.clone(), bodies)?;
    let best = newton::solve(equations, bodies, point)?;
    let mut tried = Tried { equations, bodies, start, best };
    for attempt in [balance, condensed::solve, thresholds::solve, refine] {
        let Outcome { point: Point { at, residual, merit, .. }, ending, .. } = &tried.best;
        let certificate = measure_spread(equations.contact, tried.bodies.operator, &at.x, residual);
        let has_ended = matches!(ending, Ending::Stopped(_) | Ending::Recession(_));
        if has_ended || certificate.holds(equations.tolerance) || !merit.is_finite() {
            break;
        }
        if let Err(ending) = ended(attempt(&mut tried))? {
            tried.best.ending = ending;
        }
    }
    Ok(tried.best)
}

/// Ends with a free motion that proves that no equilibrium exists: one that the balance of the loads finds, or that of the
/// displacements that Newton's method has ended with.
fn balance(tried: &mut Tried<'_, '_>) -> Result<(), Ending> {
    let Tried { equations, bodies, best, .. } = tried;
    let contact = equations.contact;
    let Some(motions) = FreeMotions::of(bodies, contact.dim())? else { return Ok(()) };
    let (balance, d) =
        (motions.balance(contact, bodies.operator, bodies.monitor), &best.point.at.x);
    let found = balance
        .escape()
        .map_or_else(|| balance.ending_away(&d[bodies.operator.inner()..]), Ending::Recession);
    match found {
        Ending::Recession(motion) => Err(Ending::Recession(motions.continued(&motion))),
        _ => Ok(()),
    }
}

/// Takes inner displacements that are in equilibrium with those of the pairs, if that leaves less.
fn refine(tried: &mut Tried<'_, '_>) -> Result<(), Ending> {
    let Tried { equations, bodies, best, .. } = tried;
    let (at, dim) = (best.point.at.clone(), equations.contact.dim());
    let point = equations.held_at(at.settled((bodies, dim), equations.load)?, bodies)?;
    if point.eta < best.point.eta {
        best.point = point;
    }
    Ok(())
}

/// Gives a solution that has no equilibrium its motion of escape.
fn describe(
    contact: &Contact<'_, MatrixFree<'_>>,
    bodies: &mut Session<'_>,
    solution: &mut Solution,
) -> Result<(), Error> {
    // If others are not found in time, the motion of the proof stands for all.
    let motions = ended(FreeMotions::of(bodies, contact.dim()))?.unwrap_or_default();
    let fits = condensed::fits(contact.unknowns(), (bodies.operator.inner(), contact.unknowns()));
    let balance =
        motions.as_ref().map(|motions| motions.balance(contact, bodies.operator, bodies.monitor));
    let solve = fits.then_some(plan::solve as Solve);
    rigid::describe(contact, solution, balance, solve, bodies.monitor)
}

/// The result of a work, or how the call ends where the work was ended.
fn ended<T>(result: Result<T, Ending>) -> Result<Result<T, Ending>, Error> {
    match result {
        Err(Ending::Failed(error)) => Err(error),
        result => Ok(result),
    }
}
