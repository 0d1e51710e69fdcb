//! Contact problems in flexibility form with a sparse matrix.

use super::args::{Arrays, sizes};
use super::extra::SignoriniExtra;
use super::flexibility::{from_error, last_positions};
use super::guard;
use super::law;
use super::outputs::OutputArguments;
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use super::sparse::{FLEXIBILITY, SignoriniSparse};
use crate::problem::SparseFlexibilityProblem;
use crate::reduce::SparseFlexibilityData;
use crate::solve::{check_flexibility_sparse, largest_island, solve_flexibility_sparse};

/// Solves a contact problem in flexibility form, d = W F + q, with a sparse W: as
/// signorini_flexibility_solve, of which all else is said there.
///
/// Pairs that no entry of W ties to each other are islands, such as heaps of bodies that do not
/// touch. Each is solved by itself as a dense problem of its size, to settings->tolerance beside its
/// own forces; the result is measured as a whole on your sparse W. So the time is the sum of those
/// of the islands, and the memory that of the largest: signorini_solve_memory. Where
/// settings->memory_limit allows less, the call ends with SIGNORINI_STATUS_MEMORY_LIMIT before its
/// work begins, and signorini_last_error() names the largest island.
///
/// The status is that of the worst island. SIGNORINI_STATUS_NO_EQUILIBRIUM of one proves that the
/// whole has none; the other islands are solved all the same, from the smallest to the largest. At
/// a limit of time or iterations, or where the callback cancels, those that are still to come keep
/// the start. report->method, omega and damping are those of the largest island with the status;
/// counts are sums over all islands.
///
/// @param dim       space dimension, 2 or 3
/// @param pairs     number of contact pairs, 0 allowed
/// @param W         flexibility, W->size = dim * pairs; symmetric, positive semi-definite, not zero;
///                  length / force. A component that nothing moves has a row of zeros, which need
///                  not be stored; stored zeros tie nothing. W->order is not looked at
/// @param q         free displacements, N = dim * pairs; length
/// @param gap       initial gaps, one for each pair; length; NULL: zero
/// @param law       SIGNORINI_LAW_..., the friction law of all pairs
/// @param friction  parameters of the law, pair by pair; may be NULL if frictionless
/// @param slip0     reference slip, dim - 1 for each pair; length; NULL: zero
/// @param settings  NULL: the defaults
/// @param d         out: relative displacements W F + q, N
/// @param F         out: contact forces, N; in: the start if settings->warm_start
/// @param state     out: SIGNORINI_STATE_... of each pair; may be NULL
/// @param report    out: the measures of the result; may be NULL
/// @param extra     the forces that prove SIGNORINI_STATUS_NO_EQUILIBRIUM, of one island; may be
///                  NULL
/// @return as signorini_solve; SIGNORINI_STATUS_MEMORY_LIMIT
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_flexibility_solve_sparse(
    dim: i32,
    pairs: i64,
    W: *const SignoriniSparse,
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
        let refused = |error| from_error(error, FREE);
        let mut arrays = Arrays::default();
        let (dim, pairs, n) = sizes(1, dim, pairs)?;
        // SAFETY: arrays of the lengths of the header, structures that begin with their size.
        let (flexibility, free, gap, law, reference_slip, received, outputs) = unsafe {
            let matrix = SignoriniSparse::read(&mut arrays, 3, &FLEXIBILITY, W)?;
            let free = arrays.required(4, "q", q, n)?;
            let gap = arrays.optional(5, "gap", gap, pairs)?;
            let law = law::read(&mut arrays, 6, (law, friction), pairs)?;
            let slip = arrays.optional(8, "slip0", slip0, n - pairs)?;
            let received = SignoriniSettings::read(SETTINGS, settings)?;
            arrays.structure(SETTINGS, "settings", settings, false)?;
            let outputs = wanted.note(&mut arrays, FIRST, (n, pairs))?;
            (matrix, free, gap, law, slip, received, outputs)
        };
        arrays.check_overlap()?;

        let closed = vec![0.0; pairs];
        let gap = gap.unwrap_or(&closed);
        let data =
            SparseFlexibilityData { dim, pairs, flexibility, free, gap, law, reference_slip };
        let problem = SparseFlexibilityProblem::from_sparse(data).map_err(refused)?;
        let settings = &received.settings;
        let bytes = check_flexibility_sparse(&problem, settings).map_err(refused)?;
        guard::reserve_estimate(bytes)
            .map_err(|failure| failure.explained(&largest_island(&problem)))?;
        // SAFETY: F has n entries, which the caller has filled if it asked for a warm start.
        let start = received.starts_from_given().then(|| unsafe { outputs.force.read() });
        let solution = received
            .monitored(|monitor| {
                solve_flexibility_sparse(&problem, settings, start.as_deref(), monitor)
            })
            .map_err(refused)?;
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        Ok(unsafe { outputs.write(&solution) })
    })
}

/// Number of `q` among the arguments.
const FREE: i32 = 4;

const SETTINGS: i32 = last_positions(FREE).0;
const FIRST: i32 = last_positions(FREE).1;
