//! The bare linear complementarity problem, by block pivoting and by Lemke's method.

use super::lemke::{Care, Path, Rules, lemke};
use super::pivot;
use super::solution::{Ending, Fallback, Status};
use crate::error::{Argument, Error};
use crate::lcp::Lcp;
use crate::linalg::small::largest;
use crate::monitor::{Monitor, Stop};
use crate::problem::{ContactData, ContactProblem, FrictionLaw};
use crate::settings::{Method, Settings};

/// Result of a bare complementarity problem.
#[derive(Clone, Debug)]
pub struct LcpSolution {
    /// What it is; [`Status::NoEquilibrium`] says that nothing is feasible.
    pub status: Status,
    /// One sentence on what happened.
    pub message: String,
    /// `w >= 0`.
    pub w: Vec<f64>,
    /// `z >= 0`.
    pub z: Vec<f64>,
    /// Of [`Status::NoEquilibrium`] the vector `y` that proves it ([`Lcp::is_infeasible_by`]), its
    /// largest entry 1.
    pub infeasible_by: Option<Vec<f64>>,
    /// [`Lcp::eta`].
    pub eta: f64,
    /// The method that ended it.
    pub method: Method,
    /// The method tried first, and why it did not end it.
    pub fallback: Option<(Method, Fallback)>,
    /// Pivots, or linear systems, of all methods that were tried.
    pub iterations: u64,
    /// Dense factorisations of block pivoting.
    pub factorisations: u64,
    /// How often the tableau was computed anew because accuracy was lost.
    pub refactorisations: u64,
}

