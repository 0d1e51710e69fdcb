//! Threads of a call: none runs before the call begins or after it ends, and the results do not depend on them.
//!
//! Load cases are parted among threads that each solve their own; the parts of a factorisation go to whoever is free.

mod load_case_chunk;
mod one_each;
mod system_thread;
mod worker_pool;

pub(super) use load_case_chunk::{LoadCaseChunk, Solved, Start, ThreadCases, stopped};
pub(super) use one_each::on_each;
pub(super) use worker_pool::with_workers;
