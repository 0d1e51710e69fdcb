//! The proof, on request, that a solution exists where a method has found one.

use crate::certificate::{errors, measure, prove_parts};
use crate::solve::result::{Call, Errors, Existence, Solution, Status};

/// Tries to prove that there is a solution with the states of this one. If there is, the result becomes the
/// middle of its enclosure.
pub fn examine(call: &Call<'_>, solution: &mut Solution) {
    let contact = call.contact;
    solution.existence = Existence::NotProved;
    if solution.status != Status::Solved {
        return;
    }
    let parts = (solution.d.as_slice(), solution.d_low.as_slice());
    let states = &solution.certificate.states;
    let proof = prove_parts(contact, parts, states, &mut call.monitor.asking());
    let Some(proof) = proof else { return };
    // The displacements become those of the proof, unless their certificate, which rounds, does not agree.
    let tolerance = call.settings.tolerance;
    let certificate = measure(contact, (&proof.d, &proof.d_low), &[]).with_rounding(tolerance);
    let same = certificate.states == solution.certificate.states;
    if certificate.holds(tolerance) && same {
        solution.d.clone_from(&proof.d);
        solution.d_low.clone_from(&proof.d_low);
        solution.certificate = certificate;
    }
    let force = &solution.certificate.force;
    let (d_radius, radius) = (proof.radius_about(&solution.d), proof.force_radius_about(force));
    let load = contact.problem().load();
    let [d, force] = errors(load, (&solution.d, &d_radius), (force, &radius));
    solution.errors = Some(Errors { d, force });
    solution.existence = Existence::Proved(Box::new(proof));
}
