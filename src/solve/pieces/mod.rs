//! The system of equations on given pieces of the law.
//!
//! `equations` holds the equations of some pairs and a point of them, `system` the factorised system of a point. Where
//! the law is linear on each piece, in the plane and in complementarity problems, `systems` solves the system of one
//! choice of pieces after the other, by a factor that is kept and terms for the pairs that have changed (`updated`).

mod columns;
mod equations;
mod system;
mod systems;
mod updated;

pub use equations::{Equations, Point};
pub use system::{Border, System};
pub use systems::{REFINEMENTS, SMALL, Systems};
pub use updated::Updated;
