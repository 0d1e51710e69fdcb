//! The proof, from displacements and states to radii.

use super::enclosure::enclose;
use super::system::{Centre, System};
use crate::law::{Contact, EnclosedPiece, State};
use crate::linalg::ball::{Ball, BallVector, sum_up};
use crate::linalg::vector::{first_not_finite, norm_inf};
use crate::linalg::watched::GoesOn;
use crate::problem::ContactProblem;

/// A solution that is proved to exist: its displacements and forces up to radii that bound every component.
#[derive(Clone, Debug)]
pub struct Proof {
    /// Displacements of the solution, rounded.
    pub d: Vec<f64>,
    /// The part of them that rounding has left out.
    pub d_low: Vec<f64>,
    /// Largest distance of each displacement of the solution to `d + d_low`, a length.
    pub d_radius: Vec<f64>,
    /// Contact forces of the solution, rounded.
    pub force: Vec<f64>,
    /// Largest distance of each contact force of the solution to `force`, a force.
    pub force_radius: Vec<f64>,
}

impl Proof {
    /// Largest distances of the solution's displacements to the displacements `d`.
    pub fn radius_about(&self, d: &[f64]) -> Vec<f64> {
        let parts = self.d.iter().zip(&self.d_low).zip(&self.d_radius);
        parts
            .zip(d)
            .map(|(((own, low), radius), d)| {
                (Ball::exact(*own) - Ball::exact(*d) + Ball::exact(*low)).widened(*radius).size()
            })
            .collect()
    }

    /// Largest distances of the solution's forces to the forces `force`.
    pub fn force_radius_about(&self, force: &[f64]) -> Vec<f64> {
        let parts = self.force.iter().zip(&self.force_radius).zip(force);
        parts.map(|((own, radius), force)| Ball::new(*own, *radius).distance_to(*force)).collect()
    }
}

/// Tries to prove that the problem has a solution next to the displacements `d` with the states `states`:
/// `None` if it is not proved. A frictionless pair that touches has the state [`State::Slip`].
///
/// # Panics
/// If `d` or `states` have not as many entries as the problem has unknowns and pairs.
pub fn prove(problem: &ContactProblem<'_>, d: &[f64], states: &[State]) -> Option<Proof> {
    prove_parts(&Contact::new(problem), (d, &vec![0.0; d.len()]), states, &mut || true)
}

/// [`prove`] of displacements `d + low` in two parts, on a problem whose laws are worked out. Nothing is proved where
/// `goes_on` says no.
pub(crate) fn prove_parts(
    contact: &Contact<'_>,
    (d, low): (&[f64], &[f64]),
    states: &[State],
    goes_on: GoesOn<'_>,
) -> Option<Proof> {
    assert_eq!((d.len(), states.len()), (contact.unknowns(), contact.pairs().len()));
    if first_not_finite(d).is_some() || first_not_finite(low).is_some() {
        return None;
    }
    let v = contact.beyond_reference(d, low);
    let force = contact.problem().force_of_parts(d, low);
    let pieces = contact.each(&v, &force).zip(states);
    let pairs: Vec<EnclosedPiece> = pieces
        .map(|((law, v, force), state)| law.enclosed_piece(*state, v, force))
        .collect::<Option<_>>()?;
    let (mut centre, dim) = (Centre { d: d.to_vec(), low: low.to_vec(), force }, contact.dim());
    // What its piece holds is where that holds it.
    for (at, pair) in pairs.iter().enumerate() {
        for c in (0..dim).filter(|&c| !pair.moves(c)) {
            (centre.d[dim * at + c], centre.low[dim * at + c]) = (pair.held(c), 0.0);
        }
    }
    centre.force = contact.problem().force_of_parts(&centre.d, &centre.low);
    let system = System::new(contact, pairs, &centre);
    let mut solver = system.solver(goes_on)?;
    system.refine(&mut solver, &mut centre, goes_on);
    let enclosure = enclose(&system, &solver, &centre, goes_on)?;
    let of_parts = |part: fn(Ball) -> f64| -> Vec<f64> {
        let parts = |force: &BallVector| force[..dim].to_vec();
        enclosure.force.iter().flat_map(parts).map(part).collect()
    };
    let (force, force_radius) = (of_parts(Ball::middle), of_parts(Ball::radius));
    let Centre { d, low: d_low, .. } = centre;
    Some(Proof { d, d_low, d_radius: enclosure.d_radius, force, force_radius })
}

/// Bounds on the errors of an answer next to a solution, relative to the largest displacement, and to the
/// largest force or load.
pub(crate) fn errors(
    load: &[f64],
    (d, radius): (&[f64], &[f64]),
    forces: (&[f64], &[f64]),
) -> [f64; 2] {
    let part = |radius: &[f64], size: f64| match norm_inf(radius) {
        0.0 => 0.0,
        radius => sum_up(radius / size, 0.0),
    };
    [part(radius, norm_inf(d)), part(forces.1, norm_inf(forces.0).max(norm_inf(load)))]
}
