//! A smaller problem on some of the pairs, or on some of their components, with the others fixed in a state.
//!
//! | file | kept | fixed |
//! |---|---|---|
//! | `reduced_problem` | candidates, or pairs in question: as equations, or as a contact problem | pairs that are open, and pairs that stick |
//! | `normal_problem` | normal components, as an LCP | components that carry no contact force (`free_block`) |

mod free_block;
mod normal_problem;
mod pair_data;
mod reduced_problem;
mod touching;

pub use free_block::FreeBlock;
pub use normal_problem::{INDEFINITE, NormalProblem, driven_motion};
pub use pair_data::PairData;
pub use reduced_problem::ReducedProblem;
pub use touching::{MARGIN, closed_with_margin};
