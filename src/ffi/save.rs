//! Problems to files, to be mailed and replayed.

use libc::c_char;

use super::args::{self, Arrays, matrix_length, size, sizes, text};
use super::guard::{self, Failure};
use super::model::{SignoriniModel, receive};
use crate::error::Argument;
use crate::file;
use crate::model::LoadCase;
use crate::problem::Lcp;
use crate::problem::{ContactData, ContactProblem, FrictionLaw};

/// Writes the problem of signorini_solve to a file, as text that keeps every bit.
///
/// The file is of the Matrix Market format, one dense matrix of N rows with comments that say what
/// it is: the columns of K, then f, gap and mu in the normal rows, slip in the tangential rows. It
/// is written beside its place under a name that ends in .part and moved there when it is complete.
/// K must be finite; that it is symmetric and semi-definite is not asked here.
///
/// @param path    name of the file, which is replaced if it exists; bytes as for fopen (UTF-8 on
///                Windows)
/// @param dim     space dimension, 2 or 3
/// @param pairs   number of contact pairs, 0 allowed
/// @param K       condensed stiffness, as for signorini_solve
/// @param ldk     entries from one column of K to the next, at least max(1, N)
/// @param f       condensed nodal loads, N
/// @param gap     initial gaps, one for each pair
/// @param mu      friction coefficients, one for each pair
/// @param slip    tangential displacement at rest, dim - 1 for each pair; NULL: zero
/// @param remark  one line of UTF-8 for who reads the file, at most 1000 bytes; NULL: none
/// @return 0; -k the k-th argument is wrong; SIGNORINI_FILE: the file cannot be written, and an old
///         one is as it was
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the names of the mechanics, which the header shows
pub unsafe extern "C" fn signorini_problem_save(
    path: *const c_char,
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    remark: *const c_char,
) -> i32 {
    let arguments = Arguments { path, dim, pairs, K, ldk, f, gap, friction: mu, slip, remark };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.save("mu", |mu| FrictionLaw::Coulomb(mu)) })
}

/// Writes the problem of signorini_tresca to a file. The arguments are those of
/// signorini_problem_save, with g in the place of mu.
///
/// @param path    name of the file, which is replaced if it exists
/// @param dim     space dimension, 2 or 3
/// @param pairs   number of contact pairs, 0 allowed
/// @param K       condensed stiffness, as for signorini_solve
/// @param ldk     entries from one column of K to the next, at least max(1, N)
/// @param f       condensed nodal loads, N
/// @param gap     initial gaps, one for each pair
/// @param g       friction thresholds, one for each pair
/// @param slip    tangential displacement at rest, dim - 1 for each pair; NULL: zero
/// @param remark  one line of UTF-8, at most 1000 bytes; NULL: none
/// @return as signorini_problem_save
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // as above
pub unsafe extern "C" fn signorini_tresca_save(
    path: *const c_char,
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    g: *const f64,
    slip: *const f64,
    remark: *const c_char,
) -> i32 {
    let arguments = Arguments { path, dim, pairs, K, ldk, f, gap, friction: g, slip, remark };
    // SAFETY: the caller's contract, which the header states.
    guard::call(|| unsafe { arguments.save("g", |g| FrictionLaw::Tresca(g)) })
}

#[allow(non_snake_case)] // as above
struct Arguments {
    path: *const c_char,
    dim: i32,
    pairs: i64,
    K: *const f64,
    ldk: i64,
    f: *const f64,
    gap: *const f64,
    friction: *const f64,
    slip: *const f64,
    remark: *const c_char,
}

impl Arguments {
    /// # Safety
    /// Every pointer is NULL or has the length that the header demands; texts end with a zero.
    unsafe fn save(
        &self,
        friction_name: &'static str,
        friction: impl for<'a> Fn(&'a [f64]) -> FrictionLaw<'a>,
    ) -> Result<i32, Failure> {
        // SAFETY: as the header demands.
        let (path, remark) =
            unsafe { (args::path(1, self.path)?, text(10, "remark", self.remark)?) };
        let (dim, pairs, n) = sizes(self.dim, self.pairs).map_err(|failure| failure.later(1))?;
        let ld = size(5, "ldk", self.ldk)?;
        let entries = matrix_length(5, "K", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (stiffness, load, gap, friction_values, reference_slip) = unsafe {
            (
                arrays.input(4, "K", self.K, entries, true)?.unwrap_or_default(),
                arrays.input(6, "f", self.f, n, true)?.unwrap_or_default(),
                arrays.input(7, "gap", self.gap, pairs, true)?.unwrap_or_default(),
                arrays.input(8, friction_name, self.friction, pairs, true)?.unwrap_or_default(),
                arrays.input(9, "slip", self.slip, n - pairs, false)?,
            )
        };
        ContactProblem::on_checked_matrix(ContactData {
            dim,
            pairs,
            stiffness,
            ld,
            load,
            gap,
            law: friction(friction_values),
            reference_slip,
        })
        .and_then(|problem| file::write(path, &problem, remark))
        .map_err(|error| Failure::from_error(error, position))?;
        Ok(0)
    }
}

