//! The flexibility form, and pairs whose rows depend on each other.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/rows.rs"]
#[allow(dead_code)] // Each test uses a part.
mod rows;
#[path = "../common/wall.rs"]
#[allow(dead_code)] // Each test uses a part.
mod wall;

mod cancelled;
mod closed_forms;
mod dependent_rows;
mod sparse;
mod walls;
