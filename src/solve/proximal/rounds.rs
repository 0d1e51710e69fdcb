//! The proximal iteration on contact forces that displacements do not determine.
//!
//! Each pair gets a soft spring in series, of stiffness `D / e`, which the force of the round before has
//! stretched. Round by round the springs are stretched anew, until their change and with it the error is nothing
//! (R. T. Rockafellar: *Monotone operators and the proximal point algorithm*. SIAM Journal on Control and
//! Optimization 14 (1976) 877–898). From `F_0 = 0` it takes, where states do not change on the way, the smallest of
//! the forces that are left open, in the norm of `D⁻¹`.
//!
//! A round divides the error in a pattern of forces by its flexibility over `e`. Where that is slow, `e` is
//! lowered, and after the first solution rounds go on until forces settle. Where a round is not solved, and comes hardly nearer, `e`
//! is raised: a larger one is an easier problem nearer to the forces at hand. A round with the largest that is left without a
//! solution, and no nearer to one, ends the rounds, and its sentence is that of the problem.
//!
//! The default method has all its means in a round without friction, and between bodies that have a stiffness: Newton's method
//! may find a solution of each round from which the next one leads away, and the path one from which it does not. On a singular
//! `W` Newton's method comes first, in softer springs. Rounds that do not settle begin anew by the path in soft springs.
//!
//! Where forces grow with the least compliant springs too there is no solution near: they balance each other and wedge the bodies,
//! or the gaps contradict each other. The second is proved by normal forces, and those of ties, that balance each other and
//! do work on the gaps.

use super::growth::{ENOUGH, Growth, proof_in, sentence};
use super::step::{Means, measured, step};
use crate::error::Error;
use crate::law::{Contact, passes_gaps, without_friction};
use crate::linalg::ball::UNIT;
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::{norm, norm_inf, sizes};
use crate::problem::{ContactProblem, Redundant, Relation, Stiffness};
use crate::settings::{Method, SMALLEST_TOLERANCE, Settings};
use crate::solve::newton::AIM;
use crate::solve::result::{Solution, Status};

/// Most rounds: patterns of forces with a flexibility of `e` itself halve their error in each.
const ROUNDS: usize = 100;

/// `e` of the first springs, beside flexibilities of size one. A round divides the error by the compliance of the least
/// compliant pattern of forces over `e`; the stiffness with springs loses as many digits as `e` has.
pub const COMPLIANCE: f64 = 1e-4;

/// Least and largest `e`. The least leaves six digits of the stiffness with springs; with the largest they are as compliant as the bodies.
pub const RANGE: [f64; 2] = [1e-10, 1.0];

/// The next `e`, softer up to `most` or less compliant.
pub fn changed(compliance: f64, softer: bool, most: f64) -> f64 {
    let by = if softer { 1.0 / SLOW } else { SLOW };
    (by * compliance).clamp(RANGE[0], most)
}

/// Part of the error before a round that is enough for the round.
const ROUGH: f64 = 1e-3;

/// Part of the error that is left where rounds are slow, so that springs are tried that are less compliant by as much.
const SLOW: f64 = 0.1;

/// So many rounds that do not halve the least error get nowhere: the pattern that is left has hardly any flexibility, or
/// rounding is reached.
const IDLE_ROUNDS: usize = 12;

/// Bodies with springs in series with their pairs.
pub trait InSeries {
    /// `e`, beside flexibilities of size one.
    fn compliance(&self) -> f64;

    /// The displacements of the pairs where the springs are stretched to `force`.
    fn displacements(&self, force: &[f64]) -> Vec<f64>;

    /// The stiffness of bodies and springs, column-major.
    fn stiffness(&self) -> &[f64];

    /// A basis of the motions that nothing resists, where it is known better than the rounding of that stiffness tells.
    fn free_motions(&self) -> Option<&[Vec<f64>]> {
        None
    }

    /// The load on them where the springs are stretched to `force`.
    fn load(&mut self, force: &[f64]) -> Vec<f64>;

    /// Moves the bodies by the step of a round. Where the forces determine the displacements there is nothing to do.
    fn advance(&mut self, _: &[f64]) {}

    /// More compliant springs if they are to be softer, otherwise less compliant ones, if there are any.
    fn change(&mut self, softer: bool);

    /// True if there are no softer ones, or none that a round is left to.
    fn are_softest(&self) -> bool;

    /// True if a round has all methods of the default with friction too, not Newton's alone.
    fn are_solved_by_all_means(&self) -> bool {
        self.are_softest()
    }
}

/// The result of the rounds.
pub struct RoundsFound {
    /// The best result.
    pub solution: Solution,
    /// The forces that each of the last rounds has added, if they go on and on.
    pub pattern: Option<Vec<f64>>,
}

