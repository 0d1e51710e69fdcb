//! The certificate of displacements from any origin, and the proof that a solution exists next to them.

use super::args::{At, c_entry};
use super::case_arguments::CaseArguments;
use super::guard::{Failure, Outcome};
use super::model::SignoriniModel;
use super::numbers::Numbered;
use super::outputs::NO_RADIUS;
use super::report::{SignoriniReport, state_codes};
use super::status::{
    SIGNORINI_STATUS_NOT_A_SOLUTION, SIGNORINI_STATUS_NOT_PROVED, SIGNORINI_STATUS_SOLVED, remember,
};
use crate::certificate::Certificate;
use crate::error::Argument;
use crate::law::State;
use crate::settings::check_tolerance;

/// Measures relative displacements of any origin on a load case.
///
/// @param model,f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
/// @param tolerance     largest eta of a solution, 1e-15 to 0.1
/// @param d             the displacements, N
/// @param F             out: the contact forces that obey the law and are nearest to K d - f, N;
///                      may be NULL. In flexibility form, and where pairs depend on each other, in:
///                      the forces to be measured with d
/// @param state,report  as for signorini_solve
/// @return 0: a solution; SIGNORINI_STATUS_NOT_A_SOLUTION: none; or another status
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_certify(
    model: *const SignoriniModel,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    tolerance: f64,
    d: *const f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
) -> i32 {
    const MEASURED: i32 = 9;
    let given = CaseArguments { first: 2, f, prescribed, gap, law, friction, slip0 };
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        check_tolerance("tolerance", tolerance)
            .map_err(|message| Failure::argument(MEASURED - 1, message))?;
        let d = arrays.at(MEASURED, "d").required(d, model.dim() * model.pairs())?;
        let report = arrays.at(12, "report").out_structures(report, 1)?;
        let state = arrays.at(11, "state").optional_output(state, model.pairs())?;
        let at_force = arrays.at(10, "F").is(Argument::Force);
        let (certificate, force) = if model.is_determined_by_displacements() {
            let force = at_force.optional_output(F, d.len())?;
            arrays.check_overlap()?;
            (model.certify(&case, d), Some(force))
        } else {
            let force = at_force.required(F.cast_const(), d.len())?;
            arrays.check_overlap()?;
            (model.certify_forces(&case, d, force), None)
        };
        let certificate = certificate.map_err(arrays.refused(MEASURED))?.with_rounding(tolerance);
        let status = judged(&certificate, tolerance);
        if let Some(force) = force {
            force.write(&certificate.force);
        }
        state.write_each(state_codes(&certificate.states));
        report.write(0, &SignoriniReport::of_certificate(status, &certificate));
        Ok(status)
    })
}

/// The status, whose sentence is remembered unless it is solved.
fn judged(certificate: &Certificate, tolerance: f64) -> i32 {
    if certificate.holds(tolerance) {
        return SIGNORINI_STATUS_SOLVED;
    }
    let eta = certificate.eta;
    remember(match certificate.doubt() {
        Some(doubt) => format!("d is not certified: {doubt} (eta is {eta:.1e})"),
        None => format!("d is not a solution: eta is {eta:.1e}, wanted {tolerance:.1e}"),
    });
    SIGNORINI_STATUS_NOT_A_SOLUTION
}

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
        let model = &arrays.model(model)?.model;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        let d = arrays.at(MEASURED, "d").required(d, model.dim() * model.pairs())?;
        let at_state = arrays.at(9, "state");
        let state = at_state.optional(state, model.pairs())?;
        let force = arrays.at(10, "F").optional_output(F, d.len())?;
        let radius_d = arrays.at(11, "radius_d").optional_output(radius_d, d.len())?;
        let radius_force = arrays.at(12, "radius_F").optional_output(radius_F, d.len())?;
        arrays.check_overlap()?;
        let states = state.map(|codes| at_state.states(codes)).transpose()?;
        let proof = model.prove(&case, d, states.as_deref()).map_err(arrays.refused(MEASURED))?;
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

impl At<'_> {
    /// The states of pairs by their codes.
    pub(super) fn states(self, codes: &[i32]) -> Outcome<Vec<State>> {
        let parsed = |(pair, code): (usize, &i32)| {
            let refuse = || self.refuse_entry(pair, format!("is {code}, it must be 0, 1 or 2"));
            State::numbered(*code).map_or_else(refuse, Ok)
        };
        codes.iter().enumerate().map(parsed).collect()
    }
}
