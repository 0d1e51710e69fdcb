//! The motion that loads drive where no equilibrium exists, in words.

use super::Reduction;
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::linalg::vector::{combination, norm_inf};

/// The motion `d` that relative loads drive, in words: the parts that move, the resultant of the loads along it,
/// and the part of it that nothing balances; then the force that is left, where the host's axes are known.
pub(crate) fn driven_motion(
    (reduction, dim): (&dyn Reduction, usize),
    load: &[f64],
    (d, unbalanced): (&[f64], &[f64]),
) -> [String; 2] {
    let largest = norm_inf(&reduction.displacements_of_motion(d));
    let along = |force: &[f64]| force.iter().zip(d).map(|(f, d)| f * d).sum::<f64>() / largest;
    let left = match reduction.frames() {
        Some(frames) => format!(" In the axes of K the force is {}", force(frames, unbalanced, d)),
        None => String::new(),
    };
    let moves = format!(
        "it moves {}; the resultant of the loads along it is {:.3e}, and contact leaves {:.3e} of it",
        reduction.motion_in_words(dim, d).marked(),
        along(load),
        along(unbalanced),
    );
    [moves, left]
}

/// The sum of the forces of pairs that move in the host's axes: `(1.000e0, 0.000e0)`.
fn force(frames: &[f64], forces: &[f64], d: &[f64]) -> String {
    let dim = frames.len() / d.len().max(1);
    let sum = combination(dim, forces.iter().copied().zip(frames.chunks_exact(dim)));
    let least = ROUNDING_OF_SUM * norm_inf(forces) * forces.len() as f64;
    let parts: Vec<String> =
        sum.iter().map(|f| format!("{:.3e}", if f.abs() > least { *f } else { 0.0 })).collect();
    format!("({})", parts.join(", "))
}
