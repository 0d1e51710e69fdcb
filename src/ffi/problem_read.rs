//! Problems from files.

use libc::c_char;
use std::ffi::CString;

use super::args;
use super::guard::{self, Failure};
use super::law;
use super::release::release;
use super::structures::{address, show};
use crate::file::{self, Kind, ProblemFile};
use crate::shortage;

/// A contact problem, of signorini_solve.
pub const SIGNORINI_PROBLEM_CONTACT: i32 = 0;
/// An LCP, of signorini_lcp_solve.
pub const SIGNORINI_PROBLEM_LCP: i32 = 1;

/// A problem from a file. It does not change: several threads may use one at once.
/// signorini_problem_free releases it.
pub struct SignoriniProblem {
    problem: ProblemFile,
    remark: CString,
}

/// The content of a problem. Arrays live as long as the problem; one without entries is NULL.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct SignoriniProblemData {
    /// sizeof(signorini_problem_data).
    pub struct_size: u32,
    /// SIGNORINI_PROBLEM_..., the kind of the problem.
    pub kind: i32,
    /// SIGNORINI_LAW_..., the friction law; -1 of an LCP.
    pub law: i32,
    /// Space dimension, 2 or 3; 0 of an LCP.
    pub dim: i32,
    /// Number of contact pairs; 0 of an LCP.
    pub pairs: i64,
    /// Number of unknowns, N = dim * pairs or n.
    pub size: i64,
    /// K or M, column-major; its leading dimension is size.
    pub matrix: *const f64,
    /// Right-hand side: f or q, size entries.
    pub rhs: *const f64,
    /// Gaps, one for each pair.
    pub gap: *const f64,
    /// Parameters of the friction law, pair by pair; NULL if frictionless.
    pub friction: *const f64,
    /// Reference slip, dim - 1 for each pair.
    pub slip0: *const f64,
    /// Covering vector of an LCP; NULL if the file has none.
    pub cover: *const f64,
    /// The remark of the file, UTF-8; empty if there is none.
    pub remark: *const c_char,
}

/// Reads a problem from a file. Any file is safe to read: the call returns either a problem or an
/// error that names the line. Pipes and devices are refused at once.
///
/// @param path     name of the file
/// @param problem  out: the problem; NULL unless 0 is returned
/// @return the status; SIGNORINI_STATUS_FILE: the file cannot be read, or is no complete problem
///         file
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
        // The reserve of a call holds nothing that outlives it.
        shortage::check();
        // SAFETY: as above.
        unsafe { problem.write(Box::into_raw(read)) };
        Ok(0)
    })
}

/// Releases a problem. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_free(problem: *mut SignoriniProblem) {
    // SAFETY: NULL, or by the header's contract it came from signorini_problem_read, once.
    unsafe { release(problem) }
}

/// Fills data, whose struct_size you set before. Its arrays live as long as the problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_view(
    problem: *const SignoriniProblem,
    data: *mut SignoriniProblemData,
) -> i32 {
    // SAFETY: NULL or a problem, and NULL or a structure that begins with its size, by the header's contract.
    unsafe { show("problem", problem, data, SignoriniProblem::shown) }
}

impl SignoriniProblem {
    fn shown(&self) -> SignoriniProblemData {
        let SignoriniProblem { problem, remark } = self;
        SignoriniProblemData {
            struct_size: size_of::<SignoriniProblemData>() as u32,
            kind: kind_code(problem.kind),
            law: law_code(problem.kind),
            dim: problem.dim as i32,
            pairs: problem.pairs as i64,
            size: problem.size as i64,
            matrix: address(&problem.matrix),
            rhs: address(&problem.load),
            gap: address(&problem.gap),
            friction: address(&problem.friction),
            slip0: address(&problem.reference_slip),
            cover: problem.covering.as_deref().map_or(std::ptr::null(), address),
            remark: remark.as_ptr(),
        }
    }
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
