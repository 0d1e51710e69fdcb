//! The divergence of sweeps along a rigid-body motion.
//!
//! The drift is the change of displacements between two looks. Components that did not move are taken as fixed. If the
//! matrix is singular on the others, its factor tells which of them depend on the rest: the null vector
//! that agrees with the drift on these has none of the drift's elastic part.

use crate::certificate::{is_escape_of, lifts};
use crate::law::{Contact, lift};
use crate::linalg::vector::norm_inf;
use crate::monitor::Monitor;
use crate::problem::FreeBlock;
use crate::solve::rigid::escape;

/// A recession direction of a contact problem, from the drift of its displacements.
///
/// A body that slides away drifts along the slip of its friction. Where that is the slip from which
/// friction takes the most work, the drift proves that nothing stops it. Under a collinear rule it is
/// another one, and the balance of the rigid motions is asked.
pub fn contact_recession(
    contact: &Contact<'_>,
    drift: &[f64],
    monitor: &mut Monitor<'_>,
) -> Option<Vec<f64>> {
    let moved: Vec<usize> = (0..drift.len()).filter(|&i| drift[i] != 0.0).collect();
    let block = FreeBlock::of_problem(contact.problem(), moved, &mut monitor.asking())?;
    // The part of the drift that the matrix does not resist.
    let mut motion = vec![0.0; drift.len()];
    block.dependent().for_each(|i| motion[i] = drift[i]);
    block.follow(&mut motion);
    let lifts = lifts(contact, &motion);
    // A slip together with a lift of each pair, which makes contact forces do no negative work on it. Off a plane it is
    // rigid if all are lifted by the same.
    let uniform = vec![norm_inf(&lifts); lifts.len()];
    [vec![0.0; lifts.len()], lifts, uniform]
        .into_iter()
        .map(|lifts| {
            let mut motion = motion.clone();
            let pairs = motion.chunks_exact_mut(contact.dim());
            pairs.zip(lifts).for_each(|(r, by)| lift(r, by));
            motion
        })
        .find(|motion| is_escape_of(contact, motion))
        .or_else(|| contact.has_collinear_slip().then(|| escape(contact, monitor)).flatten())
}
