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

use super::elimination::driven_motion;
use super::factor::Factor;
use super::lemke::{self, Care, Path, Rules, Run};
use super::newton;
use super::pieces::{Motion, Piece};
use super::solution::{Candidate, Ending};
use crate::certificate::{certify, is_escape};
use crate::error::Error;
use crate::lcp::Lcp;
use crate::linalg::small::largest;
use crate::monitor::Monitor;
use crate::problem::{ContactProblem, Friction};
use crate::settings::Settings;

/// Glue relative to the clamp, against slip to the side +1 and −1. The theorem holds for any
/// positive numbers.
const GLUE: [f64; 2] = [0.5, 0.5];

/// Other glues, whose paths may lead to other solutions, and how many turning points to keep.
const GLUES: [[f64; 2]; 5] = [GLUE, [0.01, 1.0], [1.0, 0.01], [0.01, 0.01], [100.0, 100.0]];
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
    let path = match FrictionPath::new(problem) {
        Ok(path) => path,
        Err(candidate) => return Ok(candidate),
    };
    let mut last = None;
    for care in [Care::Usual, Care::Thorough] {
        let candidate = path.follow(settings, care, monitor)?;
        let settled = match &candidate.ending {
            Ending::Escape(motion) => is_escape(problem, motion),
            Ending::Interrupted(_) => true,
            _ => certify(problem, &candidate.d).holds(settings.tolerance),
        };
        if settled {
            return Ok(candidate);
        }
        last = Some(candidate);
    }
    Ok(last.expect("the path was followed twice"))
}

/// Ends of the path from several starts, and what Newton's method makes of its turning points: all
/// solutions that the path shows.
pub fn ends(
    problem: &ContactProblem<'_>,
    settings: &Settings,
    monitor: &mut Monitor<'_>,
) -> Result<Vec<Candidate>, Error> {
    let Ok(path) = FrictionPath::new(problem) else { return Ok(Vec::new()) };
    let mut ends = Vec::new();
    for glue in GLUES {
        let mut run =
            path.run(Rules { care: Care::Usual, end: END, turns: TURNS }, glue, monitor)?;
        let points = std::mem::take(&mut run.turns);
        for z in points.iter().chain(matches!(run.path, Path::Solution).then_some(&run.z)) {
            let (pieces, d) = (path.pieces(z), path.displacements(z));
            ends.push(newton::from_pieces(problem, settings, pieces, d, monitor));
        }
    }
    Ok(ends)
}

/// The complementarity problem of a contact problem.
struct FrictionPath<'p> {
    problem: &'p ContactProblem<'p>,
    /// Components that carry no contact force are eliminated.
    eliminated: Factor,
    at_rest: Vec<f64>,
    /// Normal, then tangential components that are left.
    normal: Vec<usize>,
    tangential: Vec<usize>,
    /// `K` on them, condensed, column-major.
    stiffness: Vec<f64>,
}

impl<'p> FrictionPath<'p> {
    fn new(problem: &'p ContactProblem<'p>) -> Result<Self, Candidate> {
        let stalled = |reason| Candidate::ended(vec![0.0; problem.unknowns()], reason);
        let faces = |i: &usize| problem.gap(i / 2) < f64::INFINITY;
        let normal: Vec<usize> = (0..problem.unknowns()).step_by(2).filter(faces).collect();
        let coulomb = matches!(problem.friction(), Friction::Coulomb(_));
        let rubs = |i: &usize| !coulomb || faces(i);
        let tangential: Vec<usize> = (1..problem.unknowns()).step_by(2).filter(rubs).collect();
        let kept: Vec<usize> = normal.iter().chain(&tangential).copied().collect();
        let mut is_kept = vec![false; problem.unknowns()];
        kept.iter().for_each(|&i| is_kept[i] = true);
        let others = (0..problem.unknowns()).filter(|&i| !is_kept[i]).collect();
        let eliminated = Factor::new(problem, others)
            .ok_or_else(|| stalled(Ending::Stalled("K is not positive semi-definite")))?;
        let mut at_rest = vec![0.0; problem.unknowns()];
        for &i in &normal {
            at_rest[i] = problem.gap(i / 2);
        }
        for &i in &tangential {
            at_rest[i] = problem.previous_slip(i / 2, 0);
        }
        eliminated.equilibrate(problem, &mut at_rest);
        if let Some(motion) = driven_motion(problem, &eliminated, &at_rest) {
            return Err(stalled(Ending::Escape(motion)));
        }
        let stiffness = eliminated.schur_complement(problem, &kept);
        Ok(FrictionPath { problem, eliminated, at_rest, normal, tangential, stiffness })
    }

