//! Sweeps on an LCP with lower bounds, variable by variable.

use super::Swept;
use super::blocks::over_all;
use crate::law::Contact;
use crate::monitor::Monitor;
use crate::problem::BoundedLcp;
use crate::solve::rigid::escape;

/// One sweep over all variables of `lcp`, whose matrix is symmetric, on `x` and `w = q + M x`. Returns
/// the change in the norm of the diagonal of `M`.
pub fn sweep(lcp: &BoundedLcp<'_>, x: &mut [f64], w: &mut [f64], omega: f64) -> f64 {
    over_all::<1>(
        lcp.matrix,
        w,
        #[inline(always)]
        |i, w| {
            let unit = lcp.matrix.at(i, i);
            let value = lcp.admissible(i, x[i] - omega * w[0] / unit);
            let step = value - x[i];
            x[i] = value;
            ([step, 0.0, 0.0], unit * step * step)
        },
    )
}

/// The clearances of a contact problem.
pub struct Clearances<'p> {
    pub contact: &'p Contact<'p>,
    pub lcp: BoundedLcp<'p>,
}

impl Swept for Clearances<'_> {
    fn sweep(&self, x: &mut [f64], w: &mut [f64], omega: f64) -> f64 {
        sweep(&self.lcp, x, w, omega)
    }

    fn eta(&self, x: &[f64], w: &[f64]) -> f64 {
        self.lcp.eta(x, w)
    }

    fn residual(&self, x: &[f64]) -> Vec<f64> {
        self.lcp.w(x)
    }

    fn load(&self) -> &[f64] {
        self.lcp.q
    }

    /// Without friction the balance of the rigid motions tells, whatever the drift is.
    fn recession(&self, _drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>> {
        escape(self.contact, monitor)
    }
}
