//! The system of equations on given pieces of the law.
//!
//! `equations` holds the equations of some pairs and a point of them, `system` the factorised system of a point. In
//! the plane, where the law is linear on each piece, `linear_system` solves the system of one choice of rows after
//! the other, by a factor that is kept and borders for the rows that have changed (`bordered`).

mod bordered;
mod columns;
mod equations;
mod linear_system;
mod system;
mod systems;
mod updated;

pub use equations::{Equations, Point};
pub use linear_system::{LinearSystem, Singular};
pub use system::{Border, System};
pub use systems::Systems;
pub use updated::Updated;
