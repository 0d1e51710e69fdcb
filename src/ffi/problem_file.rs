//! Problems from files and to them, to be mailed and replayed.

use libc::c_char;
use std::ffi::CString;

use super::args::c_entry;
use super::case_arguments::{CaseArguments, CondensedArguments};
use super::guard;
use super::handle::release;
use super::model::SignoriniModel;
use super::numbers::Numbered;
use super::structures::address;
use crate::error::Argument;
use crate::file::{self, Kind, ProblemFile};
use crate::problem::{ContactProblem, Lcp};

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
        place.fill(file::read(path).map_err(arrays.refused(1))?)
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

/// Writes the problem of signorini_solve to a file, as text that keeps every bit.
///
/// The file is a dense matrix in the Matrix Market format: the columns of K, f, gap, friction and
/// slip0, and comment lines that say so. It is written beside its place under a name that ends in
/// .part, then renamed: it appears only when it is complete. A file that it replaces hands on its
/// mode; through a symbolic link the file is replaced that it names; pipes, devices and links to
/// nothing are refused. K must be finite; its symmetry and definiteness are not checked.
///
/// @param path    name of the file, which is replaced if it exists; bytes as for fopen (UTF-8 on
///                Windows)
/// @param dim,pairs,K,ldk,f,gap,law,friction,slip0  as for signorini_solve
/// @param remark  one line of UTF-8 for the reader of the file, at most 1000 bytes, that does not
///                begin or end with a space; may be NULL
/// @return the status; after SIGNORINI_STATUS_FILE an old file is unchanged
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_problem_write(
    path: *const c_char,
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    remark: *const c_char,
) -> i32 {
    const REMARK: i32 = 11;
    let given = CondensedArguments { first: 2, dim, pairs, K, ldk, f, gap, law, friction, slip0 };
    c_entry!(|arrays| {
        let path = arrays.at(1, "path").path(path)?;
        let data = given.read(arrays)?;
        let remark = arrays.at(REMARK, "remark").text(remark)?;
        ContactProblem::on_checked_matrix(data)
            .and_then(|problem| file::write(path, &problem, remark))
            .map_err(arrays.refused(REMARK))?;
        Ok(0)
    })
}

/// Writes the problem of signorini_lcp_solve as signorini_problem_write does: the columns of M, q
/// and, if given, cover.
///
/// @param path,remark  as for signorini_problem_write
/// @param n,M,ldm,q    as for signorini_lcp_solve
/// @param cover        covering vector, n positive entries; may be NULL
/// @return as signorini_problem_write
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_lcp_write(
    path: *const c_char,
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    cover: *const f64,
    remark: *const c_char,
) -> i32 {
    const REMARK: i32 = 7;
    c_entry!(|arrays| {
        let path = arrays.at(1, "path").path(path)?;
        let remark = arrays.at(REMARK, "remark").text(remark)?;
        let n = arrays.at(2, "n").size(n)?;
        let (matrix, ld) = arrays.at(3, "M").is(Argument::Matrix).square(M, ("ldm", ldm), n)?;
        let q = arrays.at(5, "q").is(Argument::Load).required(q, n)?;
        let cover = arrays.at(6, "cover").is(Argument::Covering).optional(cover, n)?;
        Lcp::new(n, matrix, ld, q, cover)
            .and_then(|lcp| file::write_lcp(path, &lcp, remark))
            .map_err(arrays.refused(REMARK))?;
        Ok(0)
    })
}

/// Writes a load case of a model as signorini_problem_write does: the condensed problem, for which
/// signorini_solve gives the same d and F. If pairs depend on each other there is none: -1 is
/// returned.
///
/// @param model        the model
/// @param path,remark  as for signorini_problem_write
/// @param f,prescribed,gap,law,friction,slip0  as for signorini_model_solve
/// @return as signorini_problem_write
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_write(
    model: *const SignoriniModel,
    path: *const c_char,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    law: i32,
    friction: *const f64,
    slip0: *const f64,
    remark: *const c_char,
) -> i32 {
    const REMARK: i32 = 9;
    let given = CaseArguments { first: 3, f, prescribed, gap, law, friction, slip0 };
    c_entry!(|arrays| {
        let model = &arrays.model(model)?.model;
        let path = arrays.at(2, "path").path(path)?;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        let remark = arrays.at(REMARK, "remark").text(remark)?;
        model.write_case(path, &case, remark).map_err(arrays.refused(REMARK))?;
        Ok(0)
    })
}
