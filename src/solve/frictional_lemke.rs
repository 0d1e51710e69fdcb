//! Lemke's method for Coulomb friction in 2D, for every coefficient.
//!
//! With `w = gap - d_n`, `d_t - slip = a - b` (`a, b >= 0`) and the force that `d = (gap, slip)` asks
//! for, `K (gap, slip) - f = -(r_n, r_t)`, the problem is
//!
//! ```text
//! p  = r_n + K_nn w - K_nt (a - b)          >= 0,  w >= 0,  p w = 0
//! t  = r_t + K_tn w - K_tt (a - b)                 t = -F_t, p = -F_n
//! u  = mu p - t                              >= 0,  a >= 0,  u a = 0
//! v  = mu p + t                              >= 0,  b >= 0,  v b = 0
//! ```
//!
//! a linear complementarity problem in `(w, a, b)`. Its matrix is not copositive for `mu > 0`, and
//! with the usual covering vector of ones Lemke's method fails. Here the covering vector *clamps
//! every pair and glues it*: `p` grows by `z0 s`, and the thresholds by `z0 (mu s + c)`, `s, c > 0`
//! (`c` may differ between `u` and `v`).
//! The path starts where all pairs are closed and at rest and leads to `z0 = 0`.
//!
//! **Theorem.** Let `x.K x > 0` for all `x != 0` (`K` need not be symmetric), `mu >= 0`. For any loads,
//! gaps and slips the lexicographic method with this covering vector ends at a solution.
//!
//! *Proof.* It does not cycle, so it ends at a solution or on a ray: a direction
//! `(w, a, b, z0) >= 0`, `z0 >= 0`, not all of `(w, a, b)` zero, along which complementarity holds and
//! which satisfies the equations without `r`. Let `e = (-w, a - b)` be its motion and
//! `P = -(K e)_n`, `T = -(K e)_t` its forces. Then `e.K e = w.P - (a - b).T`. On the ray
//! `0 <= P + z0 s`, and `w > 0` only where it is zero: `w.P = -z0 s.w <= 0`. Where `a > b`,
//! complementarity gives `mu (P + z0 s) + z0 c - T = 0`, so `(a - b) T >= 0`; likewise where `a < b`.
//! So `e.K e <= 0`, `e = 0`: `w = 0` and `a = b`, not zero for some pair. Its `u` and `v` then vanish on
//! the whole ray, also where it begins; there their sum is `2 (mu p + c z0)` with `p >= 0`, so
//! `z0 = 0`, and where it begins there already was a solution. ∎
//!
//! *Limits.* The number of steps is not bounded by a polynomial; on meshes it is about the number of
//! pairs that open or slide. In 2D only. If `K` is symmetric and only semi-definite, a ray has
//! `K e = 0`, `e_n <= 0`, and the loads do work on it beyond what friction takes: where the path
//! tells this in floating point, [`crate::certificate::is_escape`] makes it a proof, and otherwise
//! nothing is claimed. Rounding: `z0` ends at a small part of its start, and Newton's method polishes
//! from the pieces found there; the certificate decides.
//!
//! The paper (section 2.2) holds that Lemke's method cannot be extended to friction; Klarbring
//! (Ingenieur-Archiv 56, 1986) formulates the complementarity problem, without this start.
//! With given thresholds the matrix is positive semi-definite and the method needs no such care;
//! the same start serves.

use super::friction_lcp::{Arrays, FrictionLcp};
use super::lemke::{self, Care, Path, Rules, Run};
use super::newton;
use super::solution::{Candidate, Ending};
use super::statics;
use crate::certificate::{certify, is_escape};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::monitor::Monitor;
use crate::problem::ContactProblem;
use crate::settings::Settings;

/// Glues relative to the clamp, against slip to the side +1 and −1. The theorem holds for any positive
/// numbers; on a semi-definite `K` another path may end at a solution where the first, usual one
/// has a ray, and where there are several solutions it may lead to another.
const GLUES: [[f64; 2]; 5] = [[0.5, 0.5], [0.01, 1.0], [1.0, 0.01], [0.01, 0.01], [100.0, 100.0]];

