//! Springs that are let go: bodies that contact alone holds.
//!
//! `K` is symmetric and positive semi-definite, `D` the diagonal of `K` (the unit of a component that nothing resists).
//! With springs of the stiffness `s D` that hold every component at zero, the contact problem has the relation
//!
//! ```text
//! (K + s D) d = f + F                                                    (S)
//! ```
//!
//! with the host's gaps, reference slips and law. It is definite, so that theorems A and B of `path` give a solution
//! for each `s > 0`, and a path to it. From `s = 1` the springs are let go on a logarithmic scale, each problem started
//! from the solution of the one before: a curved body on few pairs is held by its geometry, and changes its states
//! where `s` is `1e-3` to `1e-8`. Newton's method on `K` itself is tried on the way.
//!
//! # What is proved
//!
//! Let `v = d - (gap, slip0)`, `P = -F`, `r = f - (K + s D) (gap, slip0)`, and `e` be the least eigenvalue of `D`. By
//! (W) of `path`, `v.P = sum g |delta| >= 0`, where `g` is the bound of friction and `delta` the slip; a tension of
//! pairs counts as a load.
//!
//! **Theorem T1.** Let `s` fall to zero along a sequence on which `d_s` stays bounded. Each limit point of `d_s` solves
//! the problem with `K` alone.
//!
//! *Proof.* `d_s` solves the problem with the load `f - s D d_s`, so that its `F_s = K d_s - f + s D d_s` converges with
//! it, along a subsequence, to `K d - f`. The law is a closed graph: its natural map is continuous. ∎
//!
//! If the limit has strict states and a regular system there, the states are those of the limit for all small `s`, and
//! Newton's method on `K` ends from `d_s`. So `s` need not become zero.
//!
//! **Theorem T2.** `s e |v| <= |r|`, `v.K v <= |r| |v|` and `sum g |delta| <= |r| |v|`: displacements grow like `1/s` at
//! most.
//!
//! *Proof.* (S) multiplied by `v`: `v.K v + s v.D v + sum g |delta| = r.v`. ∎
//!
//! **Theorem T3.** Let `|d_s|` grow without end along a sequence on which `s d_s` tends to `q`. Then `K q = 0`, `q_n <= 0`
//! at each pair that has an obstacle, and if `q` is not zero
//!
//! ```text
//! f.q = q.D q + sum g* |q_t| > 0,      over the pairs with q_n = 0 and q_t ≠ 0, g* = lim g                    (1)
//! ```
//!
//! `q` is the motion with which the bodies escape against the viscosity `D`. If `q` is zero, the limit `r` of `v / |v|`
//! has `K r = 0`, `r_n <= 0`, and `f.r = lim sum g |r_t|`: the loads are marginal. In the plane that does not occur.
//!
//! *Proof.* `q.K q = lim s² v.K v <= lim s² |r| |v| = 0`. `v_n <= 0` gives `q_n <= 0`. For a rigid motion `m`, (S) says
//! `s m.D d = m.f + m.F`; let `m = q`. Pairs with `q_n < 0` are open at last. Those with `q_n = 0`, `q_t ≠ 0` slip along
//! `q_t` at last: `F.q = -sum g |q_t|`, where `g` is bounded by T2, as `|delta|` grows like `|q_t| / s`. With `q = 0` the
//! same for `m = r`, where `s |v|` tends to zero. In the plane `d_s` is a rational function of `s` as long as the states
//! are the same. There are finitely many, so that `d_s` has a Laurent series at zero, whose pole is simple by T2. ∎
//!
//! **Theorem T4.** Without friction, and with given bounds of friction (Tresca), let `d°` be a solution for `K`. Then
//! `|d_s|_D <= |d°|_D` for all `s`, and `d_s` tends to the smallest solution in that norm. So a run-away proves that there is
//! none, and by (1) `q` passes as the proof ([`crate::certificate::is_escape`]).
//!
//! *Proof.* The problem minimises a convex energy `E`. `E(d_s) + s |d_s|²/2 <= E(d°) + s |d°|²/2`, and
//! `E(d°) <= E(d_s)`. ∎
//!
//! **T5, a counterexample.** With Coulomb's law a run-away proves nothing: there are problems of three pairs in the
//! plane that have a solution, while the springs run away from it (the test below has one in whole numbers). So the
//! run-away is told as what it is. What proves that
//! there is no equilibrium is a rigid motion `m` with `m_n + mu |m_t| <= 0` and `f.m > 0`, for which
//! [`crate::solve::rigid`] looks before.
//! Nothing sharper follows from (1): with forces of the cones that balance the loads on all rigid motions, `-F.q = f.q`
//! holds identically.

use crate::law::Contact;
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::norm_of;
use crate::monitor::Stop;
use crate::settings::Settings;
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::{newton, path};

/// By how much `s` falls from one problem to the next, first and at most. Where Newton's method fails it falls by the
/// root of that, and below two the path takes the place of Newton's method.
const FACTOR: f64 = 30.0;
const MOST_FACTOR: f64 = 1e4;

