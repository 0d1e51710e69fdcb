//! Linear complementarity problems.

#[path = "../common/mod.rs"]
mod common;

mod block_pivoting;
mod certificate;
mod copositive;
mod enumeration;
mod extremes;
mod games;
mod worst_cases;