/// Solves a bare linear complementarity problem: by default by block pivoting, then Lemke's method.
///
/// # Errors
/// Settings out of range, or a method for contact problems; memory that cannot be had.
pub fn solve_lcp(
    lcp: &Lcp<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<LcpSolution, Error> {
    settings.validate()?;
    let mut pivoted = None;
    match settings.method {
        Method::Auto | Method::BlockPivoting => {
            let run = by_pivoting(lcp, settings, monitor);
            let solution =
                certified(lcp, settings, Method::BlockPivoting, &run, monitor.iterations());
            let done =
                solution.status == Status::Solved || settings.method == Method::BlockPivoting;
            if done || matches!(run.end, End::Interrupted(_)) {
                return Ok(solution);
            }
            pivoted = Some((run, solution));
        }
        Method::Lemke => {}
        _ => {
            let message = "settings: a bare complementarity problem is solved by the methods auto, \
                           pivot and Lemke";
            return Err(Error::invalid(Argument::Settings, message));
        }
    }
    let run = by_lemke(lcp, settings, monitor)?;
    let mut solution = certified(lcp, settings, Method::Lemke, &run, monitor.iterations());
    if let Some((run, before)) = pivoted {
        let decided = matches!(solution.status, Status::Solved | Status::NoEquilibrium);
        if !decided && before.eta < solution.eta {
            (solution.w, solution.z, solution.eta) = (before.w, before.z, before.eta);
        }
        let why = if run.end == End::Singular { Fallback::Singular } else { Fallback::Inaccurate };
        solution.fallback = Some((Method::BlockPivoting, why));
        solution.factorisations = before.factorisations;
    }
    Ok(solution)
}

/// A candidate `z` and how it was come by.
struct Run {
    z: Vec<f64>,
    end: End,
    factorisations: u64,
    refactorisations: u64,
}

#[derive(PartialEq)]
enum End {
    Done,
    Singular,
    Ray(Vec<f64>),
    Interrupted(Stop),
}

/// The problem as frictionless contact with one component a pair, `z = -d`, `w = -F`, `q = f`.
fn by_pivoting(lcp: &Lcp<'_>, settings: &Settings, monitor: &mut Monitor<'_>) -> Run {
    let n = lcp.size();
    let nothing = |end| Run { z: vec![0.0; n], end, factorisations: 0, refactorisations: 0 };
    if n == 0 {
        return nothing(End::Done);
    }
    if (0..n).any(|i| !(lcp.column(i)[i] > 0.0)) {
        return nothing(End::Singular);
    }
    let zero = vec![0.0; n];
    let problem = ContactProblem::reduced(ContactData {
        dim: 1,
        pairs: n,
        stiffness: lcp.matrix(),
        ld: lcp.ld(),
        load: lcp.q(),
        gap: &zero,
        law: FrictionLaw::Coulomb(&zero),
        reference_slip: None,
    });
    let most = if settings.method == Method::BlockPivoting { u64::MAX } else { pivot::enough(n) };
    // The measure of contact problems has another scale than `Lcp::eta`, which decides.
    let strict = Settings { tolerance: 0.01 * settings.tolerance, ..settings.clone() };
    let candidate = pivot::solve(&problem, &strict, lcp.is_symmetric(), None, most, monitor);
    Run {
        z: candidate.d.iter().map(|d| (-d).max(0.0)).collect(),
        end: match candidate.ending {
            Ending::Interrupted(reason) => End::Interrupted(reason),
            Ending::Singular => End::Singular,
            _ => End::Done,
        },
        factorisations: candidate.factorisations,
        refactorisations: 0,
    }
}

fn by_lemke(lcp: &Lcp<'_>, settings: &Settings, monitor: &mut Monitor<'_>) -> Result<Run, Error> {
    // Powers of two: the pivots are those of the unscaled problem, rounding included.
    let scale: Vec<f64> =
        lcp.magnitudes().iter().map(|m| (-(m.log2() / 2.0).round()).exp2()).collect();
    let mut run = lemke(lcp, &scale, Rules::usual(Care::Usual), monitor)?;
    let lost_accuracy = match run.path {
        Path::Solution => lcp.eta(&run.z) > settings.tolerance,
        Path::Breakdown => true,
        Path::Ray(_) | Path::Interrupted(_) => false,
    };
    if lost_accuracy {
        run = lemke(lcp, &scale, Rules::usual(Care::Thorough), monitor)?;
    }
    Ok(Run {
        z: run.z,
        end: match run.path {
            Path::Ray(ray) => End::Ray(ray),
            Path::Interrupted(reason) => End::Interrupted(reason),
            Path::Solution | Path::Breakdown => End::Done,
        },
        factorisations: 0,
        refactorisations: run.refactorisations,
    })
}

fn certified(
    lcp: &Lcp<'_>,
    settings: &Settings,
    method: Method,
    run: &Run,
    iterations: u64,
) -> LcpSolution {
    let (eta, product) = lcp.measure(&run.z);
    let mut infeasible_by = None;
    let wanted = format!("eta is {eta:.1e}, wanted {:.1e}", settings.tolerance);
    let (status, message) = match &run.end {
        _ if eta <= settings.tolerance => (Status::Solved, format!("solved: eta is {eta:.1e}")),
        End::Ray(ray) if lcp.is_infeasible_by(ray) => {
            let most = largest(ray);
            infeasible_by = Some(ray.iter().map(|y| y / most).collect());
            (Status::NoEquilibrium, "no w, z >= 0 satisfy w = q + M z: proved".into())
        }
        End::Ray(_) => {
            (Status::Stalled, format!("the path ended in a ray that proves nothing; {wanted}"))
        }
        End::Interrupted(reason) => reason.ended(settings, &wanted),
        End::Singular => (
            Status::Stalled,
            format!(
                "block pivoting met a singular system, or M has no positive diagonal; {wanted}"
            ),
        ),
        End::Done => (Status::Stalled, format!("accuracy was lost to rounding; {wanted}")),
    };
    let w = lcp.q().iter().zip(&product).zip(&run.z);
    let w = w.map(|((q, mz), z)| if *z > 0.0 { 0.0 } else { (q + mz).max(0.0) }).collect();
    LcpSolution {
        status,
        message,
        w,
        z: run.z.clone(),
        infeasible_by,
        eta,
        method,
        fallback: None,
        iterations,
        factorisations: run.factorisations,
        refactorisations: run.refactorisations,
    }
}
