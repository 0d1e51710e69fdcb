//! Lemke's method: for LCPs, for frictionless contact and for friction in 2D.

mod close_ratios;
mod contact;
mod contact_lcp;
mod path;
mod rank_one_updates;
mod refactorisation;
mod scaled;
mod tableau;
mod trail;

pub use contact::{ends, solve as contact};
pub use path::{LemkeRules, LemkeRun, Refactorising, ScaledLcp, follow};
