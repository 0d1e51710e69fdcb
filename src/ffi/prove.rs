//! The proof that a solution exists next to displacements from any origin.

use super::args::c_entry;
use super::case_arguments::CaseArguments;
use super::extra::NO_RADIUS;
use super::guard::Failure;
use super::model::SignoriniModel;
use super::numbers::Numbered;
use super::status::{SIGNORINI_STATUS_NOT_PROVED, SIGNORINI_STATUS_SOLVED, remember};
use crate::error::entry;
use crate::law::State;

/// Tries to prove that a load case has a solution next to displacements of any origin, in the
/// sense of SIGNORINI_PROOF_PROVED, and bounds its distance. Others may exist.
///
/// @param model  a model with a condensed matrix
/// @param f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
/// @param d      relative displacements, N
/// @param state  SIGNORINI_STATE_... of each pair; NULL: those of d
/// @param F      out: contact forces of the solution, N; zeros if not proved; may be NULL
/// @param radius_d,radius_F  out: as in signorini_extra; may be NULL
/// @return 0: proved; SIGNORINI_STATUS_NOT_PROVED: not; or another status
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_prove(
    model: *const SignoriniModel,
    f: *const f64,
    prescribed: *const f64,
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
    const MEASURED: i32 = 8;
    let given = CaseArguments { first: 2, f, prescribed, gap, law, friction, slip0 };
    c_entry!(|arrays| {
        let model = arrays.model(model)?;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        let d = arrays.required(MEASURED, "d", d, model.dim() * model.pairs())?;
        let state = arrays.optional(STATE, "state", state, model.pairs())?;
        let force = arrays.optional_output(10, "F", F, d.len())?;
        let radius_d = arrays.optional_output(11, "radius_d", radius_d, d.len())?;
        let radius_force = arrays.optional_output(12, "radius_F", radius_F, d.len())?;
        arrays.check_overlap()?;
        let states = state.map(states).transpose()?;
        let proof = model.prove(&case, d, states.as_deref()).map_err(|error| {
            Failure::from_error(error, |argument| given.position(argument, MEASURED))
        })?;
        let proof = proof.as_ref();
        force.write_or(proof.map(|proof| &proof.force), 0.0);
        radius_d.write_or(proof.map(|proof| proof.radius_about(d)).as_ref(), NO_RADIUS);
        radius_force.write_or(proof.map(|proof| &proof.force_radius), NO_RADIUS);
        if proof.is_none() {
            remember("no solution with these states is proved to exist next to d");
            return Ok(SIGNORINI_STATUS_NOT_PROVED);
        }
        Ok(SIGNORINI_STATUS_SOLVED)
    })
}

/// Number of `state` among the arguments.
const STATE: i32 = 9;

fn states(codes: &[i32]) -> Result<Vec<State>, Failure> {
    let state = |(pair, code): (usize, &i32)| {
        State::numbered(*code).ok_or_else(|| {
            let place = entry("state", [pair]);
            Failure::argument(STATE, place + &format!(" is {code}, it must be 0, 1 or 2"))
        })
    };
    codes.iter().enumerate().map(state).collect()
}
