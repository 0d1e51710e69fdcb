//! Measures and proofs in other units than those of the host.

use super::measure::Certificate;
use super::proof::Proof;
use crate::problem::Units;

/// The smallest number.
const LEAST: f64 = f64::from_bits(1);

impl Certificate {
    /// The certificate in the host's units. Forces among the smallest doubles are rounded, which
    /// [`Certificate::equilibrium`] counts; a force beyond doubles is no solution.
    pub(crate) fn to_host(&self, units: Units) -> Self {
        let force: Vec<f64> = self.force.iter().map(|&force| units.host_force(force)).collect();
        let rounded = if units.keeps_forces(&self.force) { 0.0 } else { LEAST };
        let beyond = force.iter().any(|force| force.abs() == f64::MAX);
        Certificate {
            eta: if beyond { self.eta.max(1.0) } else { self.eta },
            residual: if beyond { self.residual.max(1.0) } else { self.residual },
            penetration: units.host_length(self.penetration),
            tension: units.host_force(self.tension),
            cone_excess: units.host_force(self.cone_excess),
            equilibrium: units.host_force(self.equilibrium) + rounded,
            force,
            states: self.states.clone(),
            ..*self
        }
    }
}

impl Proof {
    /// The proof in the host's units. Radii count the rounding of what is among the smallest doubles.
    pub(crate) fn to_host(&self, units: Units) -> Self {
        let lengths =
            |values: &[f64]| values.iter().map(|&value| units.host_length(value)).collect();
        let widened = |radius: f64, exact: bool| if exact { radius } else { radius + 3.0 * LEAST };
        let mut lengths_of = [&self.d, &self.d_low, &self.d_radius].into_iter();
        let keeps_lengths = lengths_of.all(|d| units.keeps_lengths(d));
        let keeps_forces =
            units.keeps_forces(&self.force) && units.keeps_forces(&self.force_radius);
        let d_radius = |&radius| widened(units.host_length(radius), keeps_lengths);
        let force_radius = |&radius| widened(units.host_force(radius), keeps_forces);
        Proof {
            d: lengths(&self.d),
            d_low: lengths(&self.d_low),
            d_radius: self.d_radius.iter().map(d_radius).collect(),
            force: self.force.iter().map(|&force| units.host_force(force)).collect(),
            force_radius: self.force_radius.iter().map(force_radius).collect(),
        }
    }
}
