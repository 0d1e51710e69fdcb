//! Whether a solution is the only one.
//!
//! *Unique.* For positive definite `K` the solutions with given thresholds `g` and `g'` differ by at
//! most `|v - v'|_K <= sqrt(L_t) |X⁻¹ (g - g')|`, `L_t` the largest eigenvalue of `X W_tt X` with
//! `W = K⁻¹` and any diagonal `X > 0`; pressures follow with
//! `|X⁻¹ mu (p - p')| <= sqrt(L_n) |v - v'|_K`, `L_n` that of `X⁻¹ mu K_nn mu X⁻¹`. If `L_n L_t < 1`
//! the map `g -> mu p` is a contraction, and Coulomb's problem has one solution. With uniform `mu`
//! and `X = 1` this is `mu < 1 / sqrt(|K_nn| |W_tt|)`.
//!
//! *Several.* Two certified solutions that differ; or one whose orientation, the sign of the
//! determinant of its system, is −1: over all solutions the signs add up to the degree of the
//! natural map, which is +1 for positive definite `K` as it is for `mu = 0`.

use super::frictional_lemke;
use super::newton;
use super::pieces::{self, Motion, Piece};
use super::solution::{Candidate, Ending, SecondSolution, Solution, Status, Uniqueness};
use crate::certificate::certify;
use crate::error::Error;
use crate::linalg::direct::{Direct, largest_eigenvalue};
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, FrictionLaw};
use crate::settings::Settings;

/// What is proved must be true by more than rounding.
const MARGIN: f64 = 1e-6;

/// Pairs whose piece is changed, one at a time, in the search for other solutions.
const NEIGHBOURS: usize = 32;

/// Finds out whether `solution` is the only one, as far as it can.
pub fn examine(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    solution: &mut Solution,
    monitor: &mut Monitor<'_>,
) -> Result<(), Error> {
    if solution.status != Status::Solved || solution.second.is_some() {
        return Ok(());
    }
    let definite = scaled_factor(problem);
    if let Some(factor) = &definite
        && is_contraction(problem, factor)
    {
        solution.uniqueness = Uniqueness::Unique;
        return Ok(());
    }
    if problem.dim() != 2 || problem.law().is_zero() {
        return Ok(());
    }
    // To the last digit, and with its orientation.
    let Some(first) = polished(problem, settings, &solution.d, monitor) else { return Ok(()) };
    solution.orientation = first.orientation;
    by_orientation(problem, solution);
    if let Some(second) = another(problem, settings, &first.d, monitor)? {
        solution.uniqueness = Uniqueness::Several;
        solution.second = Some(Box::new(second));
    }
    Ok(())
}

/// Concludes from an orientation of −1, away from where pieces meet, that there are others.
pub fn by_orientation(problem: &ContactProblem<'_>, solution: &mut Solution) {
    if solution.orientation < 0
        && is_strict(problem, &solution.d)
        && scaled_factor(problem).is_some()
    {
        solution.uniqueness = Uniqueness::Several;
    }
}

/// Whether two displacements, solutions to rounding, are different ones: by their pieces, and by
/// more than the rounding of a system of condition 1e9.
pub fn are_different(problem: &ContactProblem<'_>, one: &[f64], two: &[f64]) -> bool {
    let at = |d: &[f64]| pieces::at(problem, d, &problem.force(d));
    let root = |i: usize| problem.diagonal(i).sqrt();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    // Of what the loads can move too: two displacements of rounding's size are both zero.
    let loads = problem.load().iter().enumerate().map(|(i, f)| (f / root(i)).abs());
    let moves = one.iter().chain(two).enumerate().map(|(i, d)| d.abs() * root(i % one.len()));
    let size = largest(&mut loads.chain(moves));
    let distance =
        largest(&mut one.iter().zip(two).enumerate().map(|(i, (a, b))| (a - b).abs() * root(i)));
    distance > MARGIN * size && at(one) != at(two)
}

/// A solution other than `known`, if one is found: by Newton's method from all pairs at rest, open
/// or sliding, by Lemke's with several starts and from where its path turns, and by Newton's from
/// pieces next to the known ones.
fn another(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    known: &[f64],
    monitor: &mut Monitor<'_>,
) -> Result<Option<SecondSolution>, Error> {
    let accepted = |candidate: Candidate| {
        let certificate = certify(problem, &candidate.d);
        let other = candidate.ending == Ending::Done
            && certificate.holds(settings.tolerance)
            && are_different(problem, known, &candidate.d);
        let orientation = candidate.orientation;
        other.then_some(SecondSolution { d: candidate.d, certificate, orientation })
    };
    let rest = || vec![0.0; problem.unknowns()];
    for pieces in starts(problem) {
        let candidate = newton::from_pieces(problem, settings, pieces, rest(), monitor);
        if let Some(other) = accepted(candidate) {
            return Ok(Some(other));
        }
    }
    for candidate in frictional_lemke::ends(problem, settings, monitor)? {
        if let Some(other) = accepted(candidate) {
            return Ok(Some(other));
        }
    }
    for pieces in neighbours(problem, known) {
        let candidate = newton::from_pieces(problem, settings, pieces, known.to_vec(), monitor);
        if let Some(other) = accepted(candidate) {
            return Ok(Some(other));
        }
    }
    Ok(None)
}

