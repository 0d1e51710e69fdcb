//! Projected over-relaxed Gauss–Seidel (Cryer, Christopherson; paper, section 2).

mod blocks;
mod contact;
mod drift;
mod driver;
mod fixed_point;
mod frictionless;
mod relaxation;

pub use contact::sweep_in_time as sweep_pairs;
pub use fixed_point::{nested, single};
pub use frictionless::{frictionless, sweep as sweep_lcp};

use crate::monitor::Monitor;

/// A problem on which sweeps improve unknowns `x`, with the residual `w` that is carried along.
pub trait Swept {
    /// One sweep with the over-relaxation factor `omega`. Returns the change in the norm of the
    /// diagonal.
    fn sweep(&self, x: &mut [f64], w: &mut [f64], omega: f64) -> f64;

    /// `eta` under the law that the sweeps obey.
    fn eta_of_sweeps(&self, x: &[f64], w: &[f64]) -> f64 {
        self.eta(x, w)
    }

    /// `eta` under the problem's own law.
    fn eta(&self, x: &[f64], w: &[f64]) -> f64;

    /// The residual of unknowns.
    fn residual(&self, x: &[f64]) -> Vec<f64>;

    /// The loads.
    fn load(&self) -> &[f64];

    /// A recession direction of the displacements, found in the change of the unknowns between two looks if there is time.
    fn recession(&self, drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>>;
}
