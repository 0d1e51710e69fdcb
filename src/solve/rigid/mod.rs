//! Bodies that `K` does not hold: their rigid motions, and what these decide.
//!
//! | file | what it decides |
//! |---|---|
//! | `motions` | which motions are rigid |
//! | `equilibrium` | can contact forces balance the loads on them? |
//! | `idle` | which of them moves a solution further than it must |
//! | `mechanism` | how bodies move that nothing holds |

mod equilibrium;
mod idle;
mod mechanism;
mod motions;

pub use equilibrium::{Balance, escape, escape_behind_others};
pub use idle::{is_held_by_rounding, leave_idle_motion, moves_freely};
pub use mechanism::{describe, describe_run_away};
pub use motions::RigidMotions;
