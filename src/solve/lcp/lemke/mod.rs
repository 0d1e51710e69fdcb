//! Lemke's method: for LCPs, for frictionless contact and for friction in 2D.

mod close_ratios;
mod friction_2d;
mod friction_2d_lcp;
mod frictionless;
mod path;
mod rank_one_updates;
mod refactorisation;
mod scaled;
mod tableau;
mod trail;

pub use friction_2d::{ends, solve as friction_2d};
pub use frictionless::frictionless;
pub use path::{LemkeRules, LemkeRun, Refactorising, ScaledLcp, follow};
