//! The linear complementarity problem (LCP) in one call.

use super::args::c_entry;
use super::guard::{self, number_of, refused};
use super::numbers::Numbered;
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use super::status::remember;
use crate::error::Argument::{self, Covering, LeadingDimension, Load, Matrix, Size};
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
        let n = arrays.at(1, "n").size(n)?;
        let (matrix, ld) = arrays.at(2, "M").square(M, ("ldm", ldm), n)?;
        let q = arrays.at(4, "q").required(q, n)?;
        let cover = arrays.at(5, "cover").optional(cover, n)?;
        let received = SignoriniSettings::read(arrays.at(6, "settings"), settings)?;
        let w = arrays.at(7, "w").output(w, n)?;
        let z = arrays.at(8, "z").output(z, n)?;
        let y = arrays.at(9, "y").optional_output(y, n)?;
        let report = arrays.at(10, "report").out_structures(report, 1)?;
        arrays.check_overlap()?;

        guard::reserve_estimate(memory(n))?;
        let position = |wrong| number_of(wrong, 1, &LCP_ARGUMENTS).unwrap_or(6);
        let lcp = Lcp::new(n, matrix, ld, q, cover).map_err(refused(position))?;
        let solution = received
            .monitored(|monitor| solve_lcp(&lcp, &received.settings, monitor))
            .map_err(refused(position))?;

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
