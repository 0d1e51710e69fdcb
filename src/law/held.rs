//! Pairs whose state is taken for decided while that of others is in question.

use super::PairLaw;
use super::branch::{Branch, Tangential};

/// How a pair is held whose state is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// Open, without a force.
    Open,
    /// Sticking, at its reference ([`PairLaw::reference`]).
    Stuck,
}

impl PairLaw {
    /// How a pair is held whose state is decided on `branch`. `None`: it slips, or carries a force when it is
    /// open, so that its state stays in question.
    pub fn held(&self, branch: Branch) -> Option<Held> {
        match (branch.closed, branch.tangential) {
            (false, _) if self.is_free_when_open() => Some(Held::Open),
            (true, Tangential::Stick) => Some(Held::Stuck),
            _ => None,
        }
    }
}