    /// Matrix and vector of the complementarity problem in `(w, a, b)`, its covering vector, and the
    /// scales of its variables.
    fn lcp(&self, glue: [f64; 2]) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<f64>) {
        let (problem, n, m) = (self.problem, self.normal.len(), self.tangential.len());
        let size = n + 2 * m;
        let force = problem.force(&self.at_rest);
        let root = |i: usize| problem.diagonal(i).sqrt();
        let scale = |i: &usize| root(*i).recip();
        let scales: Vec<f64> = self.normal.iter().map(scale).collect();
        let tangential_scales: Vec<f64> = self.tangential.iter().map(scale).collect();
        let scales = [&scales[..], &tangential_scales, &tangential_scales].concat();
        // Where the pair of each tangential component has its pressure, and its coefficient.
        let mut place = vec![usize::MAX; problem.pairs()];
        for (k, &i) in self.normal.iter().enumerate() {
            place[i / 2] = k;
        }
        let (mu, g) = match problem.friction() {
            Friction::Coulomb(mu) => (Some(mu), None),
            Friction::Tresca(g) => (None, Some(g)),
        };
        let coefficient =
            |k: usize| mu.map(|mu| (mu[self.tangential[k] / 2], place[self.tangential[k] / 2]));

        let mut q = vec![0.0; size];
        let mut cover = vec![0.0; size];
        for (k, &i) in self.normal.iter().enumerate() {
            q[k] = -force[i];
            cover[k] = root(i);
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            let (bound, clamp) = match coefficient(k) {
                Some((mu, normal)) => (mu * q[normal], mu * cover[normal]),
                None => (g.map_or(0.0, |g| g[i / 2]), 0.0),
            };
            (q[n + k], q[n + m + k]) = (bound + force[i], bound - force[i]);
            (cover[n + k], cover[n + m + k]) =
                (clamp + glue[0] * root(i), clamp + glue[1] * root(i));
        }
        let mut matrix = vec![0.0; size * size];
        for (j, column) in matrix.chunks_exact_mut(size.max(1)).enumerate() {
            // Unknown j moves one component, an opening or a slip to one side.
            let (component, sign) = match j {
                j if j < n => (j, -1.0),
                j if j < n + m => (j, 1.0),
                j => (j - m, -1.0),
            };
            let source = &self.stiffness[component * (n + m)..(component + 1) * (n + m)];
            for (column, k) in column.iter_mut().zip(&source[..n]) {
                *column = -sign * k;
            }
            for k in 0..m {
                let bound = coefficient(k).map_or(0.0, |(mu, normal)| -mu * sign * source[normal]);
                let force = sign * source[n + k];
                (column[n + k], column[n + m + k]) = (bound + force, bound - force);
            }
        }
        (matrix, q, cover, scales)
    }

    fn follow(
        &self,
        settings: &Settings,
        care: Care,
        monitor: &mut Monitor<'_>,
    ) -> Result<Candidate, Error> {
        let run = self.run(Rules { care, end: END, turns: 0 }, GLUE, monitor)?;
        let d = self.displacements(&run.z);
        let refactorisations = run.refactorisations;
        let ending = match run.path {
            Path::Ray(ray) => Ending::Escape(self.motion(&ray)),
            Path::Interrupted(reason) => Ending::Interrupted(reason),
            Path::Breakdown => Ending::Stalled("rounding made Lemke's basis singular"),
            Path::Solution => {
                let polished = newton::from_pieces(
                    self.problem,
                    settings,
                    self.pieces(&run.z),
                    d.clone(),
                    monitor,
                );
                let eta = |d: &[f64]| certify(self.problem, d).eta;
                if eta(&polished.d) <= eta(&d) {
                    return Ok(Candidate { refactorisations, ending: Ending::Done, ..polished });
                }
                Ending::Done
            }
        };
        Ok(Candidate { refactorisations, ..Candidate::ended(d, ending) })
    }

    fn run(&self, rules: Rules, glue: [f64; 2], monitor: &mut Monitor<'_>) -> Result<Run, Error> {
        let (matrix, q, cover, scales) = self.lcp(glue);
        let size = q.len();
        match Lcp::new(size, &matrix, size.max(1), &q, Some(&cover)) {
            Ok(lcp) => lemke::lemke(&lcp, &scales, rules, monitor),
            // Numbers have overflowed.
            Err(_) => Ok(Run::broken(size)),
        }
    }

    /// All displacements of a point of the path.
    fn displacements(&self, z: &[f64]) -> Vec<f64> {
        let mut d = self.at_rest.clone();
        for (d, motion) in d.iter_mut().zip(self.kept_motion(z)) {
            *d += motion;
        }
        self.eliminated.equilibrate(self.problem, &mut d);
        d
    }

    /// The motion of all components along a ray.
    fn motion(&self, ray: &[f64]) -> Vec<f64> {
        let mut motion = self.kept_motion(ray);
        // Digits that rounding has left beside the largest are no motion.
        let least = 1e-12 * largest(&motion);
        motion.iter_mut().filter(|r| r.abs() < least).for_each(|r| *r = 0.0);
        self.eliminated.follow(self.problem, &mut motion);
        motion
    }

    fn kept_motion(&self, z: &[f64]) -> Vec<f64> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let mut motion = vec![0.0; self.problem.unknowns()];
        for (k, &i) in self.normal.iter().enumerate() {
            motion[i] = -z[k];
        }
        for (k, &i) in self.tangential.iter().enumerate() {
            motion[i] = z[n + k] - z[n + m + k];
        }
        motion
    }

    /// The pieces of a point of the path.
    fn pieces(&self, z: &[f64]) -> Vec<Piece> {
        let (n, m) = (self.normal.len(), self.tangential.len());
        let apart = Piece { closed: false, motion: Motion::Slide(0) };
        let mut pieces = vec![apart; self.problem.pairs()];
        for (k, &i) in self.normal.iter().enumerate() {
            pieces[i / 2].closed = z[k] == 0.0;
        }
        let tresca = matches!(self.problem.friction(), Friction::Tresca(_));
        for (k, &i) in self.tangential.iter().enumerate() {
            let piece = &mut pieces[i / 2];
            let rubs = self.problem.threshold(i / 2, 1.0) > 0.0;
            if rubs && (piece.closed || tresca) {
                piece.motion = match (z[n + k], z[n + m + k]) {
                    (a, b) if a > b => Motion::Slide(1),
                    (a, b) if a < b => Motion::Slide(-1),
                    _ => Motion::Rest,
                };
            }
        }
        pieces
    }
}
