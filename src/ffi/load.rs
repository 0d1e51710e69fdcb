//! Problems from files.

use libc::c_char;
use std::ffi::CString;
use std::ptr::null;

use super::args;
use super::guard::{self, Failure};
use crate::file::{self, Kind, ProblemFile};

/// A problem of signorini_problem_load is one of signorini_solve.
pub const SIGNORINI_PROBLEM_COULOMB: i32 = 0;
/// A problem of signorini_problem_load is one of signorini_tresca.
pub const SIGNORINI_PROBLEM_TRESCA: i32 = 1;
/// A problem of signorini_problem_load is one of signorini_lcp_solve.
pub const SIGNORINI_PROBLEM_LCP: i32 = 2;

/// A problem that was read from a file, by signorini_problem_load; released by
/// signorini_problem_free. It does not change, and several threads may use it at once.
pub struct SignoriniProblem {
    problem: ProblemFile,
    remark: CString,
}

/// Reads a problem from a file. Whatever the file holds, the call ends with a problem or with a
/// sentence that names the line.
///
/// @param path     name of the file
/// @param problem  out: the problem, NULL unless 0 is returned
/// @return 0; -k the k-th argument is wrong; SIGNORINI_FILE: the file cannot be read, or is not a
///         complete problem file; SIGNORINI_OUT_OF_MEMORY
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_load(
    path: *const c_char,
    problem: *mut *mut SignoriniProblem,
) -> i32 {
    guard::call(|| {
        if problem.is_null() || !problem.is_aligned() {
            return Err(Failure::argument(2, "problem is NULL or not aligned"));
        }
        // SAFETY: a place for a pointer and a text, by the header's contract.
        let path = unsafe {
            problem.write(std::ptr::null_mut());
            args::path(1, path)?
        };
        let loaded = file::read(path).map_err(|error| Failure::from_error(error, |_| 1))?;
        // Without zeros, as it has no control characters.
        let remark = CString::new(loaded.remark.as_str()).unwrap_or_default();
        // SAFETY: as above.
        unsafe {
            problem.write(Box::into_raw(Box::new(SignoriniProblem { problem: loaded, remark })));
        }
        Ok(0)
    })
}

/// Releases a problem. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_free(problem: *mut SignoriniProblem) {
    guard::call(|| {
        if !problem.is_null() {
            // SAFETY: by the header's contract it came from signorini_problem_load, once.
            drop(unsafe { Box::from_raw(problem) });
        }
        Ok(0)
    });
}

/// What kind of problem it is: SIGNORINI_PROBLEM_...; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_kind(problem: *const SignoriniProblem) -> i32 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| kind_code(problem.kind)) }
}

/// Space dimension, 2 or 3; 0 of a bare complementarity problem; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_dim(problem: *const SignoriniProblem) -> i32 {
    // SAFETY: as above.
    unsafe { look(problem, -1, |problem| problem.dim as i32) }
}

/// Number of contact pairs; 0 of a bare complementarity problem; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_pairs(problem: *const SignoriniProblem) -> i64 {
    // SAFETY: as above.
    unsafe { look(problem, -1, |problem| problem.pairs as i64) }
}

/// Number of unknowns, N = dim * pairs or n; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_size(problem: *const SignoriniProblem) -> i64 {
    // SAFETY: as above.
    unsafe { look(problem, -1, |problem| problem.size as i64) }
}

/// K or M: as many columns as unknowns, without space between them. This and the other arrays of a
/// problem are valid until signorini_problem_free, and NULL if they have no entries.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_matrix(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| array(&problem.matrix)) }
}

/// f or q.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_vector(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| array(&problem.load)) }
}

/// Gaps, one for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_gap(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| array(&problem.gap)) }
}

/// mu, or g of SIGNORINI_PROBLEM_TRESCA, one for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_friction(
    problem: *const SignoriniProblem,
) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| array(&problem.friction)) }
}

/// Tangential displacement at rest, dim - 1 for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_slip(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| array(&problem.slip)) }
}

/// Covering vector of a bare complementarity problem; NULL: none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_cover(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: as above.
    unsafe { look(problem, null(), |problem| problem.covering.as_deref().map_or(null(), array)) }
}

/// The remark of who wrote the file, UTF-8; empty if there is none or problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_remark(
    problem: *const SignoriniProblem,
) -> *const c_char {
    // SAFETY: as above.
    unsafe { problem.as_ref() }.map_or(c"".as_ptr(), |problem| problem.remark.as_ptr())
}

/// # Safety
/// NULL or a problem that lives during the call.
unsafe fn look<T>(
    problem: *const SignoriniProblem,
    otherwise: T,
    at: impl FnOnce(&ProblemFile) -> T,
) -> T {
    // SAFETY: by the caller's contract.
    unsafe { problem.as_ref() }.map_or(otherwise, |problem| at(&problem.problem))
}

fn array(values: &[f64]) -> *const f64 {
    if values.is_empty() { null() } else { values.as_ptr() }
}

fn kind_code(kind: Kind) -> i32 {
    match kind {
        Kind::Coulomb => SIGNORINI_PROBLEM_COULOMB,
        Kind::Tresca => SIGNORINI_PROBLEM_TRESCA,
        Kind::Lcp => SIGNORINI_PROBLEM_LCP,
    }
}
