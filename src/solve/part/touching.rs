//! The pairs that may touch.

use crate::law::{PairLaw, Piece, Vector};

/// Pairs beside those that are closed: this part of them, and two.
const MARGIN: f64 = 0.15;

/// How many pairs are candidates beside so many closed ones.
fn with_margin(closed: usize) -> usize {
    closed + (MARGIN * closed as f64).ceil() as usize + 2
}

/// True if the candidates of the closed pairs are at most twice the others, without which systems cost a third.
pub fn many_are_open(pieces: &[Piece]) -> bool {
    let candidates = with_margin(pieces.iter().filter(|piece| piece.closed).count());
    candidates <= 2 * pieces.len().saturating_sub(candidates)
}

/// The pairs that are closed at coordinates, those next to closing, and those that carry forces when they are open.
pub fn closed_with_margin(laws: &[PairLaw], y: &[Vector]) -> Vec<usize> {
    let closed = laws.iter().zip(y).filter(|(law, y)| law.piece(y).closed).count();
    let mut order: Vec<usize> = (0..y.len()).filter(|&pair| laws[pair].has_obstacle()).collect();
    let height = |pair: usize| y[pair][0] / laws[pair].scale()[0].sqrt();
    order.sort_by(|&a, &b| height(b).total_cmp(&height(a)));
    order.truncate(with_margin(closed));
    order.extend((0..y.len()).filter(|&pair| !laws[pair].is_free_when_open()));
    order.sort_unstable();
    order.dedup();
    order
}
