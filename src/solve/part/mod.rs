//! A smaller problem on some of the pairs, or on some of their components, with the others fixed in a state.
//!
//! | file | kept | fixed |
//! |---|---|---|
//! | `split` | candidates, in equations of the normal map | pairs that are surely open |
//! | `held_pairs` | pairs in question, as a contact problem | pairs that are open, and pairs that stick |
//! | `normal_problem` | normal components, as an LCP | components that carry no contact force (`free_block`) |

mod free_block;
mod held_pairs;
mod normal_problem;
mod pair_data;
mod split;
mod touching;

pub use free_block::FreeBlock;
pub use held_pairs::Parted;
pub use normal_problem::{INDEFINITE, NormalProblem, driven_motion};
pub use pair_data::PairData;
pub use split::Split;
pub use touching::{MARGIN, closed_with_margin};