/// Turning points to keep in the search for other solutions.
const TURNS: usize = 4;

/// The path is at its end when `z0` has fallen to this part of its start: nearer to it rounding may
/// turn the path back, or into a ray.
const END: f64 = 1e-10;

/// Solves a problem in 2D.
pub fn solve(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let path = match FrictionLcp::new(problem) {
        Ok(path) => path,
        Err(candidate) => return Ok(candidate),
    };
    let mut first = None;
    let others = GLUES[1..].iter().map(|&glue| (Care::Usual, glue));
    for (care, glue) in
        [(Care::Usual, GLUES[0]), (Care::Thorough, GLUES[0])].into_iter().chain(others)
    {
        let candidate = follow(&path, problem, settings, care, glue, monitor)?;
        let settled = match &candidate.ending {
            Ending::Escape(motion) => is_escape(problem, motion),
            Ending::Interrupted(_) => true,
            _ => certify(problem, &candidate.d).holds(settings.tolerance),
        };
        if settled {
            return Ok(candidate);
        }
        first.get_or_insert(candidate);
    }
    Ok(first.expect("there are several starts"))
}

/// Ends of the path from several starts, and what Newton's method makes of its turning points: all
/// solutions that the path shows.
pub fn ends(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Vec<Candidate>, Error> {
    let Ok(path) = FrictionLcp::new(problem) else { return Ok(Vec::new()) };
    let mut ends = Vec::new();
    for glue in GLUES {
        let mut run =
            run(&path, Rules { care: Care::Usual, end: END, turns: TURNS }, glue, monitor)?;
        let points = std::mem::take(&mut run.turns);
        for z in points.iter().chain(matches!(run.path, Path::Solution).then_some(&run.z)) {
            let (pieces, d) = (path.pieces(z), path.displacements(z));
            ends.push(newton::from_pieces(problem, settings, pieces, d, monitor));
        }
    }
    Ok(ends)
}

/// Follows a path to its end, and polishes the solution there.
fn follow(
    path: &FrictionLcp<'_>,
    problem: &ContactProblem<'_>,
    settings: &Settings,
    care: Care,
    glue: [f64; 2],
    monitor: &mut Monitor<'_>,
) -> Result<Candidate, Error> {
    let run = run(path, Rules { care, end: END, turns: 0 }, glue, monitor)?;
    let d = path.displacements(&run.z);
    let refactorisations = run.refactorisations;
    let ending = match run.path {
        // The ray's own motion proves it where the body only lifts; what it slides on must be
        // left too.
        Path::Ray(ray) => {
            let motion = statics::escape(problem);
            Ending::Escape(motion.unwrap_or_else(|| path.motion(&ray)))
        }
        Path::Interrupted(reason) => Ending::Interrupted(reason),
        Path::Breakdown => Ending::Stalled("rounding made Lemke's basis singular"),
        Path::Solution => {
            let polished =
                newton::from_pieces(problem, settings, path.pieces(&run.z), d.clone(), monitor);
            let eta = |d: &[f64]| certify(problem, d).eta;
            if eta(&polished.d) <= eta(&d) {
                return Ok(Candidate { refactorisations, ending: Ending::Done, ..polished });
            }
            Ending::Done
        }
    };
    Ok(Candidate { refactorisations, ..Candidate::ended(d, ending) })
}

/// Follows a path to its end.
fn run(
    path: &FrictionLcp<'_>,
    rules: Rules,
    glue: [f64; 2],
    monitor: &mut Monitor<'_>,
) -> Result<Run, Error> {
    let Arrays { matrix, q, cover, scales } = path.arrays(glue)?;
    let size = q.len();
    match Lcp::new(size, &matrix, size.max(1), &q, Some(&cover)) {
        Ok(lcp) => lemke::lemke(&lcp, &scales, rules, monitor),
        // Numbers have overflowed.
        Err(_) => Ok(Run::broken(size)),
    }
}
