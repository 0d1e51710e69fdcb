//! Problems to files, to be mailed and replayed.

use libc::c_char;

use super::args::c_entry;
use super::case_arguments::{CaseArguments, CondensedArguments};
use super::guard::{number_of, refused};
use super::lcp::LCP_ARGUMENTS;
use super::model::SignoriniModel;
use crate::file;
use crate::problem::ContactProblem;
use crate::problem::Lcp;

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
    const FIRST: i32 = 2;
    const REMARK: i32 = FIRST + CondensedArguments::COUNT;
    let given =
        CondensedArguments { first: FIRST, dim, pairs, K, ldk, f, gap, law, friction, slip0 };
    c_entry!(|arrays| {
        let path = arrays.at(1, "path").path(path)?;
        let data = given.read(arrays)?;
        let remark = arrays.at(REMARK, "remark").text(remark)?;
        ContactProblem::on_checked_matrix(data)
            .and_then(|problem| file::write(path, &problem, remark))
            .map_err(refused(|argument| given.position(argument, REMARK)))?;
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
        let (matrix, ld) = arrays.at(3, "M").square(M, ("ldm", ldm), n)?;
        let q = arrays.at(5, "q").required(q, n)?;
        let cover = arrays.at(6, "cover").optional(cover, n)?;
        Lcp::new(n, matrix, ld, q, cover)
            .and_then(|lcp| file::write_lcp(path, &lcp, remark))
            .map_err(refused(|wrong| number_of(wrong, 2, &LCP_ARGUMENTS).unwrap_or(REMARK)))?;
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
        let model = arrays.model(model)?;
        let path = arrays.at(2, "path").path(path)?;
        let case = given.read(arrays, model, 1, 0)?.case(0);
        let remark = arrays.at(REMARK, "remark").text(remark)?;
        let position = |argument| given.position(argument, REMARK);
        model.write_case(path, &case, remark).map_err(refused(position))?;
        Ok(0)
    })
}
