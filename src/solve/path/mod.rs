//! The path: from any start along a curve of solutions of neighbouring problems to a solution.

mod linear;
mod linear_start;
mod linear_system;
mod linear_walk;

pub use linear::linear;
