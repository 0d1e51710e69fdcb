//! How much memory a call may need, before it is made.

use super::model::SignoriniModel;
use crate::solve;

/// Most bytes that a call may take beside your arrays, for so many unknowns: signorini_solve,
/// signorini_certify and signorini_prove with N = dim * pairs, and the LCP calls.
/// signorini_flexibility_solve may take 8 N^2 bytes more; signorini_flexibility_solve_sparse 16 N^2
/// more with the N of its largest island, and 256 bytes for each of all unknowns and 48 for each
/// stored entry of W. A call takes them for every method, law and setting, and holds as much address
/// space in reserve; settings.memory_limit refuses a call that may need more. Each thread keeps some
/// MiB of its own for matrix products, which are not counted.
///
/// @param n  number of unknowns
/// @return bytes; -1 if n is negative
#[unsafe(no_mangle)]
pub extern "C" fn signorini_solve_memory(n: i64) -> i64 {
    let n = usize::try_from(n).ok();
    n.map_or(-1, |n| i64::try_from(solve::memory(n)).unwrap_or(i64::MAX))
}

/// The same for a load case of a model: most bytes that signorini_model_solve may take beside the
/// model and your arrays. Of many load cases each in turn takes them; up to 32 cases at a time take
/// some vectors of H entries each besides. What making a sparse model takes is told to its callback:
/// signorini_progress.
///
/// @param model  the model
/// @return bytes; -1 if model is NULL
#[unsafe(no_mangle)]
pub unsafe extern "C" fn signorini_model_memory(model: *const SignoriniModel) -> i64 {
    // SAFETY: NULL or a model, by the header's contract.
    let model = unsafe { model.as_ref() };
    model.map_or(-1, |model| i64::try_from(model.model().memory()).unwrap_or(i64::MAX))
}
