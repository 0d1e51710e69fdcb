//! Contact problems in flexibility form, in one call on plain arrays.

use super::args::{Arrays, matrix_length, size, sizes};
use super::extra::{Extra, SignoriniExtra};
use super::guard::{self, Failure};
use super::law;
use super::report::{SignoriniReport, state_codes};
use super::settings::SignoriniSettings;
use super::status::{code, remember};
use crate::error::{Argument, Error};
use crate::monitor::{Monitor, ProgressFn};
use crate::problem::{FlexibilityData, FlexibilityProblem};
use crate::solve::{Status, solve_flexibility};

/// Solves a contact problem in flexibility form, as codes of rigid and multibody dynamics have it:
/// d = W F + q takes the place of K d = f + F. Contact, friction and signs are those of the problem
/// above.
///
/// W = H M^-1 H' may be singular, as where pairs are redundant: four feet of a rigid table, a node
/// on two planes. Contact forces are not unique then; from the start zero the smallest are returned,
/// where the states of pairs do not change on the way. No solution is said to be the only one.
///
/// Measure: report->eta is the residual of the law with the unit 1 / W_nn for the normal of a pair
/// and one over the largest eigenvalue of its tangential block for its tangents, together with
/// these units times d - q - W F. It is relative to the larger of two sizes of force: F, less what W
/// does not feel; and the units times q. Where pairs that stay apart have free displacements far
/// above those that forces undo, ask for a smaller tolerance. All is computed from your W and q.
///
/// Codes that write u = W r + q with u_N >= 0 where a contact opens and r_N >= 0 where it presses
/// (FCLIB, Siconos, most multibody codes) change all signs but those of W: hand over -q; then u = -d
/// and r = -F. Velocities and impulses may take the places of displacements and forces.
///
/// With SIGNORINI_STATUS_NO_EQUILIBRIUM the gaps are proved to contradict each other: no forces
/// move the bodies to where every gap is kept. Whether friction wedges bodies so that no forces
/// balance is not proved: SIGNORINI_STATUS_STALLED, and signorini_last_error() names the pairs
/// whose forces grow.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param W         flexibility, N = dim * pairs columns of N entries, column-major, both
///                  triangles; symmetric, positive semi-definite, not zero; length / force. A row
///                  of zeros is a component that nothing moves
/// @param ldw       entries from one column of W to the next, at least max(1, N)
/// @param q         free displacements, N: the relative displacements without contact forces;
///                  length
/// @param gap       initial gaps, one for each pair; length; negative: interference; +infinity:
///                  the pair never touches; NULL: zero
/// @param law       SIGNORINI_LAW_..., the friction law of all pairs
/// @param friction  parameters of the law, pair by pair; may be NULL if frictionless
/// @param slip0     reference slip, dim - 1 for each pair, as in signorini_solve; length; NULL: zero
/// @param settings  NULL: the defaults
/// @param d         out: relative displacements W F + q, N
/// @param F         out: contact forces, N; in: the start if settings->warm_start
/// @param state     out: SIGNORINI_STATE_... of each pair; may be NULL
/// @param report    out: the measures of the result; set report->struct_size before the call, as
///                  signorini_report_default does; may be NULL
/// @param extra     the forces that prove SIGNORINI_STATUS_NO_EQUILIBRIUM; may be NULL
/// @return as signorini_solve
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
// long: fifteen arguments, each received at its position, in one scope of their lifetimes
pub unsafe extern "C" fn signorini_flexibility_solve(
    dim: i32,
    pairs: i64,
    W: *const f64,
    ldw: i64,
    q: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    settings: *const SignoriniSettings,
    d: *mut f64,
    F: *mut f64,
    state: *mut i32,
    report: *mut SignoriniReport,
    extra: *const SignoriniExtra,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        let (dim, pairs, n) = sizes(1, dim, pairs)?;
        let ld = size(4, "ldw", ldw)?;
        let entries = matrix_length(4, "W", n, ld)?;
        let closed = vec![0.0; pairs];
        // SAFETY: arrays of the lengths of the header, structures that begin with their size.
        let (data, received) = unsafe {
            let data = FlexibilityData {
                dim,
                pairs,
                flexibility: arrays.required(3, "W", W, entries)?,
                ld,
                free: arrays.required(5, "q", q, n)?,
                gap: arrays.optional(6, "gap", gap, pairs)?.unwrap_or(&closed),
                law: law::read(&mut arrays, 7, (law, friction), pairs)?,
                reference_slip: arrays.optional(9, "slip0", slip0, n - pairs)?,
            };
            (data, SignoriniSettings::read(SETTINGS, settings)?)
        };
        // SAFETY: as above.
        unsafe { arrays.structure(SETTINGS, "settings", settings, false)? };
        let d = arrays.output(11, "d", d, n)?;
        let force = arrays.output(START, "F", F, n)?;
        let state = arrays.optional_output(13, "state", state, pairs)?;
        // SAFETY: as above.
        let extra = unsafe {
            arrays.structure(14, "report", report.cast_const(), true)?;
            Extra::read(&mut arrays, 15, extra, (n, pairs, 1))?
        };
        arrays.check_overlap()?;

        let problem = FlexibilityProblem::from_flexibility(data).map_err(from_error)?;
        // SAFETY: F has n entries, which the caller has filled if it asked for a warm start.
        let start = received.starts_from_given().then(|| unsafe { force.read() });
        let mut progress = received.progress();
        let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
        let mut monitor = Monitor::new(&received.settings, progress);
        let solution =
            solve_flexibility(&problem, &received.settings, start.as_deref(), &mut monitor)
                .map_err(from_error)?;

        let status = code(solution.status);
        if solution.status != Status::Solved {
            remember(solution.message.clone());
        }
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            d.write(&solution.d);
            force.write(&solution.certificate.force);
            state.write(&state_codes(&solution.certificate.states));
            SignoriniReport::of(status, &solution).write(report);
            extra.write(0, &solution);
        }
        Ok(status)
    })
}

/// Number of `settings` among the arguments.
const SETTINGS: i32 = 10;

/// Number of the array that holds the start.
const START: i32 = 12;

/// A refusal, by the number of the argument that it is about.
fn from_error(error: Error) -> Failure {
    Failure::from_error(error, |argument| match argument {
        Argument::Dimension => 1,
        Argument::Size => 2,
        Argument::Matrix => 3,
        Argument::LeadingDimension => 4,
        Argument::Load => 5,
        Argument::Gap => 6,
        Argument::LawChoice => 7,
        Argument::Law => 8,
        Argument::ReferenceSlip => 9,
        Argument::Start => START,
        _ => SETTINGS,
    })
}