/// Systems with which Newton's method counts as quick: `s` then falls by this power of the factor before.
const QUICK: u64 = 4;
const FASTER: f64 = 1.5;

/// Most systems of Newton's method on a problem with springs, and on `K` alone.
const MOST_SYSTEMS: u64 = 25;
const MOST_WITHOUT_SPRINGS: u64 = 6;

/// Least tolerance of problems with springs: each is a start alone, and rounding hides more where displacements have
/// grown.
const ROUGH: f64 = 1e-8;

/// Change of the displacements, relative to them, below which Newton's method on `K` is tried.
const SETTLING: f64 = 0.5;

/// Displacements beside those with the first springs which show a run-away, together with a change of `s d` by
/// less than a part of it. Bodies that end on far obstacles have moved up to `2e8` times as far (measured).
const AWAY: f64 = 1e8;
const STEADY: f64 = 1e-2;

/// Springs of this part of the stiffness are no more than its rounding.
const LEAST: f64 = 1e-13;

/// Lets the springs go. Ends with a solution for `K`, with [`Ending::RunsAway`] and the motion `q` of T3, or because it
/// finds neither: `by_path` says if the path goes on where Newton's method fails on a problem with springs.
pub fn let_go(call: &Call<'_>, by_path: bool) -> Candidate {
    let (contact, d) = (call.contact, call.start_or_zero());
    let units = (0..d.len()).map(|i| contact.problem().unit(i)).collect();
    let mut springs = Springs { call, by_path, units, d, systems: 0 };
    let found = springs.let_go();
    let effort = Effort::of_systems(springs.systems);
    let candidate = |ending| Candidate::of_displacements(contact, springs.d, ending);
    found.unwrap_or_else(candidate).with_effort(effort)
}

/// A problem with springs, and what is solved of it.
struct Springs<'c> {
    call: &'c Call<'c>,
    /// True if the path goes on where Newton's method fails.
    by_path: bool,
    /// `D`.
    units: Vec<f64>,
    /// The solution with the springs of the last problem.
    d: Vec<f64>,
    /// Linear systems so far.
    systems: u64,
}

impl Springs<'_> {
    /// A solution for `K`, or how the springs end without one.
    fn let_go(&mut self) -> Result<Candidate, Ending> {
        let (mut s, mut factor) = (1.0, FACTOR);
        self.d = self.held(s, true)?;
        let (away, mut is_steady) = (AWAY * self.length(|i| self.d[i]), false);
        while s > LEAST {
            let before = self.systems;
            let (next, d) = match self.next(s, &mut factor) {
                // Rounding ends what has moved away as far as it can be seen.
                Err(ending) if is_steady && !ends_the_call(&ending) => {
                    return Err(self.runs_away(s));
                }
                found => found?,
            };
            if self.systems - before <= QUICK {
                factor = factor.powf(FASTER).min(MOST_FACTOR);
            }
            let size = self.length(|i| d[i]);
            let change = self.length(|i| d[i] - self.d[i]);
            let turn = self.length(|i| next * d[i] - s * self.d[i]);
            (s, self.d) = (next, d);
            if change <= SETTLING * size || s <= LEAST {
                let candidate = self.without_springs()?;
                if candidate.is_settled(self.call.contact, self.call.settings.tolerance) {
                    return Ok(candidate);
                }
            }
            is_steady = turn <= STEADY * s * size;
            if size > away && is_steady {
                return Err(self.runs_away(s));
            }
        }
        Err(Ending::Stalled("the displacements do not settle as springs are let go"))
    }

    /// The end of bodies that move by `d` with springs `s`.
    fn runs_away(&self, s: f64) -> Ending {
        Ending::RunsAway(self.d.iter().map(|d| s * d).collect())
    }

    /// The next problem that is solved after that with springs `s`: its springs, and its solution.
    fn next(&mut self, s: f64, factor: &mut f64) -> Result<(f64, Vec<f64>), Ending> {
        loop {
            let next = s / *factor;
            let is_last = *factor < 2.0;
            match self.held(next, is_last) {
                Ok(d) => return Ok((next, d)),
                Err(ending) if is_last || ends_the_call(&ending) => return Err(ending),
                Err(_) => *factor = factor.sqrt(),
            }
        }
    }

    /// The solution with springs `s`, by Newton's method from the last one; where that fails, and it is the `last` try, by
    /// the path.
    fn held(&mut self, s: f64, is_last: bool) -> Result<Vec<f64>, Ending> {
        let n = self.units.len();
        let stiffness = self.stiffness(s);
        let problem = self.call.contact.problem();
        let (load, slips) = (problem.load(), problem.reference_slips());
        let problem = problem.with_numbers(Matrix::new(n, &stiffness, n), load, slips);
        let contact = Contact::new(&problem);
        let tolerance = self.call.settings.tolerance.max(ROUGH);
        let settings = Settings { tolerance, ..self.call.settings.clone() };
        let call = Call::new(&contact, &settings, self.call.monitor);
        let mut candidate = self.newton(call, MOST_SYSTEMS)?;
        if is_last && self.by_path && !candidate.certificate(&contact).holds(tolerance) {
            let walk = if contact.dim() == 2 { path::linear } else { path::curved };
            candidate = walk(&call.from(candidate.d()));
            self.systems += candidate.effort.factorisations;
        }
        match candidate.certificate(&contact).holds(tolerance) {
            true => Ok(candidate.d().to_vec()),
            false => Err(candidate.ending),
        }
    }

    /// Newton's method on `K` alone, from the last solution.
    fn without_springs(&mut self) -> Result<Candidate, Ending> {
        let mut candidate = self.newton(*self.call, MOST_WITHOUT_SPRINGS)?;
        newton::refine_to_tolerance(self.call, &mut candidate);
        Ok(candidate)
    }

    /// Newton's method on a problem with at most so many systems, from the last solution. `Err`: the call is
    /// stopped.
    fn newton(&mut self, call: Call<'_>, most: u64) -> Result<Candidate, Ending> {
        let (mut candidate, used_up) =
            call.monitor.within(most, || newton::newton(&call.from(&self.d)));
        self.systems += candidate.effort.factorisations;
        if let Ending::Stopped(stop) = candidate.ending {
            if stop != Stop::IterationLimit || used_up {
                return Err(Ending::Stopped(stop));
            }
            candidate.ending = Ending::Stalled("Newton's method does not converge");
        }
        Ok(candidate)
    }

    /// `K + s D`, column-major.
    fn stiffness(&self, s: f64) -> Vec<f64> {
        let n = self.units.len();
        let columns = (0..n).flat_map(|j| &self.call.contact.problem().column(j)[..n]);
        let mut stiffness: Vec<f64> = columns.copied().collect();
        let diagonal = stiffness.iter_mut().step_by(n + 1);
        diagonal.zip(&self.units).for_each(|(k, unit)| *k += s * unit);
        stiffness
    }

    /// The length of displacements in the norm of `D`.
    fn length(&self, d: impl Fn(usize) -> f64) -> f64 {
        norm_of(self.units.iter().enumerate().map(|(i, unit)| unit.sqrt() * d(i)))
    }
}

