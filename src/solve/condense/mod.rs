//! Static condensation of components that carry no contact force.

mod free_block;
mod normal_problem;

pub use free_block::FreeBlock;
pub use normal_problem::{INDEFINITE, NormalProblem, driven_motion};
