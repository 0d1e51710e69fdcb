//! A smaller problem on some of the pairs, candidates or those in question, with the others open or stuck
//! (`reduced_problem`), and one without the components that carry no contact force (`contact_lcp`).

mod contact_lcp;
mod pair_data;
mod reduced_problem;
mod touching;

pub use contact_lcp::ContactLcp;
pub use pair_data::PairData;
pub use reduced_problem::ReducedProblem;
pub use touching::{closed_with_margin, many_are_open};
