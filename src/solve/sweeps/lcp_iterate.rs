//! Sweeps on an LCP with lower bounds, variable by variable.

use super::Iterate;
use super::blocks::over_all;
use crate::law::Contact;
use crate::linalg::vector::norm_inf;
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

/// An iterate with its `w`.
pub struct LcpIterate<'p> {
    /// The contact problem whose clearances the variables are.
    contact: &'p Contact<'p>,
    lcp: BoundedLcp<'p>,
    x: Vec<f64>,
    w: Vec<f64>,
}

impl<'p> LcpIterate<'p> {
    /// Starts from `x`, made admissible.
    pub fn new(contact: &'p Contact<'p>, lcp: BoundedLcp<'p>, mut x: Vec<f64>) -> Self {
        for (i, x) in x.iter_mut().enumerate() {
            *x = lcp.admissible(i, *x);
        }
        let w = lcp.w(&x);
        LcpIterate { contact, lcp, x, w }
    }
}

impl Iterate for LcpIterate<'_> {
    fn sweep(&mut self, omega: f64) -> f64 {
        sweep(&self.lcp, &mut self.x, &mut self.w, omega)
    }

    fn eta(&self) -> f64 {
        self.lcp.eta(&self.x, &self.w)
    }

    fn refresh(&mut self) {
        self.w = self.lcp.w(&self.x);
    }

    fn unknowns(&self) -> &[f64] {
        &self.x
    }

    fn largest_force(&self) -> f64 {
        norm_inf(&self.w)
    }

    fn is_unloaded(&self) -> bool {
        norm_inf(self.lcp.q) == 0.0
    }

    /// Without friction the balance of the rigid motions tells, whatever the drift is.
    fn recession(&self, _drift: &[f64], monitor: &mut Monitor<'_>) -> Option<Vec<f64>> {
        escape(self.contact, monitor)
    }
}
