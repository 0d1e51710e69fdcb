//! The flexibility form. With a sparse `W` it is solved island by island: each is a dense problem of its own, and what
//! was found is certified as a whole on the host's sparse data.
//!
//! The squares of the residuals add up, and so do those of loads and forces, the larger of which is the scale of an
//! island. So islands with `eta <= t` make a whole with `eta <= t √2`. Islands that Newton's method has solved have no
//! certificate of their own: that of the whole is enough.

use std::ops::Range;

use super::flexibility::{self, on_itself, takes_newton};
use super::growth::named;
use super::lone_pair::LonePair;
use super::step::Means;
use crate::certificate::{Certificate, measure};
use crate::error::{Argument, Error};
use crate::law::Contact;
use crate::linalg::matrix::Matrix;
use crate::monitor::{Stop, Watch};
use crate::problem::{ContactProblem, Flexibility, FlexibilityForm, FlexibilityProblem, SparseW};
use crate::settings::{Method, SMALLEST_TOLERANCE, Settings};
use crate::solve::part::PairData;
use crate::solve::result::{Ending, Solution, Status};

/// Solves the problem; `start` are contact forces. Islands behind one at which the call is stopped, as large ones or
/// larger, keep theirs.
pub fn solve(
    problem: &FlexibilityProblem<'_>,
    means: Means<'_>,
    start: Option<&[f64]>,
) -> Result<Solution, Error> {
    let FlexibilityForm::Sparse(matrix) = &problem.relation().form else {
        return flexibility::solve(problem, means, start, &|pair| pair);
    };
    in_turn((problem, matrix), means, start)
}

