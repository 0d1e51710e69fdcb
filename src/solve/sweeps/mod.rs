//! Projected over-relaxed Gauss–Seidel (Cryer, Christopherson; paper, section 2).

mod contact_iterate;
mod drift;
mod driver;
mod fixed_point;
mod relaxation;

pub use contact_iterate::Sweeper;
pub use fixed_point::{nested, single};
