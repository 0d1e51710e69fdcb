//! Input: bad, odd and at the edges, and the budgets of a call; and the linear algebra that all problems stand on.

#[path = "../common/mod.rs"]
mod common;
#[path = "../../src/counters.rs"]
#[allow(dead_code)] // `workers` uses a part.
mod counters;
#[allow(dead_code)] // For the files in `linalg`, which use a part.
#[path = "../../src/workers.rs"]
mod workers;

mod bad_input;
mod budgets;
mod counting;
mod linalg;
mod odd_input;
