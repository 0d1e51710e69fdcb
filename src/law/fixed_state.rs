//! Pairs whose state is taken for decided while that of others is in question.

use super::{PairLaw, Piece, Tangential};

/// How a pair is held whose state is decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FixedState {
    /// Open, without a force.
    Open,
    /// Sticking, at its reference ([`PairLaw::reference`]).
    Stuck,
}

impl PairLaw {
    /// How a pair is held whose state is decided on `piece`. `None`: it slips, or carries a force when it is
    /// open, so that its state stays in question.
    pub fn fixed_state(&self, piece: Piece) -> Option<FixedState> {
        match (piece.closed, piece.tangential) {
            (false, _) if self.is_free_when_open() => Some(FixedState::Open),
            (true, Tangential::Stick) => Some(FixedState::Stuck),
            _ => None,
        }
    }
}
