//! Results: the internal one of a method, its certification, and the public one; and the memory that a call takes.

mod call;
mod candidate;
mod certified;
mod ending;
mod memory;
mod solution;

pub use call::Call;
pub use candidate::{Candidate, Effort};
pub use certified::certified;
pub use ending::{CAUSES, Ending, NO_EQUILIBRIUM, wanted};
pub use memory::{check_limit, memory, memory_flexibility, memory_of_flexibility};
pub use solution::{
    Errors, Escape, Existence, Fallback, Remarks, SecondSolution, Solution, Solve, Status,
    Uniqueness,
};
