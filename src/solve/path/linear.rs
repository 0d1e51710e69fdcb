//! The linear path in the plane: a pivoting method for friction that starts where sweeps end.
//!
//! With the coordinates `y` of the normal map (`law::normal_map`) contact is one equation,
//! `H(y) = K v(y) + P(y) = r`, and in the plane `H` is linear on each piece of the law: open, stick,
//! slip to either side. From any coordinates `y0` the loads are led in a straight line to their place,
//!
//! ```text
//! K v(y) + P(y) = r_s,    r_s = (1 - s) r_0 + s r,    r_0 = H(y0),    0 <= s <= 1.
//! ```
//!
//! On a piece the solution moves on a straight line; where one pair reaches the boundary of its piece,
//! it goes on in the next one, and the derivative `J` changes by a matrix of rank one
//! (`pieces::Updated`). The direction of travel has `ds/dt` of the sign of `det J`.
//!
//! Let `x.K x >= alpha |x|²`, `alpha > 0` (`K` need not be symmetric), with any loads, gaps, reference
//! slips, and thresholds `mu p + b`, `mu, b >= 0`. Every point of the law has `v.P >= 0`; so a solution
//! for `r_s` has `alpha |v|² <= v.r_s`, and all of them lie in one ball. For almost all `r_0` no two pairs
//! change at once: the solutions with `s < 1` form curves that neither end nor branch, oriented by the
//! sign of `det J`, because a boundary multiplies it by the factor by which it changes `n.dy`.
//!
//! **Theorem G.** *If `y0` is the only point with `H(y0) = r_0`, the path from it leads to a solution. If
//! it is not, the path may come back to `s = 0`, at a point with `det J < 0`.*
//!
//! *Proof.* The curve that begins at `(y0, 0)` is bounded, so it ends at `s = 0` or at `s = 1`. The degree
//! of `H` is that of the identity, 1, so that `det J > 0` at a single point, and the curve begins upwards.
//! An end at `s = 0` would be reached downwards, where `det J < 0`, so at another point. ∎
//!
//! **Theorem I.** *If the loads `r_s` have one point for all `s` far below zero, the path from any `y0`, followed with
//! the sign of `det J` whatever `s` is, is closed or leads to a solution.*
//!
//! *Proof.* At each `s` the signs of `det J` add up to 1. Curves that neither end nor branch come from `s = -∞` or `∞`
//! and go there. The one that is at `s = -∞` has `det J > 0`: it comes from there. So none goes there, and the path from
//! `y0` goes to `s = ∞`. ∎
//!
//! So a path that comes back to `s = 0` goes on below, and one may begin where `det J < 0`. Without the premise it may
//! sink for ever.
//!
//! With given thresholds (`mu = 0`) `det J > 0` on all pieces: every start is the only point of its
//! loads, and `s` never falls. With friction it may not be: for one pair with `K = [2 1; 1 1]`, `mu = 2`
//! and `r_0 = (1, F)`, `1 < F < 2`, stick, slip and open are all possible.
//!
//! **Theorem H.** *Let pairs `O` be open with the clearances `w > 0` and the slips `delta`,
//! `mu |delta| <= w`, and the others closed with `p > 0`, without slip, with `|tau| <= b`. Then this is the only
//! point of its loads, and the path from it leads to a solution.*
//!
//! *Proof.* Let another point of the same loads have `w', delta', p', tau'`, and let `D` be the differences.
//! `H` is the same, so `D v.D P = -D v.K D v <= -alpha |D v|²`. But pair by pair `D v.D P >= 0`. Closed pairs
//! give `w' p` and `delta' (tau' - tau) >= (mu p' + b) |delta'| - b |delta'| >= 0`. Open ones give `w p'` and,
//! as `delta' tau' = (mu p' + b) |delta'|`, `delta tau = b |delta|` and `|tau| <= b`,
//!
//! ```text
//! (delta' - delta) (tau' - tau) >= (mu p' + b) (|delta'| - |delta|) - b (|delta'| - |delta|)
//!                               >= -mu p' |delta| >= -w p'.
//! ```
//!
//! So `D v = 0`, then `D P = -K D v = 0`. `y0` is interior to its piece and `J` is regular there, so that the
//! same holds for the loads near by, among which almost all are generic; then theorem G. ∎
//!
//! A pair without friction may begin on any piece. So there are sure starts: pairs that the sweeps leave open stay open
//! and keep their slips as far as the clearance allows; closed pairs start without friction and slip
//! (`PairLaw::sure_start`). The example above forbids kept friction, and kept slip of closed pairs.
//!
//! **Theorem K.** *Let `K` be symmetric and semi-definite, and let every rigid motion move a closed pair of
//! the start, in its normal component or, if it has friction, in any. The path of H ends at a solution, or
//! on a ray `y + lambda y_e`, `lambda >= 0`, at one `s`, with a motion `e != 0`, `K e = 0`, `e_n <= 0` and
//! `s r.e >= sum (mu p + s b) |e_t| >= 0`.*
//!
//! *Proof.* As for H, but now `D v.K D v = 0` only says that `D v` is rigid and `D P = 0`. Then `p' = p > 0` on
//! the closed pairs, so `w' = 0`, and where friction is below its bound there is no slip: `D v` moves no closed
//! pair and is zero. Along a ray the law without constants holds for `(e, P_e)`, and
//! `e.K e + e.P_e = 0` has no negative part: `K e = 0`, and `P` does not change. Multiply the equation
//! by `e`: `r_s.e = sum (mu p + b) |e_t|`, and `r_0.e = sum (p0 e_n + tau0 e_t) <= sum b |e_t|`. ∎
//!
//! So a ray is a candidate for the proof that no equilibrium exists, which
//! [`crate::certificate::is_escape`] decides; friction may hold a body that this proof does not.
//!
//! *The walks.* First on the pairs in question alone (`newton::uncertain_pairs`), where an event costs
//! little: their matrix is definite too. Swept starts are near a solution, and most of their walks are short, so that
//! several are tried, after more and more sweeps: by theorem I without its premise. Then walks on all pairs, from
//! where those in question have come to: from swept starts, from all pairs pressed on their obstacles, and from a sure
//! start, H; at last, if rounding spoils them, from pressed pairs with factorisations at nearly every event
//! (`linear_start`). Starts are moved at random by 1e-7 of the loads, always by
//! the same numbers: symmetric meshes have ties. At `s = 1` nothing is left of that, and Newton's method refines from
//! the pieces found there.
//!
//! *Limits.* The number of events is not bounded by a polynomial.

