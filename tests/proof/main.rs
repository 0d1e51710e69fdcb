//! Proofs that a solution exists, and statements on other solutions.

#[path = "../bench/bar.rs"]
#[allow(dead_code)] // Each test uses a part.
mod bar;
#[path = "../common/mod.rs"]
mod common;

mod edges;
mod existence;
mod rims;
mod truth;
mod uniqueness;
mod uniqueness_3d;
