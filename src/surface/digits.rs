//! What coordinates of few digits, as those of decks, leave open.

use super::sweep::Bounds;
use crate::linalg::vector3::vector;

/// A node is on a plane if it is nearer than this part of the size of its side: ten times the error of
/// coordinates with seven digits.
pub(super) const ON_PLANE: f64 = 1e-6;

/// How far apart, in the host's unit, two nodes may be that stand at one place but for the digits of their coordinates.
pub(super) fn left_open(dim: usize, coordinates: &[f64]) -> f64 {
    let Bounds { low, high } = Bounds::of(coordinates.chunks_exact(dim).map(vector));
    let size = (high - low).amax();
    let rounding = last_digit(coordinates) * (dim as f64).sqrt();
    let largest = low.amax().max(high.amax());
    // Two places of one point in coordinates of five digits are no further apart.
    let most = 2e-4 * largest;
    f64::max(ON_PLANE * size, rounding.min(most))
}

/// The place of the last digit that the largest of some numbers has, if none has more than a few: .001 of 12.345 and .25;
/// else 0.
fn last_digit(values: &[f64]) -> f64 {
    // A number has more digits if nobody has rounded it.
    let few = 8;
    let (mut largest, mut most) = (0.0_f64, 0);
    for value in values.iter().filter(|value| **value != 0.0) {
        // Of 13 digits: those behind come from the product with another unit.
        let shown = format!("{:.12e}", value.abs());
        let Some((digits, _)) = shown.split_once('e') else { return 0.0 };
        let count = digits.trim_end_matches('0').bytes().filter(u8::is_ascii_digit).count();
        if count > few {
            return 0.0;
        }
        (largest, most) = (largest.max(value.abs()), most.max(count));
    }
    if largest == 0.0 { 0.0 } else { 10.0_f64.powf(largest.log10().floor() - most as f64 + 1.0) }
}
