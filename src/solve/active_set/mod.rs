//! Active-set methods: a linear system is solved for the branches of all pairs, and its solution
//! selects the next branches.

mod block_pivoting;
mod bordered;
mod linear_system;
mod newton;

pub use block_pivoting::{contact, enough, lcp};
pub use newton::{from_branches, solve as newton};