use super::linear_start::{ATTEMPTS, Attempt, ON_UNCERTAIN_PAIRS, Starts, with_given_thresholds};
use super::linear_walk::{LOST, Walk};
use crate::counters::count;
use crate::law::references;
use crate::linalg::vector::opposite;
use crate::solve::newton::{from_pieces, refine_to_tolerance, solve_part};
use crate::solve::pieces::Equations;
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::rigid;

/// Solves a problem in the plane. An iteration is an event: a pair that passes from one piece to the next.
pub fn linear(call: &Call<'_>) -> Candidate {
    if !call.contact.is_coupled() {
        return solve(call, with_given_thresholds());
    }
    match on_uncertain_pairs(call) {
        Ok(candidate) if candidate.is_settled(call.contact, call.settings.tolerance) => candidate,
        Ok(candidate) => solve(&call.from(candidate.d()), &ATTEMPTS),
        Err(d) => solve(&call.from(&d), &ATTEMPTS),
    }
}

/// Solves by walks on the pairs in question. `Err`: these are not few, or no walk arrives; how far the
/// displacements have come.
fn on_uncertain_pairs(call: &Call<'_>) -> Result<Candidate, Vec<f64>> {
    let mut skipped = 1;
    solve_part(call, &mut |part| solve(part, &ON_UNCERTAIN_PAIRS[std::mem::take(&mut skipped)..]))
}

fn solve(call: &Call<'_>, attempts: &[Attempt]) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let equations = Equations::of(contact);
    // r = f - K (gap, slip0): the loads on the body that touches all its obstacles.
    let reference: Vec<f64> = references(contact.pairs(), 2).collect();
    let load = opposite(&equations.force(&reference));
    let mut starts = Starts::new(call, &equations.root, equations.length(&load));
    let mut best = Candidate::without_displacements(contact, LOST);
    let mut effort = Effort::default();
    for (number, &attempt) in attempts.iter().enumerate() {
        let y = starts.next(attempt);
        let mut walk = match Walk::new(&equations, &load, &y, call.monitor) {
            Ok(walk) => walk,
            Err(ending @ Ending::Stopped(_)) => {
                best.ending = ending;
                break;
            }
            Err(_) => continue,
        };
        let end = walk.follow(attempt.rules(y.len()));
        let mut candidate = ended(call, &walk, end);
        effort.factorisations += walk.factorisations + candidate.effort.factorisations;
        candidate.effort = effort;
        let settled = candidate.is_settled(contact, settings.tolerance);
        count(
            "path in the plane",
            20 * usize::from(attempts.len() <= ON_UNCERTAIN_PAIRS.len()) + number,
            settled,
        );
        if settled {
            return candidate;
        }
        if candidate.certificate(contact).eta < best.certificate(contact).eta {
            best = candidate;
        }
        best.effort = effort;
    }
    best
}

