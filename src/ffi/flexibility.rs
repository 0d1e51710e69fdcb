//! Contact problems in flexibility form, in one call on plain arrays.

use super::args::{Arrays, matrix_length, size, sizes};
use super::extra::SignoriniExtra;
use super::guard::{self, Failure};
use super::law;
use super::outputs::OutputArguments;
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use crate::error::{Argument, Error};
use crate::problem::{FlexibilityData, FlexibilityProblem};
use crate::solve::{memory_flexibility, solve_flexibility};

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
    let wanted = OutputArguments { d, F, state, report, extra };
    guard::call(|| {
        let mut arrays = Arrays::default();
        let (dim, pairs, n) = sizes(1, dim, pairs)?;
        let ld = size(4, "ldw", ldw)?;
        let entries = matrix_length(4, "W", n, ld)?;
        // SAFETY: arrays of the lengths of the header, structures that begin with their size.
        let (matrix, free, gap, law, reference_slip, received, outputs) = unsafe {
            let matrix = arrays.matrix(3, "W", W, entries)?;
            let free = arrays.required(5, "q", q, n)?;
            let gap = arrays.optional(6, "gap", gap, pairs)?;
            let law = law::read(&mut arrays, 7, (law, friction), pairs)?;
            let slip = arrays.optional(9, "slip0", slip0, n - pairs)?;
            let received = SignoriniSettings::read(SETTINGS, settings)?;
            arrays.structure(SETTINGS, "settings", settings, false)?;
            (matrix, free, gap, law, slip, received, wanted.note(&mut arrays, FIRST, (n, pairs))?)
        };
        arrays.check_overlap()?;

        guard::reserve_estimate(memory_flexibility(n))?;
        let closed = vec![0.0; pairs];
        let gap = gap.unwrap_or(&closed);
        let data =
            FlexibilityData { dim, pairs, flexibility: matrix, ld, free, gap, law, reference_slip };
        let problem =
            FlexibilityProblem::from_flexibility(data).map_err(|error| from_error(error, FREE))?;
        // SAFETY: F has n entries, which the caller has filled if it asked for a warm start.
        let start = received.starts_from_given().then(|| unsafe { outputs.force.read() });
        let settings = &received.settings;
        let solution = received
            .monitored(|monitor| solve_flexibility(&problem, settings, start.as_deref(), monitor))
            .map_err(|error| from_error(error, FREE))?;
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        Ok(unsafe { outputs.write(&solution) })
    })
}

/// Number of `q` among the arguments.
const FREE: i32 = 5;

/// Numbers of `settings`, of the first result and of the array that holds the start, with that of `q`.
pub(super) const fn last_positions(free: i32) -> (i32, i32, i32) {
    (free + 5, free + 6, free + 7)
}

const SETTINGS: i32 = last_positions(FREE).0;
const FIRST: i32 = last_positions(FREE).1;

/// A refusal, by the number of the argument that it is about; `free` is that of `q`.
pub(super) fn from_error(error: Error, free: i32) -> Failure {
    let (settings, _, start) = last_positions(free);
    Failure::from_error(error, |argument| match argument {
        Argument::Dimension => 1,
        Argument::Size => 2,
        Argument::Matrix => 3,
        Argument::LeadingDimension => 4,
        Argument::Load => free,
        Argument::Gap => free + 1,
        Argument::LawChoice => free + 2,
        Argument::Law => free + 3,
        Argument::ReferenceSlip => free + 4,
        Argument::Start => start,
        _ => settings,
    })
}
