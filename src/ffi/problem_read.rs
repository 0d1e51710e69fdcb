//! Problems from files.

use libc::c_char;
use std::ffi::CString;

use super::args::c_entry;
use super::guard;
use super::handle::release;
use super::numbers::Numbered;
use super::structures::address;
use crate::file::{self, Kind, ProblemFile};

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
    c_entry!(|arrays| {
        let place = arrays.at(2, "problem").out_pointer(problem)?;
        let path = arrays.at(1, "path").path(path)?;
        guard::reserve_estimate(file::memory(path))?;
        place.fill(file::read(path), |_| 1)
    })
}

/// Releases a problem. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_free(problem: *mut SignoriniProblem) {
    // SAFETY: NULL, or by the header's contract it came from signorini_problem_read, once.
    unsafe { release(problem) }
}

/// Fills data, whose struct_size you set. Its arrays live as long as the problem.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_view(
    problem: *const SignoriniProblem,
    data: *mut SignoriniProblemData,
) -> i32 {
    c_entry!(|arrays| {
        let shown = arrays.at(1, "problem").handle(problem)?.shown();
        arrays.at(2, "data").out_structure(data)?.write(0, &shown);
        Ok(0)
    })
}

impl From<ProblemFile> for SignoriniProblem {
    fn from(problem: ProblemFile) -> Self {
        // Without zeros, as it has no control characters.
        let remark = CString::new(problem.remark.as_str()).unwrap_or_default();
        SignoriniProblem { problem, remark }
    }
}

impl SignoriniProblem {
    fn shown(&self) -> SignoriniProblemData {
        let SignoriniProblem { problem, remark } = self;
        let (kind, law) = match problem.kind {
            Kind::Contact(law) => (SIGNORINI_PROBLEM_CONTACT, Numbered::number(law)),
            Kind::Lcp => (SIGNORINI_PROBLEM_LCP, -1),
        };
        SignoriniProblemData {
            struct_size: size_of::<SignoriniProblemData>() as u32,
            kind,
            law,
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