/// The candidate of a walk that has ended.
fn ended(call: &Call<'_>, walk: &Walk<'_>, end: Result<(), Ending>) -> Candidate {
    let d = walk.displacements();
    let ending = match end {
        Ok(()) => {
            let mut candidate = from_pieces(&call.from(&d), &walk.pieces);
            // Other walks arrive at the same pieces, with the same rounding.
            refine_to_tolerance(call, &mut candidate);
            return candidate;
        }
        // If the body only lifts off, the ray itself is the proof; if it also slips, the balance of
        // the other pairs decides.
        Err(Ending::Recession(motion)) => {
            Ending::Recession(rigid::escape_behind_others(call).unwrap_or(motion))
        }
        Err(ending) => ending,
    };
    Candidate::of_displacements(call.contact, d, ending)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::Contact;
    use crate::monitor::Monitor;
    use crate::problem::{ContactProblem, FrictionLaw};
    use crate::settings::Settings;
    use crate::solve::path::linear_start::{Start, walk};

    /// `B Bᵀ` and a part of the identity, so that no two columns are alike: definite, of a condition
    /// about 1e4 at the least part.
    fn definite(rng: &mut fastrand::Rng, n: usize, least: f64) -> Vec<f64> {
        let b: Vec<f64> = (0..n * n).map(|_| rng.f64() - 0.5).collect();
        let entry = |i: usize, j: usize| -> f64 {
            let product: f64 = (0..n).map(|k| b[i + n * k] * b[j + n * k]).sum();
            product + if i == j { least * n as f64 } else { 0.0 }
        };
        (0..n * n).map(|k| entry((k % n).max(k / n), (k % n).min(k / n))).collect()
    }

    /// Theorem H: the path from a sure start arrives, without the swept one and without a second try.
    #[test]
    fn the_sure_start_arrives_whatever_the_coefficients() {
        for seed in 0..400 {
            let mut rng = fastrand::Rng::with_seed(seed);
            let pairs = rng.usize(1..=16);
            let mut vector = |n: usize, size: f64| -> Vec<f64> {
                (0..n).map(|_| size * (2.0 * rng.f64() - 1.0)).collect()
            };
            let (load, gap, slip) =
                (vector(2 * pairs, 1.0), vector(pairs, 0.5), vector(pairs, 0.5));
            let least = [1e-1, 1e-3][seed as usize % 2];
            let stiffness = definite(&mut rng, 2 * pairs, least);
            let mu: Vec<f64> = (0..pairs).map(|_| 10.0 * rng.f64()).collect();
            let of_pairs = (&gap[..], FrictionLaw::Coulomb(&mu), Some(&slip[..]));
            let problem = ContactProblem::of_test(2, (&stiffness, &load), of_pairs);
            let (contact, settings) = (Contact::new(&problem), Settings::default());
            let monitor = Monitor::new(&settings, None);
            let attempt = [walk(30, Start::Sure, 10.0)];
            let candidate = solve(&Call::new(&contact, &settings, &monitor), &attempt);
            let holds = candidate.certificate(&contact).holds(settings.tolerance);
            assert!(holds, "seed {seed}: {:?}", candidate.ending);
        }
    }

    /// A chain of pairs, each tied to the next by strong springs, lies on a rough floor whose gaps are random: sweeps
    /// alone do not find the states. What the walks on the pairs in question end with is a solution of the whole
    /// chain, by the certificate, which knows nothing of pairs in question.
    #[test]
    fn pairs_in_question_end_with_a_solution_of_all() {
        let (pairs, chains) = (60, 100);
        let n = 2 * pairs;
        let mut stiffness = vec![0.0; n * n];
        for i in 0..n {
            stiffness[i + n * i] = 0.1;
        }
        for i in 2..n {
            let j = i - 2;
            for (at, spring) in
                [(i + n * i, 10.0), (j + n * j, 10.0), (i + n * j, -10.0), (j + n * i, -10.0)]
            {
                stiffness[at] += spring;
            }
        }
        let mut settled = 0;
        for seed in 0..chains {
            let mut rng = fastrand::Rng::with_seed(seed);
            let mut vector = |n: usize, size: f64| -> Vec<f64> {
                (0..n).map(|_| size * (2.0 * rng.f64() - 1.0)).collect()
            };
            let (load, gap, slip) = (vector(n, 1.0), vector(pairs, 0.3), vector(pairs, 0.3));
            let mu: Vec<f64> = vector(pairs, 3.0).iter().map(|mu| mu.abs()).collect();
            let of_pairs = (&gap[..], FrictionLaw::Coulomb(&mu), Some(&slip[..]));
            let problem = ContactProblem::of_test(2, (&stiffness, &load), of_pairs);
            let (contact, settings) = (Contact::new(&problem), Settings::default());
            let monitor = Monitor::new(&settings, None);
            let call = Call::new(&contact, &settings, &monitor);
            if let Ok(candidate) = on_uncertain_pairs(&call) {
                assert!(candidate.is_settled(&contact, settings.tolerance), "seed {seed}");
                settled += 1;
            }
        }
        // The whole path is there for the others: chains with more than the allowed part in question.
        assert!(2 * settled > chains, "{settled} of {chains}");
    }
}
