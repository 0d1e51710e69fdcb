//! The certificate of displacements from any origin.

use super::args::{Arrays, Output};
use super::condensed::CondensedArguments;
use super::guard::{self, Failure};
use super::model::{SignoriniModel, read};
use super::model_solve::CaseArguments;
use super::report::{SignoriniReport, state_codes};
use super::status::{SIGNORINI_STATUS_NOT_A_SOLUTION, SIGNORINI_STATUS_SOLVED, remember};
use crate::certificate::{Certificate, certify};
use crate::error::entry;
use crate::problem::ContactProblem;
use crate::settings::check_tolerance;
use crate::solve::memory;

/// Measures displacements of any origin, say of another solver, on the data of a condensed contact
/// problem. The same measure decides whether a result of this library is called solved.
///
/// @param dim        space dimension, 2 or 3
/// @param pairs      number of contact pairs, 0 allowed
/// @param K          condensed stiffness, as for signorini_solve
/// @param ldk        entries from one column of K to the next, at least max(1, N)
/// @param f          condensed nodal loads, N
/// @param gap        initial gaps, one for each pair
/// @param law        SIGNORINI_LAW_..., the friction law of all pairs
/// @param friction   parameters of the law, pair by pair; may be NULL if frictionless
/// @param slip0      reference slip, dim - 1 for each pair; NULL: zero
/// @param tolerance  largest eta of a solution, 1e-15 to 0.1
/// @param d          relative displacements to be measured, N
/// @param F          out: the contact forces that obey the contact law and are nearest to K d - f,
///                   N; may be NULL
/// @param state      out: SIGNORINI_STATE_... of each pair; may be NULL
/// @param report     out: the measures; set report->struct_size before the call; may be NULL
/// @return 0: d is a solution, report->eta <= tolerance; SIGNORINI_STATUS_NOT_A_SOLUTION: it is
///         not; -k: the k-th argument is wrong, nothing was written
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_certify(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
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
    const MEASURED: i32 = 11;
    let given = CondensedArguments { first: 1, dim, pairs, K, ldk, f, gap, law, friction, slip0 };
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: arrays of the lengths of the header, a report that begins with its size.
        let (data, d, results) = unsafe {
            let data = given.read(&mut arrays)?;
            let (pairs, n) = (data.pairs, data.dim * data.pairs);
            let measured = Measured { first: MEASURED - 1, tolerance, d, F, state, report };
            let (d, results) = measured.read(&mut arrays, n, pairs)?;
            (data, d, results)
        };
        arrays.check_overlap()?;
        guard::reserve_estimate(memory(d.len()))?;
        let problem = ContactProblem::new(data).map_err(|error| {
            Failure::from_error(error, |argument| given.position(argument, MEASURED))
        })?;
        if let Some(i) = d.iter().position(|d| !d.is_finite()) {
            return Err(Failure::argument(MEASURED, entry("d", [i]) + " is not finite"));
        }
        // SAFETY: as above.
        Ok(unsafe { results.write(certify(&problem, d)) })
    })
}

/// Measures relative displacements of any origin on a load case of a model, as signorini_certify
/// does on a condensed problem. If pairs depend on each other, displacements do not tell the forces:
/// -1 is returned.
///
/// @param model       the model
/// @param f           nodal loads of the host, H = signorini_model_host_size entries
/// @param prescribed  values of the fixed degrees of freedom, in the order of fixed; NULL: zero
/// @param gap         gaps, one for each pair
/// @param law         SIGNORINI_LAW_..., the friction law of all pairs
/// @param friction    parameters of the law, pair by pair; may be NULL if frictionless
/// @param slip0       reference slip, dim - 1 for each pair; NULL: zero
/// @param tolerance   largest eta of a solution, 1e-15 to 0.1
/// @param d           relative displacements to be measured, N
/// @param F           out: contact forces, N, as in signorini_certify; may be NULL
/// @param state       out: SIGNORINI_STATE_... of each pair; may be NULL
/// @param report      out: the measures; set report->struct_size before the call; may be NULL
/// @return as signorini_certify
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
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
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model, arrays and a report as the header demands.
        let (model, case, d, results) = unsafe {
            let model = read(model)?;
            let cases = given.read(&mut arrays, model, 1)?;
            let n = model.dim() * model.pairs();
            let measured = Measured { first: MEASURED - 1, tolerance, d, F, state, report };
            let (d, results) = measured.read(&mut arrays, n, model.pairs())?;
            (model, cases.case(0), d, results)
        };
        arrays.check_overlap()?;
        let certificate = model.certify(&case, d).map_err(|error| {
            Failure::from_error(error, |argument| given.position(argument, MEASURED))
        })?;
        // SAFETY: as above.
        Ok(unsafe { results.write(certificate) })
    })
}

/// The last arguments of both calls, from `tolerance` on, which is number `first`.
#[allow(non_snake_case)] // as above
struct Measured {
    first: i32,
    tolerance: f64,
    d: *const f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
}

/// Where the results go.
struct Results {
    tolerance: f64,
    force: Output<f64>,
    state: Output<i32>,
    report: *mut SignoriniReport,
}

impl Measured {
    /// # Safety
    /// Every pointer is NULL or has the length that the header demands.
    unsafe fn read<'a>(
        self,
        arrays: &mut Arrays,
        n: usize,
        pairs: usize,
    ) -> Result<(&'a [f64], Results), Failure> {
        let (tolerance, report, at) = (self.tolerance, self.report, |offset| self.first + offset);
        check_tolerance("tolerance", tolerance)
            .map_err(|message| Failure::argument(at(0), message))?;
        // SAFETY: by the caller's contract.
        let d = unsafe { arrays.required(at(1), "d", self.d, n)? };
        let force = arrays.optional_output(at(2), "F", self.F, n)?;
        let state = arrays.optional_output(at(3), "state", self.state, pairs)?;
        // SAFETY: by the caller's contract.
        unsafe { arrays.structure(at(4), "report", report.cast_const(), true)? };
        Ok((d, Results { tolerance, force, state, report }))
    }
}

impl Results {
    /// Writes the measures and returns the status.
    ///
    /// # Safety
    /// The outputs have the lengths of the header and overlap nothing.
    unsafe fn write(&self, certificate: Certificate) -> i32 {
        let tolerance = self.tolerance;
        let certificate = certificate.with_rounding(tolerance);
        let eta = certificate.eta;
        let status = if certificate.holds(tolerance) {
            SIGNORINI_STATUS_SOLVED
        } else {
            remember(format!("d is not a solution: eta is {eta:.1e}, wanted {tolerance:.1e}"));
            SIGNORINI_STATUS_NOT_A_SOLUTION
        };
        // SAFETY: by the caller's contract.
        unsafe {
            self.force.write(&certificate.force);
            self.state.write(&state_codes(&certificate.states));
            SignoriniReport::of_certificate(status, &certificate).write(self.report);
        }
        status
    }
}