/// Solves a problem by `rounds` from a start. Where forces do not settle, looks for normal forces which prove that the gaps
/// contradict each other, says in the message what was found, and returns the proof. `number` tells which pair of the
/// host a pair is.
pub fn solve<'p, R: Clone + Redundant>(
    problem: &ContactProblem<'p, R>,
    number: &dyn Fn(usize) -> usize,
    (settings, start): (&Settings, Option<&[f64]>),
    mut rounds: impl FnMut(
        &ContactProblem<'p, R>,
        &Settings,
        Option<&[f64]>,
    ) -> Result<RoundsFound, Error>,
) -> Result<(RoundsFound, Option<Vec<f64>>), Error> {
    let mut found = rounds(problem, settings, start)?;
    if found.solution.status != Status::Stalled {
        return Ok((found, None));
    }
    let proof = |pattern: Vec<f64>| proof_in(problem, &pattern);
    let mut proved = found.pattern.clone().and_then(proof);
    if proved.is_none() {
        // With friction they may hide behind forces that wedge.
        let settings = Settings { method: Method::Auto, ..settings.clone() };
        proved = rounds(&without_friction(problem), &settings, None)?.pattern.and_then(proof);
    }
    if let Some(pattern) = proved.as_deref().or(found.pattern.as_deref()) {
        found.solution.message = sentence(problem, pattern, proved.is_some(), number).into();
    }
    Ok((found, proved))
}

/// Rounds `from` the first springs, or if these do not settle by the path from those that are as compliant as the bodies. Where a round
/// has several solutions a method takes any of them, and rounds may follow one that wedges the bodies. In soft springs hardly any
/// round has: between two planes that wedge a node no solution of 8,000 was missed then, and in the first springs alone 190 of 1,648. On
/// singular `W` with friction up to 50 it is half of them.
pub fn first_or_soft<R: Relation>(
    problem: &ContactProblem<'_, R>,
    settings: &Settings,
    mut from: impl FnMut(f64, &Settings) -> Result<RoundsFound, Error>,
) -> Result<RoundsFound, Error> {
    let found = from(COMPLIANCE, settings)?;
    let has_choice = settings.method == Method::Auto && !Contact::new(problem).is_frictionless();
    if found.solution.status != Status::Stalled || !has_choice {
        return Ok(found);
    }
    let again = from(RANGE[1], &Settings { method: Method::Path, ..settings.clone() })?;
    let systems = found.solution.factorisations + again.solution.factorisations;
    let mut better = if again.solution.status == Status::Stalled { found } else { again };
    better.solution.factorisations = systems;
    Ok(better)
}

/// Rounds from contact forces `force`, each solved by `means`.
pub fn rounds<R: Redundant>(
    problem: &ContactProblem<'_, R>,
    springs: &mut dyn InSeries,
    force: Vec<f64>,
    means: Means<'_>,
) -> Result<RoundsFound, Error> {
    let mut rounds = Rounds {
        contact: Contact::new(problem),
        means,
        last: springs.compliance(),
        springs,
        force,
        changes: [f64::INFINITY; 2],
        growth: Growth::default(),
        best: None,
        least: f64::INFINITY,
        deep: false,
        lowered: false,
        idle: 0,
        solved: 0,
    };
    for _ in 0..ROUNDS {
        if rounds.ends_with_next()? {
            break;
        }
    }
    let solution = rounds.best.ok_or(Error::OutOfMemory("a round with springs"))?;
    Ok(RoundsFound { solution, pattern: rounds.growth.pattern().map(<[f64]>::to_vec) })
}

/// The iteration.
struct Rounds<'p, 's, R: Redundant> {
    contact: Contact<'p, R>,
    means: Means<'s>,
    springs: &'s mut dyn InSeries,
    /// Contact forces of the round before.
    force: Vec<f64>,
    /// The largest changes of a force by the last two rounds.
    changes: [f64; 2],
    growth: Growth,
    best: Option<Solution>,
    /// `eta` of the round before, and the least of those that halved the one before.
    last: f64,
    least: f64,
    /// True if the best result is a solution whose penetration is not small beside the gaps.
    deep: bool,
    /// True if the springs of this round are less compliant than those before.
    lowered: bool,
    /// Rounds since `least` was halved.
    idle: usize,
    /// Rounds since the first solution.
    solved: usize,
}

impl<R: Redundant> Rounds<'_, '_, R> {
    /// Makes a round. Returns `true` if it is the last one.
    fn ends_with_next(&mut self) -> Result<bool, Error> {
        let rough = self.tolerance();
        let round = self.round(rough)?;
        Ok(self.ends_with(round, rough))
    }

