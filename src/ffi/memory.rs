//! How much memory a call may need, before it is made.

use crate::solve;

/// Most bytes that a call may take beside your arrays, for so many unknowns: signorini_solve with N
/// = dim * pairs, and signorini_lcp_solve. A load case of a model: signorini_model_view. A call
/// takes them for every method, law and setting, and holds as much address space in reserve;
/// settings.memory_limit refuses a call that may need more. Each thread keeps some MiB of its own
/// for matrix products, which are not counted.
///
/// @param n  number of unknowns
/// @return bytes; -1 if n is negative
#[unsafe(no_mangle)]
pub extern "C" fn signorini_solve_memory(n: i64) -> i64 {
    let n = usize::try_from(n).ok();
    n.map_or(-1, |n| i64::try_from(solve::memory(n)).unwrap_or(i64::MAX))
}
