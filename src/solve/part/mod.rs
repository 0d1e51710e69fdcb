//! A smaller problem on some of the pairs, candidates or those in question, with the others open or stuck
//! (`reduced_problem`), and the equilibrium of components that carry no contact force (`problem::free_block`).

mod normal_problem;
mod pair_data;
mod reduced_problem;
mod touching;

pub use normal_problem::{INDEFINITE, NormalProblem, driven_motion};
pub use pair_data::PairData;
pub use reduced_problem::ReducedProblem;
pub use touching::{closed_with_margin, many_are_open};
