//! The linear complementarity problem (LCP) in one call.

use super::args::{c_entry, size};
use super::guard::{self, Failure, number_of};
use super::numbers::Numbered;
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use super::status::remember;
use crate::error::Argument::{self, Covering, LeadingDimension, Load, Matrix, Size};
use crate::error::Error;
use crate::problem::Lcp;
use crate::solve::{Status, memory, solve_lcp};

/// Solves a linear complementarity problem (LCP): w = q + M z, w >= 0, z >= 0, w . z = 0.
///
/// SIGNORINI_METHOD_AUTO is block principal pivoting, then Lemke's method (lexicographic). M
/// positive definite or a P-matrix: the problem is solved. M positive semi-definite or
/// copositive-plus: it is solved, or proved to have no solution (SIGNORINI_STATUS_NO_EQUILIBRIUM).
/// Any other M: the call may also end in a ray that proves nothing (SIGNORINI_STATUS_STALLED).
///
/// @param n         number of unknowns, 0 allowed
/// @param M         any matrix, n columns of n entries
/// @param ldm       entries from one column of M to the next, at least max(1, n)
/// @param q         n
/// @param cover     covering vector of Lemke's method, n positive entries; NULL: ones
/// @param settings  NULL: the defaults; method AUTO, BLOCK_PIVOTING or LEMKE; omega, damping,
///                  warm_start and search have no effect
/// @param w,z       out: n
/// @param y         out: n; may be NULL. With SIGNORINI_STATUS_NO_EQUILIBRIUM the proof: y >= 0,
///                  M' y <= 0, q . y < 0; else zeros
/// @param report    as for signorini_solve
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_lcp_solve(
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    cover: *const f64,
    settings: *const SignoriniSettings,
    w: *mut f64,
    z: *mut f64,
    y: *mut f64,
    report: *mut SignoriniReport,
) -> i32 {
    c_entry!(|arrays| {
        let n = size(1, "n", n)?;
        let (matrix, ld) = arrays.square(2, ("M", M), ("ldm", ldm), n)?;
        let q = arrays.required(4, "q", q, n)?;
        let cover = arrays.optional(5, "cover", cover, n)?;
        let received = SignoriniSettings::read(arrays, 6, settings)?;
        let w = arrays.output(7, "w", w, n)?;
        let z = arrays.output(8, "z", z, n)?;
        let y = arrays.optional_output(9, "y", y, n)?;
        let report = arrays.out_structures(10, "report", report, 1)?;
        arrays.check_overlap()?;

        guard::reserve_estimate(memory(n))?;
        let lcp = Lcp::new(n, matrix, ld, q, cover).map_err(refused)?;
        let solution = received
            .monitored(|monitor| solve_lcp(&lcp, &received.settings, monitor))
            .map_err(refused)?;

        let status = solution.status.number();
        if solution.status != Status::Solved {
            remember(solution.message.clone());
        }
        w.write(&solution.w);
        z.write(&solution.z);
        y.write_or(solution.infeasible_by.as_ref(), 0.0);
        report.write(0, &SignoriniReport::of_lcp(status, &solution));
        Ok(status)
    })
}

/// The arguments of the problem, in their order.
pub(super) const LCP_ARGUMENTS: [Argument; 5] = [Size, Matrix, LeadingDimension, Load, Covering];

/// A refusal, by the number of the argument that it is about.
fn refused(error: Error) -> Failure {
    Failure::from_error(error, |wrong| number_of(wrong, 1, &LCP_ARGUMENTS).unwrap_or(6))
}
