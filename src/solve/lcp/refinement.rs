//! Iterative refinement on the data of an LCP: of a solution, to digits beyond doubles, and of a vector that should prove
//! that there is none.
//!
//! At the condition number `c` rounding `z` to doubles changes `w` by about `1e-16 c |q|`: from 1e6 on no `z` in doubles
//! meets a tolerance of 1e-10. As in contact a low part has the digits that are missing, and the certificate is that of
//! both.

use crate::certificate::ROUNDING_LIMIT;
use crate::linalg::double_double::two_sum;
use crate::linalg::factor::{Factor, lu_work};
use crate::linalg::least_squares::Columns;
use crate::linalg::power_of_two::{OwnUnit, times_power_of_two};
use crate::linalg::tolerances::{NEGLIGIBLE, SINGULAR, SINGULAR_BASIS};
use crate::monitor::Watch;
use crate::problem::{Lcp, LcpCertificate};
use crate::settings::Settings;
use crate::solve::pieces::REFINEMENTS;

/// An LCP that is to be solved.
#[derive(Clone, Copy)]
pub struct Task<'t> {
    pub lcp: &'t Lcp<'t>,
    /// Those of the LCP.
    pub magnitudes: &'t [f64],
    pub settings: &'t Settings,
    pub monitor: &'t dyn Watch,
}

/// A candidate `z + low` with its certificate.
pub struct Refined {
    /// `z`, rounded to doubles.
    pub z: Vec<f64>,
    /// What rounding has left out; nothing if that is not known.
    pub low: Vec<f64>,
    /// The measures of both.
    pub certificate: LcpCertificate,
}

impl Refined {
    /// `z` alone.
    pub fn of(task: Task<'_>, z: Vec<f64>) -> Self {
        Self::in_parts(task, z, Vec::new())
    }

    fn in_parts(Task { lcp, magnitudes, .. }: Task<'_>, z: Vec<f64>, low: Vec<f64>) -> Self {
        let certificate = lcp.measure((&z, &low), magnitudes);
        Refined { z, low, certificate }
    }

    /// True if it may be called a solution. What rounding `z` may change counts where `z` alone does not do.
    pub fn holds(&self, tolerance: f64) -> bool {
        let LcpCertificate { eta, rounding, .. } = self.certificate;
        eta <= tolerance && (self.low.is_empty() || rounding <= ROUNDING_LIMIT)
    }

    /// `w_i`, not negative: 0 where `z_i` is positive, and NaN where it is not known.
    pub fn slack(&self, i: usize) -> f64 {
        let w = self.certificate.w[i];
        if self.z[i] > 0.0 || w < 0.0 { 0.0 } else { w }
    }

    /// Refines the positive variables so that their `w` vanish, as far as that helps and until the tolerance is met.
    pub fn refine(&mut self, task: Task<'_>) {
        let Task { lcp, magnitudes, settings: &Settings { tolerance, .. }, monitor } = task;
        let basic: Vec<usize> = (0..self.z.len()).filter(|&i| self.z[i] > 0.0).collect();
        let is_hopeless = !self.certificate.eta.is_finite() || basic.is_empty();
        if is_hopeless || self.holds(tolerance) || monitor.affords(lu_work(basic.len())).is_err() {
            return;
        }
        let scale = scales(magnitudes);
        let fill = |c: usize, column: &mut [f64]| {
            let own = lcp.column(basic[c]);
            for (entry, &i) in column.iter_mut().zip(&basic) {
                *entry = scale[i] * own[i] * scale[basic[c]];
            }
        };
        let asking = &mut monitor.asking();
        let Some(factor) = Factor::new(basic.len(), false, SINGULAR_BASIS, fill, asking) else {
            return;
        };
        for _ in 0..REFINEMENTS {
            let w = &self.certificate.w;
            let mut step: Vec<f64> = basic.iter().map(|&i| -(scale[i] * w[i])).collect();
            factor.solve(&mut step);
            let (mut z, mut low) = (self.z.clone(), self.low.clone());
            low.resize(z.len(), 0.0);
            for (&i, step) in basic.iter().zip(step) {
                let (sum, lost) = two_sum(z[i], scale[i] * step);
                let (high, rest) = two_sum(sum, lost + low[i]);
                (z[i], low[i]) = if high > 0.0 { (high, rest) } else { (0.0, 0.0) };
            }
            let next = Refined::in_parts(task, z, low);
            if !(next.certificate.eta < self.certificate.eta) {
                return;
            }
            *self = next;
            if self.holds(tolerance) {
                return;
            }
        }
    }
}

