//! The plan: which methods solve a problem, in which order, and what is said beside the result.

mod auto;
mod distant_gaps;
mod remarks;
mod table;
mod ties;

pub use auto::solve as auto;
pub use distant_gaps::{FAR, solve};
pub use remarks::{add_remarks, remark_on_data, say_remarks};
pub use ties::{memory_of_ties, without_ties};
