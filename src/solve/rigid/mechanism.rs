//! The motion with which bodies escape where no equilibrium exists: one that can be drawn.
//!
//! The motion that proves it lifts each slipping pair by `mu` times its slip; nothing moves so. A body moves
//! as its mass or a viscosity lets it, and friction opposes the slip. Here the rigid motions `r` meet a
//! viscosity in each component of a pair, of the size of its unit `k`, and every pair that has an obstacle
//! touches it:
//!
//! ```text
//! K r = 0,   (k r - f - F) . s = 0 for all rigid motions s,   (r, F) obeys the law with no gap and no slip
//! ```
//!
//! A viscosity moves where, and only where, the forces of the law balance no rigid motion. With the
//! projection `P` on the rigid motions, in components times the roots of their units, `r` is the limit `c -> inf`
//! of the solutions for the definite stiffness `P + c (1 - P)`. The force that keeps the motion rigid
//! is carried over from one solution to the next, so that a moderate `c` reaches the limit (the method of
//! multipliers: M. R. Hestenes, J. Optim. Theory Appl. 4 (1969) 303-320).

use super::equilibrium::Balance;
use super::motions::RigidMotions;
use crate::error::{Error, index};
use crate::law::Contact;
use crate::linalg::matrix::Matrix;
use crate::linalg::tolerances::MOVING;
use crate::linalg::vector::{dot, normalise};
use crate::monitor::Watch;
use crate::problem::{ContactProblem, Relation, Stiffness};
use crate::settings::Settings;
use crate::solve::result::{CAUSES, Call, Escape, NO_EQUILIBRIUM, Solution, Solve, Status};

/// Stiffness against strains beside the viscosity: a solution leaves this part of a strain, which the next
/// one takes away, and the condition number stays far from rounding. Forces that pairs share on one line are strains that hardly
/// move anything: with 1e4 thirty solutions were too few for 138 of 4,300 motions, with 1e7 for 14.
const STIFFER: f64 = 1e7;

/// Most solutions: two are usual, and ten were needed where few pairs hold a motion that all resist.
const ROUNDS: usize = 30;

/// The strain that is left, relative to the motion: too little to be seen, and taken away at last.
const RIGID: f64 = 1e-10;

/// Gives a solution that has no equilibrium its motion of escape, sharpens the one that proves it, and says in
/// the message what moves. `solve` finds the motion; `None`: that of the proof stands for it.
pub fn describe<'c, R: Relation>(
    contact: &'c Contact<'c, R>,
    solution: &mut Solution,
    balance: Option<Balance<'c, R>>,
    solve: Option<Solve>,
    monitor: &'c dyn Watch,
) -> Result<(), Error> {
    let Some(proof) = solution.recession.take() else { return Ok(()) };
    // If others are not found in time, the motion of the proof stands for all, as it is.
    let alone =
        || Balance::of(contact, RigidMotions::along(contact.problem(), &proof), monitor, |_| false);
    let balance = balance.unwrap_or_else(alone);
    let mut proof = balance.sharpened(proof);
    normalise(&mut proof);
    let found = solve.map(|solve| balance.viscous(solve, monitor)).transpose()?.flatten();
    let escape = found.unwrap_or_else(|| balance.along(&proof));
    solution.recession = Some(proof);
    let moves = in_words(contact, &escape);
    solution.message = format!("{NO_EQUILIBRIUM}: {moves}; {CAUSES}").into();
    solution.escape = Some(escape);
    Ok(())
}

/// Gives a problem that no method solves the rigid motion along which its bodies move away as springs are let go, and
/// says so in the message. With Coulomb's law that does not prove that there is no equilibrium.
pub fn describe_run_away(contact: &Contact<'_>, solution: &mut Solution, motion: Vec<f64>) {
    let motions = RigidMotions::along(contact.problem(), &motion);
    let escape = motions.escape(motion);
    let moves = in_words(contact, &escape);
    solution.say(&format!(
        "without supports the bodies move away along the motion of escape: {moves}; forces that balance the loads are \
         not excluded, so that there may be an equilibrium; {CAUSES}"
    ));
    solution.escape = Some(escape);
}

impl RigidMotions {
    /// `P + c (1 - P)` in the units of the problem, column-major.
    fn stiffness(&self) -> Vec<f64> {
        let n = self.root.len();
        let mut matrix = vec![0.0; n * n];
        for (j, column) in matrix.chunks_exact_mut(n).enumerate() {
            column[j] = STIFFER * self.root[j] * self.root[j];
            for v in &self.basis {
                let own = v[j] * self.root[j];
                let entries = column.iter_mut().zip(v.iter().zip(&self.root));
                entries.for_each(|(k, (v, root))| *k += (1.0 - STIFFER) * (own * (v * root)));
            }
        }
        matrix
    }

    /// The escape with a rigid motion: what moves the viscosity is not balanced.
    fn escape(&self, mut motion: Vec<f64>) -> Escape {
        let unbalanced = motion.iter().zip(&self.root).map(|(r, root)| r * root * root).collect();
        normalise(&mut motion);
        Escape { motion, unbalanced }
    }
}

