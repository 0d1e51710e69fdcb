//! Problems from files.

use libc::c_char;
use std::ffi::CString;
use std::ptr::null;

use super::args;
use super::guard::{self, Failure};
use super::law;
use crate::file::{self, Kind, ProblemFile};
use crate::shortage;

/// A contact problem, of signorini_solve.
pub const SIGNORINI_PROBLEM_CONTACT: i32 = 0;
/// An LCP, of signorini_lcp_solve or, if it has a covering vector, signorini_lcp_lemke.
pub const SIGNORINI_PROBLEM_LCP: i32 = 1;

/// A problem that was read from a file by signorini_problem_read; released by
/// signorini_problem_free. It does not change: several threads may use one at once. Its arrays live
/// as long as it does; an array without entries is NULL.
pub struct SignoriniProblem {
    problem: ProblemFile,
    remark: CString,
}

/// Reads a problem from a file. Any file is safe to read: the call returns either a problem or an
/// error that names the line. Pipes and devices are refused at once.
///
/// @param path     name of the file
/// @param problem  out: the problem; NULL unless 0 is returned
/// @return 0; -k: the k-th argument is wrong; SIGNORINI_STATUS_FILE: the file cannot be read, or is
///         not a complete problem file; SIGNORINI_STATUS_OUT_OF_MEMORY
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_read(
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
        guard::reserve_estimate(file::memory(path))?;
        let loaded = file::read(path).map_err(|error| Failure::from_error(error, |_| 1))?;
        // Without zeros, as it has no control characters.
        let remark = CString::new(loaded.remark.as_str()).unwrap_or_default();
        let read = Box::new(SignoriniProblem { problem: loaded, remark });
        // Nothing that lives on may stand in the reserve of the call.
        shortage::check();
        // SAFETY: as above.
        unsafe { problem.write(Box::into_raw(read)) };
        Ok(0)
    })
}

/// Releases a problem. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_free(problem: *mut SignoriniProblem) {
    guard::call(|| {
        if !problem.is_null() {
            // SAFETY: by the header's contract it came from signorini_problem_read, once.
            drop(unsafe { Box::from_raw(problem) });
        }
        Ok(0)
    });
}

/// SIGNORINI_PROBLEM_..., the kind of the problem; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_kind(problem: *const SignoriniProblem) -> i32 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| kind_code(problem.kind)) }
}

/// SIGNORINI_LAW_..., the friction law; -1 of an LCP or if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_law(problem: *const SignoriniProblem) -> i32 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| law_code(problem.kind)) }
}

/// Space dimension, 2 or 3; 0 of an LCP; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_dim(problem: *const SignoriniProblem) -> i32 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| problem.dim as i32) }
}

/// Number of contact pairs; 0 of an LCP; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_pairs(problem: *const SignoriniProblem) -> i64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| problem.pairs as i64) }
}

/// Number of unknowns, N = dim * pairs or n; -1 if problem is NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_size(problem: *const SignoriniProblem) -> i64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, -1, |problem| problem.size as i64) }
}

/// K or M, column-major; its leading dimension is the number of unknowns.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_matrix(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), |problem| array(&problem.matrix)) }
}

/// Right-hand side: f or q, one entry for each unknown.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_rhs(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), |problem| array(&problem.load)) }
}

/// Gaps, one for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_gap(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), |problem| array(&problem.gap)) }
}

/// Parameters of the friction law, pair by pair; NULL if frictionless.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_friction(
    problem: *const SignoriniProblem,
) -> *const f64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), |problem| array(&problem.friction)) }
}

/// Reference slip, dim - 1 for each pair.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_slip0(problem: *const SignoriniProblem) -> *const f64 {
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), |problem| array(&problem.reference_slip)) }
}

/// Covering vector of an LCP; NULL if the file has none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_cover(problem: *const SignoriniProblem) -> *const f64 {
    let cover = |problem: &ProblemFile| problem.covering.as_deref().map_or(null(), array);
    // SAFETY: NULL or a problem, by the header's contract.
    unsafe { look(problem, null(), cover) }
}

/// The remark of the file, UTF-8; empty if there is none or problem is NULL. It lives as long as
/// the problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_remark(
    problem: *const SignoriniProblem,
) -> *const c_char {
    // SAFETY: NULL or a problem, by the header's contract.
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
        Kind::Contact(_) => SIGNORINI_PROBLEM_CONTACT,
        Kind::Lcp => SIGNORINI_PROBLEM_LCP,
    }
}

fn law_code(kind: Kind) -> i32 {
    match kind {
        Kind::Contact(law) => law::code(law),
        Kind::Lcp => -1,
    }
}
