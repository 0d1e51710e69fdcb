//! The certificate of displacements from any origin.

use super::args::{Arrays, matrix_length, size, sizes};
use super::guard::{self, Failure};
use super::report::{SignoriniReport, state_code};
use super::status::{SIGNORINI_NOT_A_SOLUTION, SIGNORINI_SOLVED, remember};
use crate::certificate::certify;
use crate::error::{Argument, Error};
use crate::problem::{ContactData, ContactProblem, FrictionLaw};

/// Measures displacements of any origin, say of another solver, on the data of a condensed contact
/// problem with Coulomb friction: what decides whether this library calls a result solved.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param K         condensed stiffness, as for signorini_solve
/// @param ldk       entries from one column of K to the next, at least max(1, N)
/// @param f         condensed nodal loads, N
/// @param gap       initial gaps, one for each pair
/// @param mu        friction coefficients, one for each pair
/// @param slip      tangential displacement at rest, dim - 1 for each pair; NULL: zero
/// @param tolerance largest eta of a solution, 1e-15 to 0.1
/// @param d         relative displacements to be measured, N
/// @param F         out: contact forces that obey the law, nearest to K d - f, N; NULL: not wanted
/// @param state     out: state of each pair; NULL: not wanted
/// @param report    out: the measures; set report->struct_size before the call; NULL: not wanted
/// @return 0: d is a solution, report->eta <= tolerance; SIGNORINI_NOT_A_SOLUTION: it is not;
///         -k the k-th argument is wrong, nothing was written
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_certify(
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    tolerance: f64,
    d: *const f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
) -> i32 {
    guard::call(|| {
        let (dim, pairs, n) = sizes(dim, pairs)?;
        let ld = size(4, "ldk", ldk)?;
        let entries = matrix_length(4, "K", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (stiffness, load, gap, mu, reference_slip, given) = unsafe {
            (
                arrays.input(3, "K", K, entries, true)?.unwrap_or_default(),
                arrays.input(5, "f", f, n, true)?.unwrap_or_default(),
                arrays.input(6, "gap", gap, pairs, true)?.unwrap_or_default(),
                arrays.input(7, "mu", mu, pairs, true)?.unwrap_or_default(),
                arrays.input(8, "slip", slip, n - pairs, false)?,
                arrays.input(10, "d", d, n, true)?.unwrap_or_default(),
            )
        };
        if !(1e-15..=0.1).contains(&tolerance) {
            let message = format!("tolerance is {tolerance}, it must lie between 1e-15 and 0.1");
            return Err(Failure::argument(9, message));
        }
        let force = arrays.output(11, "F", F, n, false)?;
        let state = arrays.output(12, "state", state, pairs, false)?;
        // SAFETY: the header asks for structures that begin with their size.
        unsafe { SignoriniReport::accept(13, report)? };
        arrays.structure(13, "report", report.cast_const(), true)?;
        arrays.check_overlap()?;

        let from_error = |error: Error| Failure::from_error(error, position);
        let problem = ContactProblem::new(ContactData {
            dim,
            pairs,
            stiffness,
            ld,
            load,
            gap,
            law: FrictionLaw::Coulomb(mu),
            reference_slip,
        })
        .map_err(from_error)?;
        if let Some(i) = given.iter().position(|d| !d.is_finite()) {
            return Err(Failure::argument(10, format!("d[{i}] is not finite")));
        }
        let certificate = certify(&problem, given);
        let status = if certificate.holds(tolerance) {
            SIGNORINI_SOLVED
        } else {
            let eta = certificate.eta;
            remember(format_args!("d is not a solution: eta is {eta:.1e}, wanted {tolerance:.1e}"));
            SIGNORINI_NOT_A_SOLUTION
        };
        let states: Vec<i32> = certificate.states.iter().map(|&state| state_code(state)).collect();
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            force.write(&certificate.force);
            state.write(&states);
            SignoriniReport::of_certificate(status, &certificate).send(report);
        }
        Ok(status)
    })
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Dimension => 1,
        Argument::Size => 2,
        Argument::Matrix => 3,
        Argument::LeadingDimension => 4,
        Argument::Load => 5,
        Argument::Gap => 6,
        Argument::Law => 7,
        Argument::ReferenceSlip => 8,
        other => unreachable!("this call has no argument {other:?}"),
    }
}
