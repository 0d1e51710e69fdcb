//! Projected over-relaxed Gauss–Seidel (Cryer, Christopherson; paper, section 2).

mod blocks;
mod driver;
mod fixed_point;
mod frictionless;
mod relaxation;
mod swept;

pub use fixed_point::{nested, single};
pub use frictionless::frictionless;
pub use swept::{sweep_in_time as sweep_pairs, sweep_lcp};
