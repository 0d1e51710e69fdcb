//! The proof that a solution exists next to displacements from any origin.

use super::args::Arrays;
use super::condensed::CondensedArguments;
use super::guard::{self, Failure};
use super::report::{SIGNORINI_STATE_OPEN, SIGNORINI_STATE_SLIP, SIGNORINI_STATE_STICK};
use super::status::{SIGNORINI_STATUS_NOT_PROVED, SIGNORINI_STATUS_SOLVED, remember};
use crate::certificate::{certify, prove};
use crate::error::entry;
use crate::law::State;
use crate::problem::ContactProblem;
use crate::solve::memory;

/// Tries to prove that a condensed contact problem has a solution next to displacements of any
/// origin, say of another solver, and bounds how far it is away.
///
/// What is proved: K, f, gap, friction and slip0, each double taken for the real number that it
/// is, have a solution with these states, each pair clear of the boundaries of its state. All
/// rounding is bounded. It is not proved that there is no other solution.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param K         condensed stiffness, as for signorini_solve
/// @param ldk       entries from one column of K to the next, at least max(1, N)
/// @param f         condensed nodal loads, N
/// @param gap       initial gaps, one for each pair
/// @param law       SIGNORINI_LAW_..., the friction law of all pairs
/// @param friction  parameters of the law, pair by pair; may be NULL if frictionless
/// @param slip0     reference slip, dim - 1 for each pair; NULL: zero
/// @param d         relative displacements, N
/// @param state     SIGNORINI_STATE_... of each pair; NULL: those of d
/// @param F         out: contact forces of the solution, N; may be NULL
/// @param radius_d  out: the solution has displacements within this distance of d, component by
///                  component, N; length; may be NULL
/// @param radius_F  out: the same of the contact forces and F, N; force; may be NULL
/// @return 0: proved; SIGNORINI_STATUS_NOT_PROVED: not, which proves nothing: F holds zeros, the
///         radii -1; -k: the k-th argument is wrong, nothing was written
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_prove(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    d: *const f64,
    state: *const i32,
    F: *mut f64,
    radius_d: *mut f64,
    radius_F: *mut f64,
) -> i32 {
    const MEASURED: i32 = 10;
    let given = CondensedArguments { first: 1, dim, pairs, K, ldk, f, gap, law, friction, slip0 };
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths of the header.
        let (data, d, state) = unsafe {
            let data = given.read(&mut arrays)?;
            let d = arrays.required(MEASURED, "d", d, data.dim * data.pairs)?;
            (data, d, arrays.optional(11, "state", state, data.pairs)?)
        };
        let force = arrays.optional_output(12, "F", F, d.len())?;
        let radius_d = arrays.optional_output(13, "radius_d", radius_d, d.len())?;
        let radius_force = arrays.optional_output(14, "radius_F", radius_F, d.len())?;
        arrays.check_overlap()?;
        guard::reserve_estimate(memory(d.len()))?;
        let problem = ContactProblem::new(data).map_err(|error| {
            Failure::from_error(error, |argument| given.position(argument, MEASURED))
        })?;
        if let Some(i) = d.iter().position(|d| !d.is_finite()) {
            return Err(Failure::argument(MEASURED, entry("d", [i]) + " is not finite"));
        }
        let states = match state {
            Some(codes) => states(codes)?,
            None => certify(&problem, d).states,
        };
        let proof = prove(&problem, d, &states);
        let nothing = vec![NO_RADIUS; d.len()];
        let about_d = proof.as_ref().map_or(nothing.clone(), |proof| proof.radius_about(d));
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            force.write(proof.as_ref().map_or(&vec![0.0; d.len()], |proof| &proof.force));
            radius_d.write(&about_d);
            radius_force.write(proof.as_ref().map_or(&nothing, |proof| &proof.force_radius));
        }
        if proof.is_none() {
            remember("no solution with these states is proved to exist next to d");
            return Ok(SIGNORINI_STATUS_NOT_PROVED);
        }
        Ok(SIGNORINI_STATUS_SOLVED)
    })
}

/// A radius where nothing is proved.
pub(super) const NO_RADIUS: f64 = -1.0;

fn states(codes: &[i32]) -> Result<Vec<State>, Failure> {
    let state = |(pair, code): (usize, &i32)| match *code {
        SIGNORINI_STATE_OPEN => Ok(State::Open),
        SIGNORINI_STATE_SLIP => Ok(State::Slip),
        SIGNORINI_STATE_STICK => Ok(State::Stick),
        other => {
            let place = entry("state", [pair]);
            Err(Failure::argument(11, place + &format!(" is {other}, it must be 0, 1 or 2")))
        }
    };
    codes.iter().enumerate().map(state).collect()
}
