//! The certificate: its measures, their bounds, and the proofs that no equilibrium exists.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/general_rows.rs"]
#[allow(dead_code)] // Each test uses a part.
mod general_rows;

mod bounds;
mod condensed_rounding;
mod escape;
mod formulas;
mod relation;
mod thresholds;
mod units;
