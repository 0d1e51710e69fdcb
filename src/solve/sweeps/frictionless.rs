//! Frictionless contact by sweeps on the clearances, variable by variable.

use super::Swept;
use super::blocks::over_all;
use super::driver::{Driver, LARGEST_FACTOR};
use crate::law::Contact;
use crate::linalg::matrix::Matrix;
use crate::monitor::Monitor;
use crate::problem::BoundedLcp;
use crate::solve::part::ContactLcp;
use crate::solve::result::{Call, Candidate, Effort, Ending};
use crate::solve::rigid::escape;

/// The condensed problem has another scale of forces than the whole one, whose certificate decides: the
/// target is tightened by this factor until that holds, or no rounding can reach it.
const TIGHTENING: f64 = 0.1;

/// Solves a problem.
pub fn frictionless(call: &Call<'_>, monitor: &mut Monitor<'_>) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let condensed = match ContactLcp::new(contact, monitor) {
        Ok(condensed) => condensed,
        Err(why) => return Candidate::without_displacements(contact, why),
    };
    let [q, ..] = condensed.vectors([0.0; 2]);
    let size = q.len();
    let mut entries = vec![0.0; size * size];
    let columns = entries.chunks_exact_mut(size.max(1)).enumerate();
    columns.for_each(|(j, column)| condensed.write_column(j, column));
    if let Some(motion) = condensed.stiffen_unresisted(&mut entries, &q) {
        return Candidate::without_displacements(contact, Ending::Recession(motion));
    }
    let (matrix, lower) = (Matrix::new(size, &entries, size.max(1)), vec![0.0; size]);
    let lcp = BoundedLcp { matrix, q: &q, lower: &lower, symmetric: true, remembered: None };
    let x = condensed.clearances(&call.start_or_zero()).into_iter().enumerate();
    let x = x.map(|(i, x)| lcp.admissible(i, x)).collect();
    let mut driver =
        Driver::new((Clearances { contact, lcp }, x), settings, LARGEST_FACTOR, monitor);
    let mut target = settings.tolerance;
    loop {
        let ending = driver.solve(target).err().unwrap_or(Ending::Done);
        let d = condensed.displacements(&driver.x);
        let mut candidate = Candidate::of_displacements(contact, d, ending);
        candidate.effort = Effort { omega: driver.relaxation.omega, ..Effort::default() };
        let done = candidate.ending != Ending::Done
            || candidate.certificate(contact).holds(settings.tolerance);
        if done || target < f64::EPSILON * settings.tolerance {
            return candidate;
        }
        target *= TIGHTENING;
    }
}

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
struct Clearances<'p> {
    contact: &'p Contact<'p>,
    lcp: BoundedLcp<'p>,
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
