//! Lemke's method for contact: without friction (paper, section 2.2), and in 2D with Coulomb friction, for every
//! coefficient.
//!
//! Without friction the variables are clearances alone, and the matrix of what carries contact forces is positive
//! semi-definite: a load that drives a motion free of contact has no equilibrium, and neither has one that ends the
//! path in a ray.
//!
//! With the clearance `w = gap - d_n`, the slip `d_t - slip0 = a - b` (`a, b >= 0`) and the contact force
//! that `d = (gap, slip0)` requires, `K (gap, slip0) - f = -(r_n, r_t)`, the problem is
//!
//! ```text
//! p  = r_n + K_nn w - K_nt (a - b)          >= 0,  w >= 0,  p w = 0
//! t  = r_t + K_tn w - K_tt (a - b)                 t = -F_t, p = -F_n
//! u  = mu p - t                              >= 0,  a >= 0,  u a = 0
//! v  = mu p + t                              >= 0,  b >= 0,  v b = 0
//! ```
//!
//! an LCP in `(w, a, b)`. With cohesion `p` is the pressure beside the tension of the pair, whose force is
//! then a part of the load, and the bound has an offset, which is added to `u` and `v`. Its matrix is not copositive for `mu > 0`, and
//! with the usual covering vector of ones Lemke's method fails. Here the covering vector *clamps
//! every pair and adds cohesion*: `p` grows by `z0 s`, and the thresholds by `z0 (mu s + c)`, `s, c > 0`
//! (`c` may differ between `u` and `v`).
//! The path starts where all pairs are closed and stick, and leads to `z0 = 0`.
//!
//! **Theorem.** Let `x.K x > 0` for all `x != 0` (`K` need not be symmetric), `mu >= 0`. For any loads,
//! gaps and reference slips the lexicographic method with this covering vector ends at a solution.
//!
//! *Proof.* It does not cycle, so it ends at a solution or on a ray: a direction
//! `(w, a, b, z0) >= 0`, `z0 >= 0`, not all of `(w, a, b)` zero, along which complementarity holds and
//! which satisfies the equations without `r`. Let `e = (-w, a - b)` be its motion and
//! `P = -(K e)_n`, `T = -(K e)_t` its forces. Then `e.K e = w.P - (a - b).T`. On the ray
//! `0 <= P + z0 s`, and `w > 0` only where it is zero: `w.P = -z0 s.w <= 0`. Where `a > b`,
//! complementarity gives `mu (P + z0 s) + z0 c - T = 0`, so `(a - b) T >= 0`; likewise where `a < b`.
//! So `e.K e <= 0`, `e = 0`: `w = 0` and `a = b`, not zero for some pair. Its `u` and `v` then vanish on
//! the whole ray, also where it begins; there their sum is `2 (mu p + offset + c z0)` with `p >= 0` and
//! `offset >= 0`, so `z0 = 0`, and where it begins there already was a solution. ∎
//!
//! *Limits.* The number of steps is not bounded by a polynomial; on meshes it is about the number of
//! pairs that open or slip. In 2D only. If `K` is symmetric and only semi-definite, a ray has
//! `K e = 0`, `e_n <= 0`, and the loads do work on it beyond what friction takes. It proves that no
//! equilibrium exists where it passes [`crate::certificate::is_escape`]; otherwise nothing is claimed.
//! Rounding: `z0` ends at a small part of its start, and Newton's method polishes from the pieces found
//! there; the certificate decides.
//!
//! The default asks the linear path before (`solve::path`), which has the same guarantee and starts where
//! sweeps end: here each pair that opens or slips costs a pivot of the whole tableau.
//!
//! The paper (section 2.2) holds that Lemke's method cannot be extended to friction; Klarbring (1986)
//! formulates friction as linear complementarity, without this start. With given thresholds the matrix is
//! positive semi-definite and the standard theory applies; the same start serves.

use super::path::{self, LemkeRules};
use super::scaled::Scaled;
use crate::certificate::is_escape_of;
use crate::error::Error;
use crate::solve::newton::from_pieces;
use crate::solve::part::ContactLcp;
use crate::solve::result::{Call, Candidate, Ending};
use crate::solve::rigid;

