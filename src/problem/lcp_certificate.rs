//! The certificate of an LCP, from the host's data alone: how far a candidate is from a solution, and when a vector proves
//! that there is none.
//!
//! A candidate is measured beside `q` alone. `M z` is no measure: one `z` that grows where nothing resists it makes
//! some `w` as large as it likes, and beside that no violation counts.

use super::Lcp;
use crate::linalg::ball::UNIT;
use crate::linalg::power_of_two::{
    OwnUnit, dot_in_own_unit, exponent, largest_exponent, times_power_of_two,
};
use crate::linalg::tolerances::{FEW_OPERATIONS, LEAST_WORK};
use crate::linalg::vector::{dot, first_not_finite, largest_of, norm, norm_of, opposite, sizes};

/// The measures of one candidate `z + low`.
#[derive(Clone, Debug)]
pub struct LcpCertificate {
    /// `|min(w, m z)| / |q|`, with the rounding of its evaluation.
    pub eta: f64,
    /// The most that rounding `z` to doubles may add to `eta`.
    pub rounding: f64,
    /// `q + M (z + low)`, rounded once. It may be infinite where `eta` is not.
    pub w: Vec<f64>,
}

/// Sums of one row: `w` and the terms of `M z`, both in a unit of `|q|`, and `m z` in this unit.
struct Row {
    w: f64,
    terms: f64,
    mz: f64,
}

impl Lcp<'_> {
    /// `|min(w, m z)| / |q|` with `w = q + M z` and `m` of [`Self::magnitudes`]: zero at solutions only, infinite where
    /// `z` is not finite. The sums are taken in twice the precision, and their rounding is part of it.
    pub fn eta(&self, z: &[f64]) -> f64 {
        self.measure((z, &[]), &self.magnitudes()).eta
    }

    /// The measures of `z + low`, `low` nothing if it is empty, from the [`Self::magnitudes`]. Sums that overflow or
    /// underflow are taken once more, scaled.
    pub(crate) fn measure(&self, (z, low): (&[f64], &[f64]), magnitudes: &[f64]) -> LcpCertificate {
        let load = norm(self.q());
        let terms = self.matrix.magnitude(&sizes(z));
        let w = self.matrix.residual(z, low, &opposite(self.q()), &terms);
        let row = |i: usize| {
            let z = z[i] + low.get(i).unwrap_or(&0.0);
            Row { w: w[i], terms: terms[i], mz: magnitudes[i] * z }
        };
        let rows: Vec<Row> = (0..w.len()).map(row).collect();
        let (eta, rounding) = measures(&rows, load);
        let are_finite = rows.iter().all(|row| (row.w + row.mz + row.terms).is_finite());
        if are_finite && (LEAST_SCALE..f64::INFINITY).contains(&load) {
            return LcpCertificate { eta, rounding, w };
        }
        if first_not_finite(z).is_some() {
            return LcpCertificate { eta: f64::INFINITY, rounding: f64::INFINITY, w };
        }
        self.measure_scaled((z, low), magnitudes)
    }

    /// [`Self::measure`], each sum in a unit of its own.
    fn measure_scaled(&self, (z, low): (&[f64], &[f64]), magnitudes: &[f64]) -> LcpCertificate {
        let load_unit = largest_exponent(self.q().iter().copied()).unwrap_or(0);
        let in_load = |x: f64, unit: i32| times_power_of_two(x, unit - load_unit);
        let sum = |i: usize| {
            let all = z.iter().enumerate().chain(low.iter().enumerate());
            let products = all.map(|(j, z)| (self.matrix.at(i, j), *z));
            dot_in_own_unit(products.chain([(self.q()[i], 1.0)]))
        };
        let sums: Vec<OwnUnit> = (0..z.len()).map(sum).collect();
        let row = |(i, sum): (usize, &OwnUnit)| {
            let (m, z) = (magnitudes[i], z[i] + low.get(i).unwrap_or(&0.0));
            let mz = if z == 0.0 {
                0.0
            } else {
                let (e, f) = (exponent(m), exponent(z));
                in_load(times_power_of_two(m, -e) * times_power_of_two(z, -f), e + f)
            };
            let q = in_load(self.q()[i].abs(), 0);
            let terms = (in_load(sum.terms, sum.unit) - q).max(0.0);
            Row { w: in_load(sum.sum, sum.unit), terms, mz }
        };
        let rows: Vec<Row> = sums.iter().enumerate().map(row).collect();
        let load: Vec<f64> = self.q().iter().map(|&q| in_load(q, 0)).collect();
        let (eta, rounding) = measures(&rows, norm(&load));
        let w = sums.iter().map(|sum| times_power_of_two(sum.sum, sum.unit)).collect();
        LcpCertificate { eta, rounding, w }
    }

    /// Returns `true` if `y` proves that no `w, z >= 0` satisfy `w = q + M z`:
    /// `y >= 0`, `Mᵀ y <= 0`, `q . y < 0` (Farkas). `Mᵀ y` may be positive by what changes in the last digits of the
    /// entries of `M` explain.
    pub fn is_infeasible_by(&self, y: &[f64]) -> bool {
        if y.iter().any(|&y| y < 0.0) || first_not_finite(y).is_some() {
            return false;
        }
        // Changes of some units in the last digits of the entries, by as many as their own sums may have lost, make up for
        // less.
        let is_resisted = |j: usize| {
            let OwnUnit { sum, terms, .. } = self.resistance(j, y);
            sum > FEW_OPERATIONS * terms
        };
        self.works(y) && !(0..y.len()).any(is_resisted)
    }

    /// Entry `j` of `Mᵀ y`.
    pub(crate) fn resistance(&self, j: usize, y: &[f64]) -> OwnUnit {
        dot_in_own_unit(self.column(j).iter().copied().zip(y.iter().copied()))
    }

    /// Returns `true` if `q . y` is negative by more than rounding of a `y` that is finite and non-negative.
    fn works(&self, y: &[f64]) -> bool {
        let (q, magnitude) = (self.q(), self.magnitudes());
        // Everything in powers of two near the largest: y, q, and the terms of Mᵀ y.
        let terms = y.iter().zip(&magnitude).filter(|(y, _)| **y != 0.0);
        let Some(unit) = terms.map(|(&y, &m)| exponent(y) + exponent(m)).max() else {
            return false;
        };
        let Some(load_unit) = largest_exponent(q.iter().copied()) else { return false };
        let scaled = |x: &f64, e: i32| times_power_of_two(*x, e);
        let exponents: Vec<i32> = magnitude.iter().map(|&m| exponent(m)).collect();
        let share: Vec<f64> = y.iter().zip(&exponents).map(|(y, &e)| scaled(y, e - unit)).collect();
        let mantissa: Vec<f64> =
            magnitude.iter().zip(&exponents).map(|(m, &e)| scaled(m, -e)).collect();
        let size = largest_of(share.iter().zip(&mantissa).map(|(y, m)| y * m));
        // q . y in the unit of q and of the terms: (q / m) (y m).
        let loads = q.iter().zip(&exponents);
        let most = loads.clone().filter(|(q, _)| **q != 0.0).map(|(_, e)| -e).max().unwrap_or(0);
        let loads = loads.map(|(q, e)| scaled(&scaled(q, -load_unit), -e - most));
        let loads: Vec<f64> = loads.collect();
        let work = dot(&loads, &share);
        let scale: f64 = loads.iter().zip(&mantissa).map(|(q, m)| q.abs() / m * size).sum();
        let own = dot_in_own_unit(q.iter().copied().zip(y.iter().copied()));
        work < -LEAST_WORK * scale && own.sum < -LEAST_WORK * own.terms
    }
}

