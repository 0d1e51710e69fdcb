//! The bare linear complementarity problem, by Lemke's method.

use super::lemke::{Care, Path, Rules, Run, lemke};
use super::{Fallback, Status};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::linalg::small::largest;
use crate::monitor::Monitor;
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
    /// `z >= 0`; of [`Status::NoEquilibrium`] the vector `y` that proves it, its largest entry 1.
    pub z: Vec<f64>,
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

/// Solves a bare linear complementarity problem by Lemke's method.
///
/// # Errors
/// Settings out of range; memory that cannot be had. The method in `settings` is not looked at.
pub fn solve_lcp(
    lcp: &Lcp<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<LcpSolution, Error> {
    settings.validate()?;
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
    Ok(certified(lcp, settings, run, monitor.iterations()))
}

fn certified(lcp: &Lcp<'_>, settings: &Settings, run: Run, iterations: u64) -> LcpSolution {
    let Run { mut z, path, refactorisations, .. } = run;
    let eta = lcp.eta(&z);
    let wanted = format!("eta is {eta:.1e}, wanted {:.1e}", settings.tolerance);
    let (status, message) = match path {
        _ if eta <= settings.tolerance => (Status::Solved, format!("solved: eta is {eta:.1e}")),
        Path::Ray(ray) if lcp.is_infeasible_by(&ray) => {
            let most = largest(&ray);
            z = ray.iter().map(|y| y / most).collect();
            (Status::NoEquilibrium, "no w, z >= 0 satisfy w = q + M z: proved by z".into())
        }
        Path::Ray(_) => {
            (Status::Stalled, format!("the path ended in a ray that proves nothing; {wanted}"))
        }
        Path::Interrupted(reason) => reason.ended(settings, &wanted),
        Path::Solution | Path::Breakdown => {
            (Status::Stalled, format!("accuracy was lost to rounding; {wanted}"))
        }
    };
    let product = lcp.product(&z);
    let w = lcp.q().iter().zip(&product).zip(&z);
    let w = w.map(|((q, mz), z)| if *z > 0.0 { 0.0 } else { (q + mz).max(0.0) }).collect();
    LcpSolution {
        status,
        message,
        w,
        z,
        eta,
        method: Method::Lemke,
        fallback: None,
        iterations,
        factorisations: 0,
        refactorisations,
    }
}
