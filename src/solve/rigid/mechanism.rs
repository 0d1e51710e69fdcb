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
use crate::linalg::tolerances::MOVING;
use crate::linalg::vector::{dot, normalise};
use crate::monitor::Monitor;
use crate::problem::{ContactData, ContactProblem, Relation, Stiffness};
use crate::settings::Settings;
use crate::solve::result::{CAUSES, Call, Escape, NO_EQUILIBRIUM, Solution, Solve, Status};

/// Stiffness against strains beside the viscosity: a solution leaves this part of a strain, which the next
/// one takes away, and the condition number stays far from rounding.
const STIFFER: f64 = 1e4;

/// Most solutions: three are usual, and ten were needed where few pairs hold a motion that all resist.
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
    monitor: &mut Monitor<'_>,
) -> Result<(), Error> {
    let Some(proof) = solution.recession.take() else { return Ok(()) };
    let mut proof = match &balance {
        Some(balance) => balance.sharpened(proof),
        None => proof,
    };
    normalise(&mut proof);
    // If others are not found in time, the motion of the proof stands for all.
    let alone = || RigidMotions::along(contact.problem(), &proof);
    let motions = balance.map_or_else(alone, Balance::into_motions);
    let viscous = Viscous { contact, motions };
    let found = solve.map(|solve| viscous.escape(solve, monitor)).transpose()?.flatten();
    let escape = found.unwrap_or_else(|| viscous.along(&proof));
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
    let escape = Viscous { contact, motions }.with_motion(motion);
    let moves = in_words(contact, &escape);
    solution.say(&format!(
        "without supports the bodies move away along the motion of escape: {moves}; forces that balance the loads are \
         not excluded, so that there may be an equilibrium; {CAUSES}"
    ));
    solution.escape = Some(escape);
}

/// Rigid motions against a viscosity.
struct Viscous<'c, R = Stiffness<'c>> {
    contact: &'c Contact<'c, R>,
    motions: RigidMotions,
}

impl<R: Relation> Viscous<'_, R> {
    /// `P + c (1 - P)` in the units of the problem, column-major.
    fn stiffness(&self) -> Vec<f64> {
        let n = self.motions.root.len();
        let mut matrix = vec![0.0; n * n];
        for (j, column) in matrix.chunks_exact_mut(n).enumerate() {
            column[j] = STIFFER * self.motions.root[j] * self.motions.root[j];
            for v in &self.motions.basis {
                let own = v[j] * self.motions.root[j];
                let entries = column.iter_mut().zip(v.iter().zip(&self.motions.root));
                entries.for_each(|(k, (v, root))| *k += (1.0 - STIFFER) * (own * (v * root)));
            }
        }
        matrix
    }

    /// The motion of escape; `None` if a solution was not found.
    fn escape(&self, solve: Solve, monitor: &mut Monitor<'_>) -> Result<Option<Escape>, Error> {
        let problem = self.contact.problem();
        let (matrix, gap) = (self.stiffness(), self.contact.touching_gaps());
        let settings = Settings::default();
        let mut load = problem.relation().load().to_vec();
        let mut d: Option<Vec<f64>> = None;
        for _ in 0..ROUNDS {
            let viscous = ContactProblem::on_checked_matrix(ContactData {
                dim: problem.dim(),
                pairs: problem.pairs(),
                stiffness: &matrix,
                ld: load.len().max(1),
                load: &load,
                gap: &gap,
                law: problem.law(),
                reference_slip: None,
            })?;
            let solution = solve(
                &Call {
                    contact: &Contact::new(&viscous),
                    settings: &settings,
                    start: d.as_deref(),
                },
                monitor,
            )?;
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
            let size = rigid.iter().zip(&self.motions.root).map(|(r, root)| (r * root).abs());
            if most <= RIGID * size.fold(0.0, f64::max) {
                return Ok(Some(self.with_motion(rigid)));
            }
            d = Some(solution.d);
        }
        Ok(None)
    }

    /// The escape with a rigid motion: what moves the viscosity is not balanced.
    fn with_motion(&self, mut motion: Vec<f64>) -> Escape {
        let unbalanced =
            motion.iter().zip(&self.motions.root).map(|(r, root)| r * root * root).collect();
        normalise(&mut motion);
        Escape { motion, unbalanced }
    }

    /// The escape along the motion of a proof, as fast as the loads drive it.
    fn along(&self, proof: &[f64]) -> Escape {
        let work = dot(self.contact.load_with_tension(), proof);
        let scaled = self.motions.scaled(proof);
        let speed = work / dot(&scaled, &scaled);
        self.with_motion(proof.iter().map(|r| speed * r).collect())
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