/// Least `|q|` at which sums may be taken as they are: what underflows beside it is below the rounding of
/// its last digit.
const LEAST_SCALE: f64 = 1e-280;

/// `eta` and the rounding of `z` in it, of rows beside `load`.
fn measures(rows: &[Row], load: f64) -> (f64, f64) {
    let residual = norm_of(rows.iter().map(|row| row.w.min(row.mz)));
    // Where w is the larger one even so its rounding changes nothing.
    let terms_that_count = |unit: f64| {
        norm_of(rows.iter().map(|row| {
            let counts = row.w - unit * row.terms <= row.mz;
            if counts { row.terms } else { 0.0 }
        }))
    };
    // The error of products in twice the precision, `Matrix::residual`; without products there is none.
    let lost = (4.0 * UNIT * (rows.len() + 2) as f64).powi(2);
    let are_products = rows.iter().any(|row| row.terms != 0.0);
    let doubt = if are_products { lost * (terms_that_count(lost) + load) } else { 0.0 };
    // A power of two, whatever the order of the terms.
    let doubt = if doubt > 0.0 && doubt.is_finite() {
        times_power_of_two(1.0, exponent(doubt) + 1)
    } else {
        doubt
    };
    let beside = |part: f64| if part == 0.0 { 0.0 } else { part / load };
    // Written so that NaN is no solution.
    let eta = beside((residual + doubt) * (1.0 + FEW_OPERATIONS));
    let rounding = beside(UNIT * terms_that_count(UNIT));
    (if eta.is_nan() { f64::INFINITY } else { eta }, rounding)
}