fn position(argument: Argument) -> i32 {
    match argument {
        Argument::Dimension => 2,
        Argument::Size => 3,
        Argument::Matrix => 4,
        Argument::LeadingDimension => 5,
        Argument::Load => 6,
        Argument::Gap => 7,
        Argument::Law => 8,
        Argument::ReferenceSlip => 9,
        Argument::Remark => 10,
        other => unreachable!("these calls have no argument {other:?}"),
    }
}

/// Writes the problem of signorini_lcp_solve or signorini_lcp_lemke to a file, as
/// signorini_problem_save does: the columns of M, then q and, if given, cover.
///
/// @param path    name of the file, which is replaced if it exists
/// @param n       number of unknowns, 0 allowed
/// @param M       n columns of n entries, column-major
/// @param ldm     entries from one column of M to the next, at least max(1, n)
/// @param q       n
/// @param cover   covering vector, n positive entries; NULL: none
/// @param remark  one line of UTF-8, at most 1000 bytes; NULL: none
/// @return as signorini_problem_save
#[unsafe(no_mangle)]
#[allow(non_snake_case)] // the name of the mathematics, which the header shows
pub unsafe extern "C" fn signorini_lcp_save(
    path: *const c_char,
    n: i64,
    M: *const f64,
    ldm: i64,
    q: *const f64,
    cover: *const f64,
    remark: *const c_char,
) -> i32 {
    guard::call(|| {
        // SAFETY: as the header demands.
        let (path, remark) = unsafe { (args::path(1, path)?, text(7, "remark", remark)?) };
        let n = size(2, "n", n)?;
        let ld = size(4, "ldm", ldm)?;
        let entries = matrix_length(4, "M", n, ld)?;
        let mut arrays = Arrays::default();
        // SAFETY: the lengths are those of the header.
        let (matrix, q, cover) = unsafe {
            (
                arrays.input(3, "M", M, entries, true)?.unwrap_or_default(),
                arrays.input(5, "q", q, n, true)?.unwrap_or_default(),
                arrays.input(6, "cover", cover, n, false)?,
            )
        };
        Lcp::new(n, matrix, ld, q, cover)
            .and_then(|lcp| file::write_lcp(path, &lcp, remark))
            .map_err(|error| {
                Failure::from_error(error, |argument| match argument {
                    Argument::Size => 2,
                    Argument::Matrix => 3,
                    Argument::LeadingDimension => 4,
                    Argument::Load => 5,
                    Argument::Covering => 6,
                    _ => 7,
                })
            })?;
        Ok(0)
    })
}

/// Writes the condensed problem that signorini_model_solve solves for a load case to a file, as
/// signorini_problem_save does. signorini_solve gives the same d and F for it.
///
/// @param model       the model
/// @param path        name of the file, which is replaced if it exists
/// @param f           nodal loads of the host, H = signorini_model_host_size entries
/// @param prescribed  values of the fixed degrees of freedom, in their order; NULL: zero
/// @param gap         gaps, one for each pair
/// @param mu          friction coefficients, one for each pair
/// @param slip        tangential displacement at rest, dim - 1 for each pair; NULL: zero
/// @param remark      one line of UTF-8, at most 1000 bytes; NULL: none
/// @return as signorini_problem_save
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_save_case(
    model: *const SignoriniModel,
    path: *const c_char,
    f: *const f64,
    prescribed: *const f64,
    gap: *const f64,
    mu: *const f64,
    slip: *const f64,
    remark: *const c_char,
) -> i32 {
    guard::call(|| {
        let mut arrays = Arrays::default();
        // SAFETY: a model, arrays and texts as the header demands.
        let (model, path, remark, case) = unsafe {
            let model = receive(model)?;
            let (pairs, fixed) = (model.pairs(), model.fixed_count());
            let slips = (model.dim() - 1) * pairs;
            let mu = arrays.input(6, "mu", mu, pairs, true)?.unwrap_or_default();
            let case = LoadCase {
                load: arrays.input(3, "f", f, model.host_size(), true)?.unwrap_or_default(),
                prescribed: arrays.input(4, "prescribed", prescribed, fixed, false)?,
                gap: arrays.input(5, "gap", gap, pairs, true)?.unwrap_or_default(),
                law: FrictionLaw::Coulomb(mu),
                reference_slip: arrays.input(7, "slip", slip, slips, false)?,
            };
            (model, args::path(2, path)?, text(8, "remark", remark)?, case)
        };
        model.write_case(path, &case, remark).map_err(|error| {
            Failure::from_error(error, |argument| match argument {
                Argument::Load => 3,
                Argument::Prescribed => 4,
                Argument::Gap => 5,
                Argument::Law => 6,
                Argument::ReferenceSlip => 7,
                Argument::Remark => 8,
                _ => 1,
            })
        })?;
        Ok(0)
    })
}