    /// Goes on from a round that was solved to a `rough` tolerance. Returns `true` if it is the last one.
    #[inline(never)] // rounds need the stack
    fn ends_with(&mut self, round: Solution, rough: f64) -> bool {
        let failed = round.status == Status::Stalled;
        let force = match round.status {
            Status::Solved | Status::Stalled => {
                self.springs.advance(&round.d);
                round.certificate.force.clone()
            }
            _ => self.force.clone(),
        };
        let result = (self.springs.displacements(&force), &force[..]);
        let found = measured(&self.contact, (round, rough), result, self.means.settings);
        let eta = found.certificate.eta;
        let softest = self.springs.are_softest();
        if failed && eta >= if softest { self.last } else { SLOW * self.last } {
            match softest {
                true => _ = self.keep(found, false, false),
                false => self.springs.change(true),
            }
            return softest;
        }
        let change: Vec<f64> = force.iter().zip(&self.force).map(|(a, b)| a - b).collect();
        self.changes = [self.changes[1], norm_inf(&change)];
        self.growth.add(change.iter().map(|change| self.springs.compliance() * change).collect());
        self.force = force;
        let deep = self.is_deep(&found);
        let halves = 2.0 * eta < self.least;
        (self.least, self.idle) = if halves { (eta, 0) } else { (self.least, self.idle + 1) };
        let is_slow = match found.status {
            Status::Solved if !deep => {
                self.changes[1] > SLOW * self.changes[0] && !self.growth.is_steady()
            }
            _ => eta > SLOW * self.last,
        };
        // Of a solution less compliant springs make the change less, until it is rounding of the gaps.
        let is_rounding =
            self.lowered && found.status == Status::Solved && self.changes[1] >= self.changes[0];
        let allowed = self.means.settings.tolerance * norm_inf(&self.force);
        let settled = !deep && (is_rounding || settles(self.changes, allowed));
        let before = self.springs.compliance();
        if !failed && is_slow && !settled {
            self.springs.change(false);
        }
        self.lowered = self.springs.compliance() < before;
        self.last = eta;
        let ends = self.keep(found, halves, settled);
        ends || self.growth.pattern().is_some() || self.idle >= IDLE_ROUNDS
    }

    /// The tolerance of the next round. The springs leave the first rounds fewer digits than the problem asks for, and later
    /// ones mend it. Gaps may ask for more than `eta` does.
    fn tolerance(&self) -> f64 {
        let rough = ROUGH * self.last.min(self.springs.compliance());
        let enough = if self.deep { 0.0 } else { AIM * self.means.settings.tolerance };
        rough.max(enough).max(SMALLEST_TOLERANCE)
    }

    /// True if a result is a solution by `eta` whose penetration is not small beside the gaps: springs soft beside the loads.
    /// Rounds go on then as if it were none, and it is kept until there is a better one.
    fn is_deep(&self, found: &Solution) -> bool {
        let at = (&found.d[..], found.certificate.penetration);
        found.status == Status::Solved
            && passes_gaps(self.contact.problem(), at, self.means.settings.tolerance)
    }

    /// Solves the problem with springs. Hard ones are left to softer springs at first, as far as there are any.
    fn round(&mut self, tolerance: f64) -> Result<Solution, Error> {
        let by_all_means = self.springs.are_solved_by_all_means() || self.contact.is_frictionless();
        let method = match self.means.settings.method {
            Method::Auto if !by_all_means => Method::Newton,
            method => method,
        };
        let settings = Settings { tolerance, method, ..self.means.settings.clone() };
        let d = self.springs.displacements(&self.force);
        let load = self.springs.load(&self.force);
        let stiffness = Matrix::new(d.len(), self.springs.stiffness(), d.len().max(1));
        let mut relation = Stiffness::new(stiffness, &load, self.contact.dim());
        relation.free_motions = self.springs.free_motions();
        // On motions that nothing resists the load is that of the problem, and a proof one of it.
        let own = self.contact.problem().relation();
        let terms = [&own.magnitude(&sizes(&d))[..], own.load(), &self.force].map(norm);
        relation.rounding_of_load = UNIT * terms.iter().sum::<f64>();
        let means = Means { settings: &settings, ..self.means };
        step(self.contact.problem(), relation, &d, means)
    }

    /// Keeps a result if it `halves` the least error of those that are no solutions, and of solutions the last one until the
    /// forces are `settled`: what grows for little gain would hide other forces. Returns `true` if there will be no better one.
    fn keep(&mut self, found: Solution, halves: bool, settled: bool) -> bool {
        let stops = !matches!(found.status, Status::Solved | Status::Stalled);
        let (deep, was_deep) = (self.is_deep(&found), self.deep);
        let is_solved = |result: &Solution| result.status == Status::Solved;
        let was_solved = self.best.as_ref().is_some_and(is_solved);
        let is_better = match &self.best {
            Some(best) if is_solved(&found) == was_solved => {
                let is_less = found.certificate.eta < best.certificate.eta;
                let of_solutions = is_less || !deep && (was_deep || !settled);
                stops || if was_solved { of_solutions } else { halves }
            }
            best => best.is_none() || !was_solved,
        };
        if is_better {
            (self.best, self.deep) = (Some(found), deep);
        }
        self.solved += usize::from(was_solved && !was_deep);
        stops || was_solved && (settled || self.solved >= ENOUGH)
    }
}

/// True if forces whose last two changes are `changes` will change by no more than `allowed`: each change is the
/// same part of the one before.
fn settles([before, last]: [f64; 2], allowed: f64) -> bool {
    last <= allowed || last < before && before.is_finite() && last * (last / before) <= allowed
}
