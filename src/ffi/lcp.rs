//! The bare linear complementarity problem in one call.

use super::args::{Arrays, matrix_length, size};
use super::guard::{self, Failure};
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use super::status::{code, remember};
use crate::error::Argument;
use crate::lcp::Lcp;
use crate::monitor::{Monitor, ProgressFn};
use crate::solve::{Status, solve_lcp};

/// Solves the linear complementarity problem w = q + M z, w >= 0, z >= 0, w . z = 0 by Lemke's
/// method (lexicographic: it never cycles).
///
/// M may be any matrix. If it is positive definite or a P-matrix the problem is solved; if it is
/// positive semi-definite or copositive-plus it is solved, or proved infeasible
/// (SIGNORINI_NO_EQUILIBRIUM); otherwise the method may also end in a ray that proves nothing
/// (SIGNORINI_STALLED). Arrays must not overlap.
///
/// @param n         number of unknowns, 0 allowed
/// @param M         n columns of n entries, column-major
/// @param ldm       entries from one column of M to the next, at least max(1, n)
/// @param q         n
/// @param cover     covering vector, n positive entries; NULL: ones
/// @param settings  NULL: the defaults; method, omega, damping and warm_start, though they must be
///                  valid, have no effect
/// @param w         out: n
/// @param z         out: n; with SIGNORINI_NO_EQUILIBRIUM a y >= 0 with M' y <= 0, q . y < 0
/// @param report    out; set report->struct_size before the call; NULL: not wanted
/// @return as signorini_solve
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the name of the mathematics, which the header shows
pub unsafe extern "C" fn signorini_lcp_lemke(
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    cover: *const f64,
    settings: *const SignoriniSettings,
    w: *mut f64,
    z: *mut f64,
    report: *mut SignoriniReport,
) -> i32 {
    guard::call(|| {
        let n = size(1, "n", n)?;
        let ld = size(3, "ldm", ldm)?;
        let entries = matrix_length(3, "M", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (matrix, q, cover) = unsafe {
            (
                arrays.input(2, "M", M, entries, true)?.unwrap_or_default(),
                arrays.input(4, "q", q, n, true)?.unwrap_or_default(),
                arrays.input(5, "cover", cover, n, false)?,
            )
        };
        // SAFETY: the header asks for structures that begin with their size.
        let received = unsafe { SignoriniSettings::receive(6, settings)? };
        let w = arrays.output(7, "w", w, n, true)?;
        let z = arrays.output(8, "z", z, n, true)?;
        // SAFETY: as above.
        unsafe { SignoriniReport::accept(9, report)? };
        arrays.structure(6, "settings", settings, false)?;
        arrays.structure(9, "report", report.cast_const(), true)?;
        arrays.check_overlap()?;

        let from_error = |error| Failure::from_error(error, position);
        let lcp = Lcp::new(n, matrix, ld, q, cover).map_err(from_error)?;
        let mut progress = received.progress();
        let progress = progress.as_mut().map(|progress| progress as &mut ProgressFn<'_>);
        let mut monitor = Monitor::new(&received.settings, progress);
        let solution = solve_lcp(&lcp, &received.settings, &mut monitor).map_err(from_error)?;

        let status = code(solution.status);
        if solution.status != Status::Solved {
            remember(format_args!("{}", solution.message));
        }
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            w.write(&solution.w);
            z.write(&solution.z);
            SignoriniReport::of_lcp(status, &solution).send(report);
        }
        Ok(status)
    })
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Size | Argument::Dimension => 1,
        Argument::Matrix => 2,
        Argument::LeadingDimension => 3,
        Argument::Load => 4,
        Argument::Covering => 5,
        _ => 6,
    }
}
