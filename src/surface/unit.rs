//! The unit of lengths inside of the pairing: a power of two by which coordinates are below 1, whatever the host's unit is.
//! Scaling by it is exact, so that rows do not depend on the host's unit, and gaps scale with it.

use super::pairs::SurfacePairs;
use super::settings::SurfaceSettings;
use crate::error::{Argument, Error, index};
use crate::linalg::power_of_two::{largest_exponent, times_power_of_two};

/// Lengths inside are those of the host times this exact number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unit {
    pub(super) inside: f64,
    exponent: i32,
}

/// The largest exponent whose power of two has an inverse with all its digits.
const MOST: i32 = 1020;

impl Unit {
    /// The unit of lengths.
    pub(super) fn of(lengths: impl Iterator<Item = f64>) -> Unit {
        let largest = largest_exponent(lengths.filter(|length| length.is_finite()));
        let exponent = largest.map_or(0, |largest| largest + 1).clamp(-MOST, MOST);
        Unit { inside: times_power_of_two(1.0, -exponent), exponent }
    }

    /// Pairs in the host's unit, with the gaps that the settings make of the measured ones.
    ///
    /// # Errors
    /// Areas that no number holds.
    pub(super) fn of_host(
        &self,
        mut found: SurfacePairs,
        settings: &SurfaceSettings,
    ) -> Result<SurfacePairs, Error> {
        found.axisymmetric = settings.axisymmetric;
        let powers = if found.dim == 2 && !found.axisymmetric { 1 } else { 2 };
        let length = |length: &mut f64| *length = times_power_of_two(*length, self.exponent);
        let area = |area: &mut f64| *area = times_power_of_two(*area, powers * self.exponent);
        for pair in &mut found.pairs {
            pair.point.iter_mut().for_each(length);
            length(&mut pair.gap);
            pair.measured_gap = pair.gap;
            pair.gap = settings.gap(pair.gap, pair.moving);
            area(&mut pair.area);
            if !pair.area.is_normal() {
                let message = format!(
                    "the area at node {} is beyond the range of numbers: choose another unit of length",
                    index(pair.slave)
                );
                return Err(Error::invalid(Argument::Coordinates, message));
            }
        }
        let report = &mut found.report;
        length(&mut report.search_distance);
        length(&mut report.overlap_distance);
        report.folded.iter_mut().for_each(|fold| length(&mut fold.distance));
        report.beyond.iter_mut().for_each(|(_, distance)| length(distance));
        report.stand_off.iter_mut().for_each(|(_, both)| both.iter_mut().for_each(length));
        area(&mut report.slave_area);
        area(&mut report.covered_area);
        Ok(found)
    }
}
