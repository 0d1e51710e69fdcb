//! Models: many load cases of one reduction.

#[path = "../common/mod.rs"]
mod common;

mod cases;
mod histories;
mod limits;
mod plane_cases;
mod series;
mod slabs;
mod warm_steps;
