//! Input: bad, odd and at the edges, and the budgets of a call.

#[path = "../common/mod.rs"]
mod common;

mod bad_input;
mod budgets;
mod counting;
mod odd_input;
