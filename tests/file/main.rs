//! Problem files.

#[path = "../common/mod.rs"]
mod common;

mod damaged;
mod same_bits;