impl<R: Relation> Balance<'_, R> {
    /// The motion of escape against the viscosity; `None` if a solution was not found.
    fn viscous(&self, solve: Solve, monitor: &dyn Watch) -> Result<Option<Escape>, Error> {
        let problem = self.contact.problem();
        let (matrix, gap) = (self.motions.stiffness(), self.contact.touching_gaps());
        let settings = Settings::default();
        let mut load = problem.relation().load().to_vec();
        let matrix = Matrix::new(load.len(), &matrix, load.len().max(1));
        let mut d: Option<Vec<f64>> = None;
        for _ in 0..ROUNDS {
            let relation = Stiffness::new(matrix, &load, problem.dim());
            let law = problem.law();
            let viscous = ContactProblem::with_relation(relation, problem.dim(), &gap, law, None)?;
            let contact = &Contact::new(&viscous);
            let call = Call { start: d.as_deref(), ..Call::new(contact, &settings, monitor) };
            let solution = solve(&call)?;
            if solution.status != Status::Solved {
                return Ok(None);
            }
            let rigid = self.motions.part(&solution.d);
            let mut most = 0.0;
            for (i, (d, rigid)) in solution.d.iter().zip(&rigid).enumerate() {
                let strain = (d - rigid) * self.motions.root[i];
                load[i] -= STIFFER * strain * self.motions.root[i];
                most = strain.abs().max(most);
            }
            if most <= RIGID * self.motions.size(&rigid) {
                return Ok(Some(self.motions.escape(rigid)));
            }
            d = Some(solution.d);
        }
        Ok(None)
    }

    /// The escape along the motion of a proof, as fast as the loads drive it.
    fn along(&self, proof: &[f64]) -> Escape {
        let work = dot(self.contact.load_with_tension(), proof);
        let scaled = self.motions.scaled(proof);
        let speed = work / dot(&scaled, &scaled);
        self.motions.escape(proof.iter().map(|r| speed * r).collect())
    }
}

/// Which pairs move, how, and what drives them.
fn in_words<R: Relation>(
    contact: &Contact<'_, R>,
    Escape { motion, unbalanced }: &Escape,
) -> String {
    let dim = contact.dim();
    let most = (0..motion.len()).max_by(|&a, &b| motion[a].abs().total_cmp(&motion[b].abs()));
    let most = most.unwrap_or(0);
    let moving = motion.chunks_exact(dim).filter(|r| r.iter().any(|r| r.abs() > MOVING)).count();
    let (pair, component) = (most / dim, most % dim);
    let direction = contact.pairs()[pair].direction(component, motion[most]);
    format!(
        "it moves {moving} of {} pairs, most of all pair {}, {direction}; the resultant of the loads along it is \
         {:.3e} (largest component 1), and contact leaves {:.3e} of it unbalanced",
        contact.problem().host_pairs(),
        index(contact.problem().host_pair(pair)),
        dot(contact.load_with_tension(), motion),
        dot(unbalanced, motion),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::monitor::{Monitor, unwatched};
    use crate::problem::FrictionLaw;
    use crate::solve::solve;

    /// A body of two pairs that a spring ties along each direction and nothing holds, under whole-numbered loads.
    fn of_two_pairs<T>(work: impl FnOnce(&ContactProblem<'_>) -> T) -> T {
        let k = [
            [2.0, 0.0, -2.0, 0.0],
            [0.0, 8.0, 0.0, -8.0],
            [-2.0, 0.0, 2.0, 0.0],
            [0.0, -8.0, 0.0, 8.0],
        ];
        let of_pairs = (&[0.0; 2][..], FrictionLaw::Coulomb(&[0.5; 2]), None);
        let load = [-1.0, 3.0, -5.0, 2.0];
        work(&ContactProblem::of_test(2, (k.as_flattened(), &load), of_pairs))
    }

    /// The escape along a motion `p` has the largest component 1, and is as fast as the loads drive it against the viscosity,
    /// a speed of `f . p / sum k p²`, so that the forces of the viscosity do the work of the loads along `p`.
    #[test]
    fn an_escape_along_a_motion_has_the_work_of_the_loads() {
        of_two_pairs(|problem| {
            let contact = Contact::new(problem);
            for length in [1.0, 4.0] {
                let proof = [-1.0, 2.0, -1.0, 2.0].map(|r| r * length);
                let motions = RigidMotions::along(problem, &proof);
                let balance = Balance::of(&contact, motions, unwatched(), |_| true);
                let Escape { motion, unbalanced } = balance.along(&proof);
                // f . p = 1 + 6 + 5 + 4 = 16 and sum k p² = 2 + 32 + 2 + 32 = 68, in units of length 1.
                let exact = [2.0, 8.0, 2.0, 8.0].map(|k| 16.0 / 68.0 * k);
                let sizes = [-1.0, 2.0, -1.0, 2.0];
                for i in 0..4 {
                    // Ten roundings of numbers below 4.
                    assert!((motion[i] - sizes[i] / 2.0).abs() <= 1e-14, "{motion:?}");
                    assert!((unbalanced[i] - exact[i] * sizes[i]).abs() <= 1e-14, "{unbalanced:?}");
                }
            }
        });
    }

    /// A run-away tells its motion, in words too, and does not change the status.
    #[test]
    fn a_run_away_is_told() {
        of_two_pairs(|problem| {
            let (contact, settings) = (Contact::new(problem), Settings::default());
            let monitor = &mut Monitor::new(&settings, None);
            let mut solution = solve(problem, &settings, None, monitor).expect("the settings fit");
            let before = solution.status;
            solution.escape = None;
            describe_run_away(&contact, &mut solution, vec![-3.0, 6.0, -3.0, 6.0]);
            assert_eq!(solution.status, before);
            let escape = solution.escape.expect("a motion");
            let expected = [-0.5, 1.0, -0.5, 1.0];
            let far = |(a, b): (&f64, f64)| (a - b).abs() > 1e-14;
            assert!(!escape.motion.iter().zip(expected).any(far), "{:?}", escape.motion);
            assert!(solution.message.contains("it moves 2 of 2 pairs"), "{}", solution.message);
        });
    }
}
