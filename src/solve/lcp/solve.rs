//! The linear complementarity problem, by block pivoting and by Lemke's method.

use super::block_pivoting;
use super::lemke::{self, LemkeRules, Scaled};
use super::refinement::{Refined, Task, proving_ray, scales};
use crate::error::{Argument, Error, Message, entry};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{first_not_finite, largest_of, normalise};
use crate::monitor::Monitor;
use crate::problem::Lcp;
use crate::settings::{Method, Settings};
use crate::solve::result::{Effort, Ending, Fallback, Status, check_limit, memory};

/// Result of an LCP.
#[derive(Clone, Debug)]
pub struct LcpSolution {
    /// The status; [`Status::NoEquilibrium`] means that no `w, z >= 0` satisfy `w = q + M z`.
    pub status: Status,
    /// One sentence on what happened.
    pub message: Message,
    /// `w >= 0`: of `z + z_low`, and 0 where that is positive.
    pub w: Vec<f64>,
    /// `z >= 0`.
    pub z: Vec<f64>,
    /// The part that rounding to doubles has left out of [`Self::z`]: `z + z_low` is what `eta` measures; nothing where
    /// `z` alone is as good.
    pub z_low: Vec<f64>,
    /// With [`Status::NoEquilibrium`] the vector `y` that proves it ([`Lcp::is_infeasible_by`]), its
    /// largest entry 1.
    pub infeasible_by: Option<Vec<f64>>,
    /// [`Lcp::eta`] of `z + z_low`.
    pub eta: f64,
    /// The most that rounding `z` to doubles may add to `eta`.
    pub rounding: f64,
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
    // Fortran 77 has no settings, and an argument METHOD.
    let refused = |method: &str| {
        let message =
            format!("method: an LCP is solved by auto, block pivoting and Lemke, not by {method}");
        Err(Error::invalid(Argument::Settings, message))
    };
    let task = Task { lcp, magnitudes: &lcp.magnitudes(), settings, monitor };
    let pivoted = match settings.method {
        Method::Auto | Method::BlockPivoting => Some(by_pivoting(task)),
        Method::Lemke => None,
        Method::SorNested => return refused("nested sweeps"),
        Method::SorDiagonal => return refused("diagonal sweeps"),
        Method::Newton => return refused("Newton's method"),
        Method::Path => return refused("the path"),
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
    let mut solution = by_lemke(task)?;
    if let Some((before, ending)) = pivoted {
        let decided = matches!(solution.status, Status::Solved | Status::NoEquilibrium);
        if !decided && before.eta < solution.eta {
            (solution.w, solution.z, solution.z_low) = (before.w, before.z, before.z_low);
            (solution.eta, solution.rounding) = (before.eta, before.rounding);
        }
        solution.fallback = Some((Method::BlockPivoting, ending.fallback(0)));
        solution.factorisations = before.factorisations;
    }
    Ok(solution)
}

/// Block pivoting, and how it ended.
fn by_pivoting(task: Task<'_>) -> (LcpSolution, Ending) {
    let n = task.lcp.size();
    let (mut z, mut effort) = (vec![0.0; n], Effort::default());
    let ending = if (0..n).any(|i| !(task.lcp.column(i)[i] > 0.0)) {
        Ending::Singular
    } else if n == 0 {
        Ending::Done
    } else {
        let pivoted = block_pivoting::lcp(task);
        // Written so that NaN stays NaN.
        z = pivoted.d().iter().map(|&x| if x < 0.0 { 0.0 } else { x }).collect();
        effort = pivoted.effort;
        pivoted.ending
    };
    let found = at_end(task, z, &ending);
    (certified(task, Method::BlockPivoting, found, (&ending, effort)), ending)
}

/// Lemke's method; a path whose end has lost accuracy is followed once more, and by default, where the host gives a covering
/// vector, at last with ones: entries that differ by a thousand and more take its digits.
fn by_lemke(task: Task<'_>) -> Result<LcpSolution, Error> {
    let Task { lcp, magnitudes, settings, monitor } = task;
    // Powers of two: the pivots are those of the unscaled problem, rounding included.
    let scale = scales(magnitudes);
    let matrix = lcp.matrix;
    let fill = |j: usize, column: &mut [f64]| column.copy_from_slice(matrix.column(j));
    let label = lemke::missing_label(&matrix, lcp.q());
    let end_of_path = |thorough, covering: &[f64]| {
        let scaled = Scaled::new(fill, lcp.q(), covering, scale.clone());
        let rules = LemkeRules { label, ..LemkeRules::usual(thorough) };
        let mut run = lemke::follow(&scaled, rules, monitor)?;
        let found = at_end(task, std::mem::take(&mut run.z), &run.ending);
        Ok::<_, Error>((run, found))
    };
    let ones = vec![1.0; lcp.size()];
    let given = lcp.covering.unwrap_or(&ones);
    let (mut run, mut found) = end_of_path(false, given)?;
    let is_default = settings.method == Method::Auto && lcp.covering.is_some();
    for covering in std::iter::once(given).chain(is_default.then_some(&ones[..])) {
        let lost_accuracy = match run.ending {
            Ending::Done => !found.holds(settings.tolerance),
            Ending::Recession(_) | Ending::Stopped(_) => false,
            _ => true,
        };
        if lost_accuracy {
            (run, found) = end_of_path(true, covering)?;
        }
    }
    let effort = Effort { refactorisations: run.refactorisations, ..Effort::default() };
    Ok(certified(task, Method::Lemke, found, (&run.ending, effort)))
}

/// The candidate with which a method has ended, refined if the method is done.
fn at_end(task: Task<'_>, z: Vec<f64>, ending: &Ending) -> Refined {
    let mut found = Refined::of(task, z);
    if *ending == Ending::Done {
        found.refine(task);
    }
    found
}

/// The result of a candidate, with which a method has ended.
fn certified(
    task: Task<'_>,
    method: Method,
    mut found: Refined,
    (ending, effort): (&Ending, Effort),
) -> LcpSolution {
    let (n, settings) = (task.lcp.size(), task.settings);
    let mut w: Vec<f64> = (0..n).map(|i| found.slack(i)).collect();
    let overflow = overflow(&w, &found.z);
    if overflow.is_some() || !found.certificate.eta.is_finite() {
        // Only numbers are returned: those of z = 0, whose eta is 1 at most.
        found = Refined::of(task, vec![0.0; n]);
        w = (0..n).map(|i| found.slack(i)).collect();
    }
    let eta = found.certificate.eta;
    let holds = overflow.is_none() && found.holds(settings.tolerance);
    let infeasible_by = match ending {
        Ending::Recession(ray) if !holds => proof(task, ray),
        _ => None,
    };
    let wanted = || format!("eta is {eta:.1e}, wanted {:.1e}", settings.tolerance);
    let (status, message) = match ending {
        _ if holds && found.low.is_empty() => (Status::Solved, format!("solved: eta is {eta:.1e}")),
        _ if holds => {
            (Status::Solved, format!("solved: eta is {eta:.1e} before z is rounded to doubles"))
        }
        Ending::Recession(_) if infeasible_by.is_some() => {
            (Status::NoEquilibrium, "no w, z >= 0 satisfy w = q + M z: proved".into())
        }
        Ending::Stopped(stop) => stop.status(settings, &wanted()),
        other => match overflow {
            Some(place) => {
                (Status::Stalled, format!("{place} is beyond the largest number, {:.1e}", f64::MAX))
            }
            None if eta <= settings.tolerance => (Status::Stalled, ROUNDED.into()),
            None => (Status::Stalled, format!("{}; {}", reason(other), wanted())),
        },
    };
    LcpSolution {
        status,
        message: message.into(),
        w,
        z: found.z,
        z_low: found.low,
        infeasible_by,
        eta,
        rounding: found.certificate.rounding,
        method,
        fallback: None,
        iterations: task.monitor.iterations(),
        factorisations: effort.factorisations,
        refactorisations: effort.refactorisations,
    }
}

/// Why a candidate with a small `eta` is no solution.
const ROUNDED: &str = "z rounded to doubles hides q";

/// The vector that proves by a ray that there is no solution, its largest entry 1.
fn proof(task: Task<'_>, ray: &[f64]) -> Option<Vec<f64>> {
    let few = without_digits(ray, task.magnitudes);
    let mut proof = if task.lcp.is_infeasible_by(&few) {
        few
    } else {
        // Digits that rounding has left are none of a proof; small entries may be.
        proving_ray(task, &few).or_else(|| proving_ray(task, ray))?
    };
    normalise(&mut proof);
    Some(proof)
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
        Ending::Cycle => "block pivoting repeats a set of variables: it cycles",
        Ending::Done | Ending::RunsAway(_) | Ending::Stopped(_) | Ending::Failed(_) => {
            "accuracy was lost to rounding"
        }
    }
}
