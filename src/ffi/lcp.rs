//! The linear complementarity problem (LCP) in one call.

use super::args::{Arrays, matrix_length, size};
use super::guard::{self, Failure};
use super::report::SignoriniReport;
use super::settings::SignoriniSettings;
use super::status::{code, remember};
use crate::error::Argument;
use crate::problem::Lcp;
use crate::settings::Method;
use crate::solve::{Status, memory, solve_lcp};

/// Solves a linear complementarity problem (LCP): w = q + M z, w >= 0, z >= 0, w . z = 0.
///
/// The default method is block principal pivoting, then Lemke's method.
///
/// @param n         number of unknowns, 0 allowed
/// @param M         any matrix, n columns of n entries, column-major
/// @param ldm       entries from one column of M to the next, at least max(1, n)
/// @param q         n
/// @param settings  NULL: the defaults; method is SIGNORINI_METHOD_AUTO, _BLOCK_PIVOTING or _LEMKE;
///                  omega, damping, warm_start and search are checked and have no effect
/// @param w         out: n
/// @param z         out: n
/// @param y         out: n; with SIGNORINI_STATUS_NO_EQUILIBRIUM the proof that no w, z >= 0
///                  satisfy w = q + M z: y >= 0, M' y <= 0, q . y < 0; with every other status
///                  zeros; may be NULL
/// @param report    out: set report->struct_size before the call; may be NULL
/// @return as signorini_solve
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the name of the mathematics, which the header shows
pub unsafe extern "C" fn signorini_lcp_solve(
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    settings: *const SignoriniSettings,
    w: *mut f64,
    z: *mut f64,
    y: *mut f64,
    report: *mut SignoriniReport,
) -> i32 {
    let arguments =
        Arguments { n, M, ldm, q, cover: None, settings, w, z, y, report, method: None };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.run() })
}

/// Solves an LCP by Lemke's method (lexicographic: it never cycles).
///
/// M positive definite or a P-matrix: the problem is solved. M positive semi-definite or
/// copositive-plus: it is solved, or proved infeasible (SIGNORINI_STATUS_NO_EQUILIBRIUM). Any other
/// M: the method may also end in a ray that proves nothing (SIGNORINI_STATUS_STALLED).
///
/// @param n         number of unknowns, 0 allowed
/// @param M         any matrix, n columns of n entries, column-major
/// @param ldm       entries from one column of M to the next, at least max(1, n)
/// @param q         n
/// @param cover     covering vector, n positive entries; NULL: ones
/// @param settings  NULL: the defaults; method, omega, damping, warm_start and search are checked
///                  and have no effect
/// @param w         out: n
/// @param z         out: n
/// @param y         out: n; the proof of infeasibility, as in signorini_lcp_solve; may be NULL
/// @param report    out: set report->struct_size before the call; may be NULL
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
    y: *mut f64,
    report: *mut SignoriniReport,
) -> i32 {
    let arguments = Arguments {
        n,
        M,
        ldm,
        q,
        cover: Some(cover),
        settings,
        w,
        z,
        y,
        report,
        method: Some(Method::Lemke),
    };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.run() })
}

#[allow(non_snake_case)] // as above
struct Arguments {
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    /// Of the call that has this argument, which shifts the positions of the later ones.
    cover: Option<*const f64>,
    settings: *const SignoriniSettings,
    w: *mut f64,
    z: *mut f64,
    y: *mut f64,
    report: *mut SignoriniReport,
    /// The method, if it is not that of the settings.
    method: Option<Method>,
}

impl Arguments {
    /// # Safety
    /// Every pointer is NULL or has the length that the header demands.
    unsafe fn run(&self) -> Result<i32, Failure> {
        let shift = i32::from(self.cover.is_some());
        let n = size(1, "n", self.n)?;
        let ld = size(3, "ldm", self.ldm)?;
        let entries = matrix_length(3, "M", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (matrix, q, cover) = unsafe {
            let cover = self.cover.unwrap_or(std::ptr::null());
            (
                arrays.matrix(2, "M", self.M, entries)?,
                arrays.required(4, "q", self.q, n)?,
                arrays.optional(5, "cover", cover, n)?,
            )
        };
        // SAFETY: the header asks for structures that begin with their size.
        let mut received = unsafe { SignoriniSettings::read(5 + shift, self.settings)? };
        let w = arrays.output(6 + shift, "w", self.w, n)?;
        let z = arrays.output(7 + shift, "z", self.z, n)?;
        let y = arrays.optional_output(8 + shift, "y", self.y, n)?;
        // SAFETY: as above.
        unsafe {
            arrays.structure(5 + shift, "settings", self.settings, false)?;
            arrays.structure(9 + shift, "report", self.report.cast_const(), true)?;
        }
        arrays.check_overlap()?;

        let position = |argument| match argument {
            Argument::Size | Argument::Dimension => 1,
            Argument::Matrix => 2,
            Argument::LeadingDimension => 3,
            Argument::Load => 4,
            Argument::Covering => 5,
            _ => 5 + shift,
        };
        let from_error = |error| Failure::from_error(error, position);
        guard::reserve_estimate(memory(n))?;
        let lcp = Lcp::new(n, matrix, ld, q, cover).map_err(from_error)?;
        received.settings.method = self.method.unwrap_or(received.settings.method);
        let solution = received
            .monitored(|monitor| solve_lcp(&lcp, &received.settings, monitor))
            .map_err(from_error)?;

        let status = code(solution.status);
        if solution.status != Status::Solved {
            remember(solution.message.clone());
        }
        // SAFETY: the outputs have the lengths of the header and overlap nothing.
        unsafe {
            w.write(&solution.w);
            z.write(&solution.z);
            y.write(solution.infeasible_by.as_deref().unwrap_or(&vec![0.0; n]));
            SignoriniReport::of_lcp(status, &solution).write(self.report);
        }
        Ok(status)
    }
}
