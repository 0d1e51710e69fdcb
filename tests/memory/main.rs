//! Memory: how much a call takes, and how much it announces.

#![cfg(all(target_os = "linux", target_env = "gnu"))]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/counted.rs"]
#[allow(dead_code)] // Each test uses a part.
mod counted;
#[path = "../common/graded_bar.rs"]
#[allow(dead_code)] // Each test uses a part.
mod graded_bar;

use common::mesh; // graded_bar.rs names it as its sibling, as a bench has it.

mod estimate;
mod peaks;
mod reserve_holes;
