//! Paths of solutions that lead from any start to a solution, for every `mu`.

mod curve;
mod curved;
mod homotopy;

pub use curved::curved;
