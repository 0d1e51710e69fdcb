//! The certificate of displacements from any origin.

use super::args::c_entry;
use super::case_arguments::CaseArguments;
use super::guard::Failure;
use super::model::SignoriniModel;
use super::report::{SignoriniReport, state_codes};
use super::status::{SIGNORINI_STATUS_NOT_A_SOLUTION, SIGNORINI_STATUS_SOLVED, remember};
use crate::certificate::Certificate;
use crate::error::Argument;
use crate::settings::check_tolerance;

/// Measures relative displacements of any origin on a load case, as the library measures its own.
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
        let model = arrays.model(model)?;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        check_tolerance("tolerance", tolerance)
            .map_err(|message| Failure::argument(MEASURED - 1, message))?;
        let d = arrays.required(MEASURED, "d", d, model.dim() * model.pairs())?;
        let report = arrays.out_structures(12, "report", report, 1)?;
        let state = arrays.optional_output(11, "state", state, model.pairs())?;
        let (certificate, force) = if model.is_determined_by_displacements() {
            let force = arrays.optional_output(10, "F", F, d.len())?;
            arrays.check_overlap()?;
            (model.certify(&case, d), Some(force))
        } else {
            let force = arrays.required(10, "F", F.cast_const(), d.len())?;
            arrays.check_overlap()?;
            (model.certify_forces(&case, d, force), None)
        };
        let certificate = certificate.map_err(|error| {
            Failure::from_error(error, |argument| match argument {
                Argument::Force => 10,
                argument => given.position(argument, MEASURED),
            })
        })?;
        let certificate = certificate.with_rounding(tolerance);
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
    remember(format!("d is not a solution: eta is {eta:.1e}, wanted {tolerance:.1e}"));
    SIGNORINI_STATUS_NOT_A_SOLUTION
}
