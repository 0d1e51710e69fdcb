//! Unilateral contact with Coulomb friction for existing finite-element codes.

pub mod certificate;
mod error;
mod ffi;
pub mod law;
mod lcp;
mod linalg;
mod monitor;
mod problem;
mod settings;
mod solve;

pub use error::{Argument, Error};
pub use law::State;
pub use lcp::Lcp;
pub use monitor::{Interruption, Monitor, Progress, ProgressFn};
pub use problem::{ContactData, ContactProblem, Friction};
pub use settings::{Method, Settings};
pub use solve::{LcpSolution, Solution, Status, solve, solve_lcp};
