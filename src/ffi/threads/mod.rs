//! Threads of a call: none runs before the call begins or after it ends, and the results do not depend on them.
//!
//! They share the parts of one work after another: of a factorisation, or load cases in a row.

mod system_thread;
mod worker_pool;

pub(super) use worker_pool::with_threads;
