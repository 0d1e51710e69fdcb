//! The parts that the files of [`crate::geometry`] take of the library.

#![allow(dead_code)] // The library uses all of it.

#[path = "../../src/linalg/tolerances.rs"]
pub mod tolerances;
#[path = "../../src/linalg/vector3.rs"]
pub mod vector3;
