//! Linear complementarity: block pivoting and Lemke's method, for LCPs and for contact.

mod block_pivoting;
mod lemke;
mod solve;

pub use block_pivoting::{contact as block_pivoting, enough};
pub use lemke::{
    ends as lemke_ends, friction_2d as lemke_friction_2d, frictionless as lemke_frictionless,
};
pub use solve::{LcpSolution, solve_lcp};