/// Solves island by island. A function of its own, and so are its parts: a dense `W` needs the stack.
#[inline(never)]
fn in_turn(
    (problem, matrix): (&FlexibilityProblem<'_>, &SparseW),
    means: Means<'_>,
    start: Option<&[f64]>,
) -> Result<Solution, Error> {
    let contact = &Contact::new(problem);
    let Means { settings, monitor, .. } = means;
    let (islands, dim) = (&matrix.islands, problem.dim());
    let several = islands.len() > 1;
    let mut own = settings.clone();
    if several {
        let share = settings.tolerance / std::f64::consts::SQRT_2;
        own.tolerance = share.max(SMALLEST_TOLERANCE);
    }
    let means = Means { settings: &own, ..means };
    let force = start.map_or_else(|| vec![0.0; problem.unknowns()], <[f64]>::to_vec);
    let mut found = Found { force, islands: islands.len(), ..Found::default() };
    let with_newton = takes_newton(settings);
    let mut is_left = |pairs: &&[usize]| match pairs {
        [pair] if with_newton => !found.add_alone((contact, matrix), *pair, own.tolerance, monitor),
        _ => true,
    };
    let mut in_turn: Vec<&[usize]> = islands.each().filter(&mut is_left).collect();
    // The smallest first: what ends the call, most likely the largest, leaves the fewest.
    in_turn.sort_by_key(|pairs| pairs.len());
    // Data of all in that order: those of an island are a part.
    let order: Vec<usize> = in_turn.iter().copied().flatten().copied().collect();
    let (free, units) = (problem.relation().free, problem.relation().units());
    let (free, units) = (gathered(free, &order, dim), gathered(units, &order, dim));
    let ordered = Flexibility::new(FlexibilityForm::Dense(Matrix::new(0, &[], 1)), &free, units);
    let data = PairData::of(problem, &order);
    let mut first = 0;
    for pairs in in_turn {
        let (part, entries) = (first..first + pairs.len(), matrix.part(pairs));
        first = part.end;
        let island = island((problem, &ordered), (&data, part), &entries)?;
        let begin = gathered(&found.force, pairs, dim);
        if let Some((force, systems)) = by_newton(&island, means, &begin) {
            scatter(&force, pairs, dim, &mut found.force);
            found.add_quick(systems);
            continue;
        }
        let begin = start.map(|_| &begin[..]);
        let solved = flexibility::solve(&island, means, begin, &|pair| pairs[pair]);
        if found.add(pairs, dim, solved)?.is_some() {
            break;
        }
    }
    Ok(found.solution(contact, settings))
}

/// The forces that Newton's method on an island's own `W` finds, with the number of its systems; `None` if that fails.
#[inline(never)]
fn by_newton(
    island: &FlexibilityProblem<'_>,
    means: Means<'_>,
    begin: &[f64],
) -> Option<(Vec<f64>, u64)> {
    let (contact, tolerance) = (&Contact::new(island), means.settings.tolerance);
    let mut equations = on_itself(contact, means)?;
    let found = equations.solve(equations.coordinates(begin), tolerance);
    let is_solved = found.ending == Ending::Done && found.point.eta <= tolerance;
    is_solved.then_some((found.point.force, found.systems))
}

/// The largest island of a sparse `W`, in words.
pub fn largest_island(form: &FlexibilityForm<'_>) -> Option<String> {
    let FlexibilityForm::Sparse(matrix) = form else { return None };
    let pairs = matrix.islands.largest();
    Some(format!("the largest island has {} pairs: {}", pairs.len(), named(pairs)))
}

/// The pairs `part` of the `ordered` ones as a problem of their own, with their `W`.
fn island<'s>(
    (whole, ordered): (&FlexibilityProblem<'s>, &'s Flexibility<'s>),
    (own, part): (&'s PairData, Range<usize>),
    matrix: &'s [f64],
) -> Result<FlexibilityProblem<'s>, Error> {
    let (dim, law) = (whole.dim(), whole.law());
    let of = |each: usize| each * part.start..each * part.end;
    let n = of(dim).len();
    let relation = ordered.on_part(Matrix::new(n, matrix, n.max(1)), of(dim));
    let law = law.with_values(&own.parameters[of(law.parameters())]);
    let (gap, slip) = (&own.gap[part.clone()], &own.slip[of(dim - 1)]);
    ContactProblem::with_relation(relation, dim, gap, law, Some(slip))
}

/// The entries of `values`, `each` for every pair, that belong to `pairs`.
fn gathered(values: &[f64], pairs: &[usize], each: usize) -> Vec<f64> {
    pairs.iter().flat_map(|pair| &values[each * pair..each * (pair + 1)]).copied().collect()
}

/// Puts the values of `pairs`, `each` for every pair, where they belong in `whole`.
fn scatter(values: &[f64], pairs: &[usize], each: usize, whole: &mut [f64]) {
    for (values, pair) in values.chunks_exact(each).zip(pairs) {
        whole[each * pair..each * (pair + 1)].copy_from_slice(values);
    }
}

/// The error in the words of the whole matrix, for an error about the matrix of an island.
fn in_island(error: Error, pairs: &[usize]) -> Error {
    match error {
        Error::Invalid { argument: Argument::Matrix, message } => {
            let message = format!("{} (island of pairs {})", message.marked(), named(pairs));
            Error::invalid(Argument::Matrix, message)
        }
        other => other,
    }
}

/// The results of the islands so far.
#[derive(Default)]
struct Found {
    force: Vec<f64>,
    /// The pairs and the result of the worst one: of equals the largest. `None`: Newton's method has solved it.
    worst: Option<(Vec<usize>, Solution)>,
    islands: usize,
    solved: usize,
    /// Islands that have no certificate of their own.
    quick: usize,
    factorisations: u64,
    outer_iterations: u64,
    refactorisations: u64,
}

impl Found {
    /// Adds the result of an island; what ended the call there, if anything did.
    #[inline(never)]
    fn add(
        &mut self,
        pairs: &[usize],
        dim: usize,
        solved: Result<Solution, Error>,
    ) -> Result<Option<Stop>, Error> {
        let in_words = |error| if self.islands > 1 { in_island(error, pairs) } else { error };
        let solution = solved.map_err(in_words)?;
        let stop = solution.status.stop();
        scatter(&solution.certificate.force, pairs, dim, &mut self.force);
        self.solved += usize::from(solution.status == Status::Solved);
        self.factorisations += solution.factorisations;
        self.outer_iterations += solution.outer_iterations;
        self.refactorisations += solution.refactorisations;
        let rank = (rank(solution.status), pairs.len());
        let is_worse = |(pairs, worst): &(Vec<usize>, Solution)| {
            rank > (self::rank(worst.status), pairs.len())
        };
        if self.worst.as_ref().is_none_or(is_worse) {
            self.worst = Some((pairs.to_vec(), solution));
        }
        Ok(stop)
    }

    /// Solves a pair that is an island by Newton's method; false if that fails.
    fn add_alone(
        &mut self,
        (contact, matrix): (&Contact<'_, Flexibility<'_>>, &SparseW),
        pair: usize,
        tolerance: f64,
        monitor: &dyn Watch,
    ) -> bool {
        let (relation, dim) = (contact.problem().relation(), contact.dim());
        let own = dim * pair..dim * (pair + 1);
        let block = &matrix.block(own.start)[..dim * dim];
        let arrays = (&relation.free[own.clone()], &relation.units()[own.clone()]);
        let force = &mut self.force[own];
        let found = LonePair::new(&contact.pairs()[pair], block, arrays)
            .and_then(|alone| alone.solve(force, tolerance, monitor));
        let Some((solved, systems)) = found else { return false };
        force.copy_from_slice(&solved[..dim]);
        self.add_quick(systems);
        true
    }

    /// Counts an island that Newton's method has solved.
    fn add_quick(&mut self, systems: u64) {
        (self.solved, self.quick) = (self.solved + 1, self.quick + 1);
        self.factorisations += systems;
        // Islands come from the smallest to the largest.
        self.worst.take_if(|(_, worst)| worst.status == Status::Solved);
    }

    /// The result of the whole.
    #[inline(never)]
    fn solution(self, contact: &Contact<'_, Flexibility<'_>>, settings: &Settings) -> Solution {
        let problem = contact.problem();
        let d = problem.relation().relative(&self.force);
        let certificate = measure(contact, (&d, &[]), &self.force);
        let ending = self.ending(settings, &certificate);
        let method = if self.quick > 0 { Method::Newton } else { settings.method };
        let mut whole = Solution {
            factorisations: self.factorisations,
            outer_iterations: self.outer_iterations,
            refactorisations: self.refactorisations,
            ..Solution::of(method, ending, d, certificate)
        };
        if let Some((pairs, worst)) = self.worst {
            (whole.method, whole.omega, whole.damping) = (worst.method, worst.omega, worst.damping);
            whole.recession = worst.recession.map(|proof| {
                let mut forces = vec![0.0; problem.unknowns()];
                scatter(&proof, &pairs, problem.dim(), &mut forces);
                forces
            });
        }
        whole
    }

    /// The status, that of the worst island, and its sentence.
    fn ending(&self, settings: &Settings, certificate: &Certificate) -> (Status, String) {
        let accuracy = format!("eta is {:.1e}", certificate.eta);
        let wanted = format!("{accuracy}, wanted {:.1e}", settings.tolerance);
        let holds = certificate.holds(settings.tolerance);
        let islands = self.islands;
        let failed = self.worst.as_ref().filter(|(_, worst)| worst.status != Status::Solved);
        let stop = failed.and_then(|(_, worst)| worst.status.stop());
        match (failed, stop) {
            (Some((pairs, worst)), None) => {
                let said = worst.message.marked();
                let place = format!("{said} (island of pairs {})", named(pairs));
                (worst.status, if islands > 1 { place } else { said.to_owned() })
            }
            _ if holds => (Status::Solved, format!("solved: {accuracy}")),
            (_, Some(stop)) => {
                let done = format!("{wanted}; {} of {islands} islands are solved", self.solved);
                stop.status(settings, if islands > 1 { &done } else { &wanted })
            }
            (None, None) => (Status::Stalled, format!("accuracy was lost to rounding; {wanted}")),
        }
    }
}

/// How bad a status is. A proof about an island is one about the whole.
fn rank(status: Status) -> u8 {
    match status {
        Status::Solved => 0,
        Status::Stalled => 1,
        Status::IterationLimit | Status::TimeLimit | Status::Cancelled => 2,
        Status::NoEquilibrium => 3,
    }
}
