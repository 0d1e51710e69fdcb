//! The system of equations on given pieces of the law.
//!
//! `equations` holds the equations of some pairs and a point of them, `system` the factorised system of a point. Where
//! the law is linear on each piece, in the plane and in complementarity problems, a factor is kept: `amended` solves
//! the systems of other pieces near a factorised one (`systems`), and `updated` those of a path from piece to piece.

mod amended;
mod before;
mod columns;
mod equations;
mod held;
mod system;
mod systems;
mod term;
mod updated;

pub use before::Before;
pub use equations::{Equations, Point, Step};
pub use system::System;
pub use systems::{REFINEMENTS, SMALL, Systems};
pub use updated::Updated;
