//! Linear complementarity: block pivoting and Lemke's method, for LCPs and for contact.

mod block_pivoting;
mod lemke;
mod past;
mod refinement;
mod solve;

pub use block_pivoting::contact as block_pivoting;
pub use lemke::{contact as lemke, ends as lemke_ends};
pub use solve::{LcpSolution, solve_lcp};
