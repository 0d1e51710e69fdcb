//! How much memory a call may need, before it is made.

use crate::solve;

/// Most bytes that a call with n unknowns may take beside your arrays, with any method, law (ties:
/// 8 n n more) and setting: signorini_solve with n = dim * pairs, and signorini_lcp_solve. A call
/// that may need more than memory_limit is refused. Some MiB that each thread keeps are not
/// counted. -1 if n is negative.
#[unsafe(no_mangle)]
pub extern "C" fn signorini_solve_memory(n: i64) -> i64 {
    let n = usize::try_from(n).ok();
    n.map_or(-1, |n| i64::try_from(solve::memory(n)).unwrap_or(i64::MAX))
}
