//! Projected over-relaxed Gauss–Seidel (Cryer, Christopherson; paper, section 2).

mod blocks;
mod contact_iterate;
mod drift;
mod driver;
mod fixed_point;
mod frictionless;
mod lcp_iterate;
mod relaxation;

pub use contact_iterate::sweep_in_time as sweep_pairs;
pub use fixed_point::{nested, single};
pub use frictionless::frictionless;
pub use lcp_iterate::sweep as sweep_lcp;

use crate::monitor::Monitor;

/// The iterate that the driver of the sweeps improves.
pub trait Iterate {
    /// One sweep with the over-relaxation factor `omega`. Returns the change in the norm of the
    /// diagonal.
    fn sweep(&mut self, omega: f64) -> f64;

    /// `eta` under the law that the sweeps obey, from the carried residual.
    fn eta_of_sweeps(&self) -> f64 {
        self.eta()
    }

    /// `eta` under the problem's own law, from the carried residual.
    fn eta(&self) -> f64;

    /// Recomputes the carried residual from the unknowns.
    fn refresh(&mut self);

    /// The unknowns.
    fn unknowns(&self) -> &[f64];

    /// Size of the largest force.
    fn largest_force(&self) -> f64;

    /// True if there are no loads.
    fn is_unloaded(&self) -> bool;

    /// A recession direction of the displacements, found in the change of the unknowns between two looks if there is time.
    fn recession(&self, drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>>;
}