/// True if nothing is tried after that: there is no time, or a function of the host has failed.
fn ends_the_call(ending: &Ending) -> bool {
    matches!(ending, Ending::Stopped(_) | Ending::Failed(_))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::Monitor;
    use crate::problem::{ContactProblem, FrictionLaw};
    use crate::solve::result::Existence;
    use crate::solve::solve;

    /// The counterexample of T5, with `mu = 2`. `d = (0, 0, -1, 1, 0, 0) / 5` solves it with
    /// `F = (-8, 14, 0, 0, -7, 5) / 5`: the second pair is open, the others stick. The springs run away along
    /// `q = (-2, -4, 0, -2, 0, 0) / 11`: `K q = 0`, and (1) holds as `f.q = q.D q = 8/11`.
    #[test]
    fn springs_run_away_from_a_solution() {
        let stiffness = [
            [5.0, -1.0, 0.0, -3.0, -2.0, 0.0],
            [-1.0, 2.0, -2.0, -3.0, 2.0, 0.0],
            [0.0, -2.0, 4.0, 4.0, 0.0, 0.0],
            [-3.0, -3.0, 4.0, 9.0, -2.0, 0.0],
            [-2.0, 2.0, 0.0, -2.0, 4.0, 0.0],
            [0.0; 6],
        ];
        let load = [1.0, -3.0, 0.0, 1.0, 1.0, -1.0];
        let of_pairs = (&[0.0; 3][..], FrictionLaw::Coulomb(&[2.0; 3]), None);
        let problem = ContactProblem::of_test(2, (stiffness.as_flattened(), &load), of_pairs);
        let settings = Settings { proof: true, ..Settings::default() };
        let mut monitor = Monitor::new(&settings, None);
        let contact = Contact::new(&problem);
        let ending = let_go(&Call::new(&contact, &settings, &monitor), true).ending;
        let Ending::RunsAway(motion) = ending else { panic!("the springs end otherwise") };
        // `s d - q` is of the size of `s`, which is less than 1e-8 here.
        for (q, exact) in motion.iter().zip([-2.0, -4.0, 0.0, -2.0, 0.0, 0.0]) {
            assert!((q - exact / 11.0).abs() <= 1e-6, "{motion:?}");
        }
        let solution = solve(&problem, &settings, None, &mut monitor).expect("the settings fit");
        assert!(matches!(solution.existence, Existence::Proved(_)), "{}", solution.message);
        // The tolerance is 1e-10.
        let force = &solution.certificate.force;
        for (force, exact) in force.iter().zip([-8.0, 14.0, 0.0, 0.0, -7.0, 5.0]) {
            assert!((force - exact / 5.0).abs() <= 1e-8, "{force:?}");
        }
    }
}