/// Powers of two that bring the rows and columns of a matrix with these magnitudes to a similar size.
pub fn scales(magnitudes: &[f64]) -> Vec<f64> {
    magnitudes.iter().map(|m| (-(m.log2() / 2.0).round()).exp2()).collect()
}

/// A ray refined until it proves that there is no solution: entries of `Mᵀ y` that are zero but for the rounding of the
/// ray's basis become so to the last digit. `None`: it proves nothing, or there is no time for it.
pub fn proving_ray(task: Task<'_>, y: &[f64]) -> Option<Vec<f64>> {
    let Task { lcp, magnitudes, monitor, .. } = task;
    let scale = scales(magnitudes);
    // The largest one gives the length.
    let size = |i: usize| y[i] / scale[i];
    let largest = (0..y.len()).max_by(|&i, &j| size(i).total_cmp(&size(j)))?;
    let moving: Vec<usize> = (0..y.len()).filter(|&i| y[i] > 0.0 && i != largest).collect();
    let entry = |i: usize, j: usize| scale[i] * lcp.column(j)[i] * scale[j];
    // M of these variables is regular where the ray is their only one.
    monitor.affords(lu_work(moving.len())).ok()?;
    let fill = |c: usize, column: &mut [f64]| {
        column.iter_mut().zip(&moving).for_each(|(value, &j)| *value = entry(moving[c], j));
    };
    let factor = Factor::new(moving.len(), false, SINGULAR, fill, &mut monitor.asking());
    let by_factor = factor.and_then(|factor| {
        refined_ray(lcp, (&scale, &moving, &moving), y, |mut left| {
            factor.solve(&mut left);
            left
        })
    });
    if by_factor.is_some() {
        return by_factor;
    }
    // It may be none; and where M itself is rounded the remaining equation has all of its rounding, which least squares
    // share among all.
    let is_zero = |j: &usize| {
        let resistance = lcp.resistance(*j, y);
        resistance.sum.abs() <= NEGLIGIBLE * resistance.terms
    };
    let zeros: Vec<usize> = (0..y.len()).filter(is_zero).collect();
    // An orthogonalisation, done twice, has four operations for an entry of one column and another column.
    let work = 4.0 * zeros.len() as f64 * (moving.len() as f64).powi(2);
    monitor.affords(work).ok()?;
    let column = |&i: &usize| zeros.iter().map(|&j| entry(i, j)).collect();
    let columns = Columns::new(moving.iter().map(column), NEGLIGIBLE);
    refined_ray(lcp, (&scale, &moving, &zeros), y, |mut left| {
        columns.coefficients(columns.take_out(&mut left))
    })
}

/// `y` with changes of its entries `moving` by which `solved` takes the entries `zeros` of `Mᵀ y` to zero, as soon as it is
/// a proof.
fn refined_ray(
    lcp: &Lcp<'_>,
    (scale, moving, zeros): (&[f64], &[usize], &[usize]),
    y: &[f64],
    solved: impl Fn(Vec<f64>) -> Vec<f64>,
) -> Option<Vec<f64>> {
    let mut y = y.to_vec();
    for _ in 0..REFINEMENTS {
        let left = zeros.iter().map(|&j| {
            let OwnUnit { sum, unit, .. } = lcp.resistance(j, &y);
            -times_power_of_two(sum, unit) * scale[j]
        });
        let change = solved(left.collect());
        for (&i, change) in moving.iter().zip(change) {
            // NaN is none.
            y[i] = (y[i] + scale[i] * change).max(0.0);
        }
        if lcp.is_infeasible_by(&y) {
            return Some(y);
        }
    }
    None
}
