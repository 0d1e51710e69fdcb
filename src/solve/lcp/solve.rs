//! The linear complementarity problem, by block pivoting and by Lemke's method.

use super::block_pivoting;
use super::lemke::{self, LemkeRules, Scaled};
use crate::error::{Argument, Error, Message, entry};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{first_not_finite, largest_of, normalise};
use crate::monitor::Monitor;
use crate::problem::Lcp;
use crate::settings::{Method, Settings};
use crate::solve::result::{Ending, Fallback, Status, check_limit, memory};

/// Result of an LCP.
#[derive(Clone, Debug)]
pub struct LcpSolution {
    /// The status; [`Status::NoEquilibrium`] means that no `w, z >= 0` satisfy `w = q + M z`.
    pub status: Status,
    /// One sentence on what happened.
    pub message: Message,
    /// `w >= 0`.
    pub w: Vec<f64>,
    /// `z >= 0`.
    pub z: Vec<f64>,
    /// With [`Status::NoEquilibrium`] the vector `y` that proves it ([`Lcp::is_infeasible_by`]), its
    /// largest entry 1.
    pub infeasible_by: Option<Vec<f64>>,
    /// [`Lcp::eta`].
    pub eta: f64,
    /// The method that ended it.
    pub method: Method,
    /// The method tried first and why it was abandoned, if another one ended it.
    pub fallback: Option<(Method, Fallback)>,
    /// Pivots, or linear systems, of all methods that were tried.
    pub iterations: u64,
    /// Dense factorisations of block pivoting.
    pub factorisations: u64,
    /// How often the tableau was refactorised because accuracy was lost.
    pub refactorisations: u64,
}