/// All pairs at rest, all open, all sliding to either side.
fn starts(problem: &ContactProblem<'_>) -> Vec<Vec<Piece>> {
    let stuck = pieces::stuck(problem);
    let all = |closed: bool, side: i8| -> Vec<Piece> {
        let piece = |stuck: &Piece| match stuck.motion {
            Motion::Rest => Piece { closed: closed && stuck.closed, motion: Motion::Slide(side) },
            Motion::Slide(_) => Piece { closed: closed && stuck.closed, ..*stuck },
        };
        stuck.iter().map(piece).collect()
    };
    vec![all(false, 0), all(true, 1), all(true, -1), stuck.clone()]
}

/// The pieces of a solution with that of one pair changed, of the first pairs.
fn neighbours(problem: &ContactProblem<'_>, known: &[f64]) -> Vec<Vec<Piece>> {
    let here = pieces::at(problem, known, &problem.force(known));
    let stuck = pieces::stuck(problem);
    let mut neighbours = Vec::new();
    for pair in 0..here.len().min(NEIGHBOURS) {
        let slides = [-1, 1].map(|side| Piece { closed: true, motion: Motion::Slide(side) });
        let open = Piece { closed: false, motion: Motion::Slide(0) };
        let others = [open, stuck[pair], slides[0], slides[1]];
        for other in others
            .into_iter()
            .filter(|&other| other != here[pair] && (stuck[pair].closed || !other.closed))
        {
            let mut pieces = here.clone();
            pieces[pair] = other;
            neighbours.push(pieces);
        }
    }
    neighbours
}

/// The solution of the pieces on which `d` is, if that is `d`.
fn polished(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    d: &[f64],
    monitor: &mut Monitor<'_>,
) -> Option<Candidate> {
    let pieces = pieces::at(problem, d, &problem.force(d));
    let candidate = newton::from_pieces(problem, settings, pieces, d.to_vec(), monitor);
    let same = candidate.ending == Ending::Done && !are_different(problem, d, &candidate.d);
    same.then_some(candidate)
}

/// Whether no pair is where pieces meet: forces and displacements are clear of all bounds.
fn is_strict(problem: &ContactProblem<'_>, d: &[f64]) -> bool {
    let force = problem.force(d);
    let unit = force.iter().chain(problem.load()).fold(0.0, |most: f64, f| most.max(f.abs()));
    let slack = |pair: usize| {
        let (n, t) = (2 * pair, 2 * pair + 1);
        let pressure = problem.diagonal(n) * (d[n] - problem.gap(pair)) - force[n];
        let threshold = problem.threshold(pair, pressure.max(0.0));
        let trial = problem.diagonal(t) * (d[t] - problem.reference_slip(pair, 0)) - force[t];
        match pressure > 0.0 || matches!(problem.law(), FrictionLaw::Tresca(_)) {
            true if threshold > 0.0 => pressure.abs().min((trial.abs() - threshold).abs()),
            _ => pressure.abs(),
        }
    };
    (0..problem.pairs()).all(|pair| slack(pair) > MARGIN * unit)
}

/// The factor of `K`, scaled to a unit diagonal, if it is positive definite.
fn scaled_factor(problem: &ContactProblem<'_>) -> Option<Direct> {
    let root: Vec<f64> = (0..problem.unknowns()).map(|i| problem.diagonal(i).sqrt()).collect();
    Direct::new(problem.unknowns(), true, |j, column| {
        for (i, (entry, k)) in column.iter_mut().zip(problem.column(j)).enumerate() {
            *entry = k / (root[i] * root[j]);
        }
    })
}

/// Whether `g -> mu p` is a contraction; without friction, or with given thresholds, it is constant.
fn is_contraction(problem: &ContactProblem<'_>, factor: &Direct) -> bool {
    let FrictionLaw::Coulomb(mu) = problem.law() else { return true };
    let (n, dim) = (problem.unknowns(), problem.dim());
    let rubbing: Vec<usize> =
        (0..problem.pairs()).filter(|&i| mu[i] > 0.0 && problem.gap(i) < f64::INFINITY).collect();
    if rubbing.is_empty() {
        return true;
    }
    if dim != 2 {
        return false;
    }
    let mut flexibility = vec![0.0; n * rubbing.len()];
    for (column, &pair) in flexibility.chunks_exact_mut(n).zip(&rubbing) {
        column[2 * pair + 1] = 1.0;
    }
    factor.solve(&mut flexibility);
    let m = rubbing.len();
    let root = |i: usize| problem.diagonal(i).sqrt();
    let compliance = |a: usize, b: usize| {
        let (i, j) = (2 * rubbing[a] + 1, 2 * rubbing[b] + 1);
        flexibility[i + n * b] / (root(i) * root(j))
    };
    let stiffness = |a: usize, b: usize| {
        let (i, j) = (2 * rubbing[a], 2 * rubbing[b]);
        mu[rubbing[a]] * problem.column(j)[i] * mu[rubbing[b]]
    };
    let scales: [&dyn Fn(usize) -> f64; 3] =
        [&|a| stiffness(a, a).sqrt(), &|a| compliance(a, a).sqrt().recip(), &|a| {
            (stiffness(a, a) / compliance(a, a)).powf(0.25)
        }];
    scales.iter().any(|x| {
        let normal = largest_eigenvalue(m, |a, b| stiffness(a, b) / (x(a) * x(b)));
        let tangential = largest_eigenvalue(m, |a, b| compliance(a, b) * x(a) * x(b));
        matches!((normal, tangential), (Some(l), Some(k)) if l * k < 1.0 - MARGIN)
    })
}
