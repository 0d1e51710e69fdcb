//! Lemke's method: for LCPs, for frictionless contact and for friction in 2D.

mod bimatrix;
mod contact;
mod path;
mod rank_one_updates;
mod refactorisation;
mod scaled;
mod tableau;

pub use bimatrix::missing_label;
pub use contact::{ends, solve as contact};
pub use path::{LemkeRules, follow};
pub use scaled::Scaled;