/// Solves an LCP: by default by block pivoting, then Lemke's method.
///
/// # Errors
/// Settings out of range, or a method for contact problems; memory that cannot be had.
pub fn solve_lcp(
    lcp: &Lcp<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<LcpSolution, Error> {
    settings.validate()?;
    check_limit(memory(lcp.size()), settings)?;
    let magnitudes = lcp.magnitudes();
    let problem = (lcp, magnitudes.as_slice());
    let pivoted = match settings.method {
        Method::Auto | Method::BlockPivoting => Some(by_pivoting(problem, settings, monitor)),
        Method::Lemke => None,
        _ => {
            let message =
                "settings: an LCP is solved by the methods auto, block pivoting and Lemke";
            return Err(Error::invalid(Argument::Settings, message));
        }
    };
    let done = |(solution, ending): &(LcpSolution, Ending)| {
        solution.status == Status::Solved
            || settings.method == Method::BlockPivoting
            || matches!(ending, Ending::Stopped(_))
    };
    let pivoted = match pivoted {
        Some(pivoted) if done(&pivoted) => return Ok(pivoted.0),
        other => other,
    };
    let mut solution = by_lemke(problem, settings, monitor)?;
    if let Some((before, ending)) = pivoted {
        let decided = matches!(solution.status, Status::Solved | Status::NoEquilibrium);
        if !decided && before.eta < solution.eta {
            (solution.w, solution.z, solution.eta) = (before.w, before.z, before.eta);
        }
        let why =
            if ending == Ending::Singular { Fallback::Singular } else { Fallback::Inaccurate };
        solution.fallback = Some((Method::BlockPivoting, why));
        solution.factorisations = before.factorisations;
    }
    Ok(solution)
}

/// Block pivoting, and how it ended.
fn by_pivoting(
    problem: (&Lcp<'_>, &[f64]),
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> (LcpSolution, Ending) {
    let (lcp, magnitudes) = problem;
    let n = lcp.size();
    let (mut z, mut factorisations) = (vec![0.0; n], 0);
    let ending = if (0..n).any(|i| !(lcp.column(i)[i] > 0.0)) {
        Ending::Singular
    } else if n == 0 {
        Ending::Done
    } else {
        let chosen = settings.method == Method::BlockPivoting;
        let most = if chosen { u64::MAX } else { block_pivoting::enough(n) };
        let pivoted = block_pivoting::lcp(lcp, magnitudes, settings.tolerance, most, monitor);
        // Written so that NaN stays NaN.
        z = pivoted.d().iter().map(|&x| if x < 0.0 { 0.0 } else { x }).collect();
        factorisations = pivoted.effort.factorisations;
        pivoted.ending
    };
    let mut solution = certified(problem, settings, Method::BlockPivoting, z, &ending);
    (solution.iterations, solution.factorisations) = (monitor.iterations(), factorisations);
    (solution, ending)
}

/// Lemke's method; a path whose end has lost accuracy is followed once more.
fn by_lemke(
    problem: (&Lcp<'_>, &[f64]),
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<LcpSolution, Error> {
    let (lcp, magnitudes) = problem;
    // Powers of two: the pivots are those of the unscaled problem, rounding included.
    let scale: Vec<f64> = magnitudes.iter().map(|m| (-(m.log2() / 2.0).round()).exp2()).collect();
    let covering: Vec<f64> = (0..lcp.size()).map(|i| lcp.covering(i)).collect();
    let matrix = lcp.matrix;
    let fill = |j: usize, column: &mut [f64]| column.copy_from_slice(matrix.column(j));
    let scaled = Scaled::new(fill, lcp.q(), &covering, scale);
    let label = lemke::missing_label(&matrix, lcp.q());
    let rules = |thorough| LemkeRules { label, ..LemkeRules::usual(thorough) };
    let mut run = lemke::follow(&scaled, rules(false), monitor)?;
    let lost_accuracy = match run.ending {
        Ending::Done => lcp.measure(&run.z, magnitudes).0 > settings.tolerance,
        Ending::Recession(_) | Ending::Stopped(_) => false,
        _ => true,
    };
    if lost_accuracy {
        run = lemke::follow(&scaled, rules(true), monitor)?;
    }
    let mut solution = certified(problem, settings, Method::Lemke, run.z, &run.ending);
    (solution.iterations, solution.refactorisations) = (monitor.iterations(), run.refactorisations);
    Ok(solution)
}

/// The result of `z`, with which a method has ended.
fn certified(
    (lcp, magnitudes): (&Lcp<'_>, &[f64]),
    settings: &Settings,
    method: Method,
    mut z: Vec<f64>,
    ending: &Ending,
) -> LcpSolution {
    let (mut eta, product) = lcp.measure(&z, magnitudes);
    let w = lcp.q().iter().zip(&product).zip(&z);
    let w = w.map(|((q, mz), z)| if *z > 0.0 { 0.0 } else { slack(*q, *mz) });
    let mut w: Vec<f64> = w.collect();
    let overflow = overflow(&w, &z);
    if overflow.is_some() {
        // Only numbers are returned: those of z = 0.
        z.fill(0.0);
        w = lcp.q().iter().map(|&q| slack(q, 0.0)).collect();
        eta = lcp.measure(&z, magnitudes).0;
    }
    let mut infeasible_by = None;
    let ending = match ending {
        Ending::Recession(ray) => &Ending::Recession(without_digits(ray, magnitudes)),
        other => other,
    };
    let wanted = || format!("eta is {eta:.1e}, wanted {:.1e}", settings.tolerance);
    let (status, message) = match ending {
        _ if overflow.is_none() && eta <= settings.tolerance => {
            (Status::Solved, format!("solved: eta is {eta:.1e}"))
        }
        Ending::Recession(ray) if lcp.is_infeasible_by(ray) => {
            let mut ray = ray.clone();
            normalise(&mut ray);
            infeasible_by = Some(ray);
            (Status::NoEquilibrium, "no w, z >= 0 satisfy w = q + M z: proved".into())
        }
        Ending::Stopped(stop) => stop.status(settings, &wanted()),
        other => match overflow {
            Some(place) => {
                (Status::Stalled, format!("{place} is beyond the largest number, {:.1e}", f64::MAX))
            }
            None => (Status::Stalled, format!("{}; {}", reason(other), wanted())),
        },
    };
    LcpSolution {
        status,
        message: message.into(),
        w,
        z,
        infeasible_by,
        eta,
        method,
        fallback: None,
        iterations: 0,
        factorisations: 0,
        refactorisations: 0,
    }
}

/// `w` of a variable with `z = 0`: not negative, and NaN where it is not known.
fn slack(q: f64, mz: f64) -> f64 {
    let w = q + mz;
    if w < 0.0 { 0.0 } else { w }
}

/// A ray without the entries that are digits which rounding has left, relative to their magnitudes.
fn without_digits(ray: &[f64], magnitudes: &[f64]) -> Vec<f64> {
    // Products of the roots neither overflow nor underflow.
    let size = |(y, m): (&f64, &f64)| y.sqrt() * m.sqrt();
    // A tenth of what counts as zero in a proof.
    let least = (NEGLIGIBLE / 10.0).sqrt() * largest_of(ray.iter().zip(magnitudes).map(size));
    ray.iter().zip(magnitudes).map(|(y, m)| if size((y, m)) < least { 0.0 } else { *y }).collect()
}

/// The first entry that is not finite.
fn overflow(w: &[f64], z: &[f64]) -> Option<String> {
    let place = |name, values| first_not_finite(values).map(|i| entry(name, [i]));
    place("z", z).or_else(|| place("w", w))
}

/// Why there is no solution at this end.
fn reason(ending: &Ending) -> &'static str {
    match ending {
        Ending::Recession(_) => "Lemke's path ended in a ray that is no proof of infeasibility",
        Ending::Singular => "block pivoting met a singular system, or M has no positive diagonal",
        Ending::Stalled(reason) => reason,
        Ending::Done
        | Ending::Cycle
        | Ending::RunsAway(_)
        | Ending::Stopped(_)
        | Ending::Failed(_) => "accuracy was lost to rounding",
    }
}
