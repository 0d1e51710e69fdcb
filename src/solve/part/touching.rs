//! The pairs that may touch.

use crate::law::{PairLaw, Vector};

/// Pairs beside those that are closed: this part of them, and two.
const MARGIN: f64 = 0.15;

/// The pairs that are closed at coordinates, those next to closing, and those that carry forces when they are open.
pub fn closed_with_margin(laws: &[PairLaw], y: &[Vector]) -> Vec<usize> {
    let closed = laws.iter().zip(y).filter(|(law, y)| law.piece(y).closed).count();
    let wanted = closed + (MARGIN * closed as f64).ceil() as usize + 2;
    let mut order: Vec<usize> = (0..y.len()).filter(|&pair| laws[pair].has_obstacle()).collect();
    let height = |pair: usize| y[pair][0] / laws[pair].scale()[0].sqrt();
    order.sort_by(|&a, &b| height(b).total_cmp(&height(a)));
    order.truncate(wanted);
    order.extend((0..y.len()).filter(|&pair| !laws[pair].is_free_when_open()));
    order.sort_unstable();
    order.dedup();
    order
}
