//! Frictionless contact by sweeps on the clearances.

use super::driver::{Driver, LARGEST_FACTOR};
use super::swept::Swept;
use crate::linalg::matrix::Matrix;
use crate::problem::BoundedLcp;
use crate::solve::part::ContactLcp;
use crate::solve::result::{Call, Candidate, Effort, Ending};

/// The condensed problem has another scale of forces than the whole one, whose certificate decides: the
/// target is tightened by this factor until that holds, or no rounding can reach it.
const TIGHTENING: f64 = 0.1;

/// Solves a problem.
pub fn frictionless(call: &Call<'_>) -> Candidate {
    let (contact, settings) = (call.contact, call.settings);
    let condensed = match ContactLcp::new(contact, call.monitor) {
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
    let swept = Swept { contact, working: None, clearances: Some(lcp) };
    let mut driver = Driver::new(call, (swept, x), LARGEST_FACTOR);
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