/// Cohesion relative to the clamp, against slip to the side +1 and −1. The theorem holds for any
/// positive numbers. The first pair is of the size of the clamp. The others serve the search for other solutions: lopsided
/// by 100 to either side, weak and strong by 100.
const COHESIONS: [[f64; 2]; 5] =
    [[0.5, 0.5], [0.01, 1.0], [1.0, 0.01], [0.01, 0.01], [100.0, 100.0]];

/// Turning points to keep in the search for other solutions: one more than the solutions of the
/// smallest problem that has several.
const TURNS: usize = 4;

/// The path is at its end when `z0` has fallen to this part of its start: nearer to it rounding may
/// turn the path back, or into a ray. Newton's method finds the rest of the digits.
const END: f64 = 1e-10;

/// Solves a problem without friction, or in 2D: follows a path to its end, and polishes the solution there. It needs no
/// start.
pub fn solve(call: &Call<'_>) -> Result<Candidate, Error> {
    let (contact, settings) = (call.contact, call.settings);
    let lcp = match ContactLcp::new(contact, call.monitor) {
        Ok(lcp) => lcp,
        Err(why) => return Ok(Candidate::without_displacements(contact, why)),
    };
    let usual = LemkeRules::usual(false);
    let rules = if contact.is_frictionless() { usual } else { LemkeRules { end: END, ..usual } };
    let run = path::follow(&scaled(&lcp, COHESIONS[0]), rules, call.monitor)?;
    let d = lcp.displacements(&run.z);
    let ending = match run.ending {
        // If the body only lifts off, the ray itself is the proof; if it also slips, the balance of
        // the other pairs decides.
        Ending::Recession(ray) => {
            let motion = lcp.motion(&ray);
            let proves = is_escape_of(contact, &motion);
            let balanced = if proves { None } else { rigid::escape_behind_others(call) };
            Ending::Recession(balanced.unwrap_or(motion))
        }
        other => other,
    };
    let mut candidate = Candidate::of_displacements(contact, d, ending);
    if candidate.ending == Ending::Done
        && !call.monitor.is_late()
        && !(contact.is_frictionless() && candidate.is_settled(contact, settings.tolerance))
    {
        let (pieces, d) = (lcp.pieces(&run.z), candidate.d().to_vec());
        let mut refined = from_pieces(&call.from(&d), &pieces);
        refined.ending = Ending::Done;
        if refined.certificate(contact).eta <= candidate.certificate(contact).eta {
            candidate = refined;
        }
    }
    candidate.effort.refactorisations = run.refactorisations;
    Ok(candidate)
}

/// The LCP with the cohesion of the covering vector against slip to either side.
fn scaled<'l>(lcp: &'l ContactLcp<'_>, cohesion: [f64; 2]) -> Scaled<'l> {
    let [q, covering, root] = lcp.vectors(cohesion);
    let scale = root.iter().map(|root| root.recip()).collect();
    Scaled::new(|j, column| lcp.write_column(j, column), &q, &covering, scale)
}

/// Ends of the path from several starts, and what Newton's method makes of its turning points: all
/// solutions that the path shows.
pub fn ends(call: &Call<'_>) -> Result<Vec<Candidate>, Error> {
    let Ok(lcp) = ContactLcp::new(call.contact, call.monitor) else { return Ok(Vec::new()) };
    let mut ends = Vec::new();
    let rules = LemkeRules { end: END, turns: TURNS, ..LemkeRules::usual(false) };
    for cohesion in COHESIONS {
        if call.monitor.is_late() {
            break;
        }
        let run = path::follow(&scaled(&lcp, cohesion), rules, call.monitor)?;
        for z in run.turns.iter().chain((run.ending == Ending::Done).then_some(&run.z)) {
            let (pieces, d) = (lcp.pieces(z), lcp.displacements(z));
            ends.push(from_pieces(&call.from(&d), &pieces));
        }
    }
    Ok(ends)
}
