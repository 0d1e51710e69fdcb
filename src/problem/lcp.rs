//! The linear complementarity problem (LCP) `w = q + M z`, `w >= 0`, `z >= 0`, `w . z = 0`.

use super::arguments::{OF_MATRIX, check_finite, check_finite_matrix, check_length, dense};
use crate::error::{Argument, Error, entry, number};
use crate::linalg::matrix::Matrix;
use crate::linalg::power_of_two::{
    dot_in_own_unit, exponent, largest_exponent, times_power_of_two,
};
use crate::linalg::simd::{AT_ONCE, vectorised};
use crate::linalg::tolerances::{LEAST_WORK, NEGLIGIBLE};
use crate::linalg::vector::{first_not_finite, largest_of, norm, norm_of};

/// A checked problem, a view of the caller's arrays.
#[derive(Clone, Copy, Debug)]
pub struct Lcp<'a> {
    /// `M`.
    pub(crate) matrix: Matrix<'a>,
    q: &'a [f64],
    /// The covering vector, `None` for ones.
    pub(crate) covering: Option<&'a [f64]>,
}

impl<'a> Lcp<'a> {
    /// Checks the data: `matrix` is `M`, column-major `size x size` with leading dimension `ld`,
    /// of any kind; `covering` is the vector `d > 0` of Lemke's method, `None` for ones.
    ///
    /// # Errors
    /// [`Error::Invalid`] names the first entry at fault.
    pub fn new(
        size: usize,
        matrix: &'a [f64],
        ld: usize,
        q: &'a [f64],
        covering: Option<&'a [f64]>,
    ) -> Result<Self, Error> {
        let matrix = dense("M", (matrix, ld), size, OF_MATRIX)?;
        check_length(("q", Argument::Load), q.len(), size)?;
        check_length(("cover", Argument::Covering), covering.map_or(size, <[f64]>::len), size)?;
        let (q, covering) = (&q[..size], covering.map(|covering| &covering[..size]));
        let lcp = Lcp { matrix, q, covering };
        check_finite_matrix(("M", Argument::Matrix), &matrix)?;
        check_finite(("q", Argument::Load), q)?;
        if let Some(covering) = covering
            && let Some(i) = covering.iter().position(|&d| !(d > 0.0 && d.is_finite()))
        {
            let value = number(covering[i]);
            let message = format!("{} is {value}, it must be positive", entry("cover", [i]));
            return Err(Error::invalid(Argument::Covering, message));
        }
        Ok(lcp)
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.matrix.size()
    }

    /// Column `j` of `M`.
    pub fn column(&self, j: usize) -> &'a [f64] {
        self.matrix.column(j)
    }

    /// `q`.
    pub fn q(&self) -> &'a [f64] {
        self.q
    }

    /// Entry `i` of the covering vector.
    pub fn covering(&self, i: usize) -> f64 {
        self.covering.map_or(1.0, |covering| covering[i])
    }

    /// `M z`.
    pub fn product(&self, z: &[f64]) -> Vec<f64> {
        self.matrix.product(z)
    }

    /// Largest entry of `M` in row or column `i`, which carries `z_i` to the unit of `w_i`.
    pub fn magnitudes(&self) -> Vec<f64> {
        let mut magnitude = vec![0.0_f64; self.size()];
        vectorised(
            #[inline(always)]
            || {
                for j in 0..self.size() {
                    let most = raise_to(&mut magnitude, self.column(j));
                    magnitude[j] = magnitude[j].max(most);
                }
            },
        );
        for magnitude in &mut magnitude {
            if *magnitude == 0.0 {
                *magnitude = 1.0;
            }
        }
        magnitude
    }

    /// `|min(w, m z)| / max(|q|, |M z|)` with `w = q + M z` and `m` of [`Self::magnitudes`]:
    /// zero at solutions only, infinite where `z` is not finite. Sums that overflow or underflow are
    /// taken once more, scaled.
    pub fn eta(&self, z: &[f64]) -> f64 {
        self.measure(z, &self.magnitudes()).0
    }

    /// `eta`, and the product `M z` that it takes, from the [`Self::magnitudes`]. The product may be
    /// infinite where `eta` is not.
    pub(crate) fn measure(&self, z: &[f64], magnitudes: &[f64]) -> (f64, Vec<f64>) {
        let product = self.product(z);
        let (residual, scale) = residual_and_scale((self.q, &product), magnitudes, z);
        if residual.is_finite() && (LEAST_SCALE..f64::INFINITY).contains(&scale) {
            return (residual / scale, product);
        }
        if first_not_finite(z).is_some() {
            return (f64::INFINITY, product);
        }
        self.measure_scaled(z, magnitudes)
    }

    /// [`Self::measure`] in units of a power of two near the largest term of any sum.
    fn measure_scaled(&self, z: &[f64], magnitudes: &[f64]) -> (f64, Vec<f64>) {
        let n = self.size();
        let columns: Vec<(usize, i32)> = (0..n)
            .filter(|&j| z[j] != 0.0)
            .filter_map(|j| Some((j, largest_exponent(self.column(j).iter().copied())?)))
            .collect();
        let terms = columns.iter().map(|&(j, e)| exponent(z[j]) + e);
        let unit = terms.chain(largest_exponent(self.q.iter().copied())).max().unwrap_or(0);
        let mut product = vec![0.0; n];
        for &(j, e) in &columns {
            let factor = times_power_of_two(z[j], e - unit);
            for (sum, &m) in product.iter_mut().zip(self.column(j)) {
                *sum += times_power_of_two(m, -e) * factor;
            }
        }
        let q: Vec<f64> = self.q.iter().map(|&q| times_power_of_two(q, -unit)).collect();
        // m z in the same unit: the exponent of m goes to z.
        let split = |m: &f64| (exponent(*m), times_power_of_two(*m, -exponent(*m)));
        let (exponents, mantissas): (Vec<i32>, Vec<f64>) = magnitudes.iter().map(split).unzip();
        let scaled = z.iter().zip(exponents).map(|(&z, e)| times_power_of_two(z, e - unit));
        let scaled: Vec<f64> = scaled.collect();
        let (residual, scale) = residual_and_scale((&q, &product), &mantissas, &scaled);
        product.iter_mut().for_each(|sum| *sum = times_power_of_two(*sum, unit));
        (if residual == 0.0 { 0.0 } else { residual / scale }, product)
    }

    /// Returns `true` if `y` proves that no `w, z >= 0` satisfy `w = q + M z`:
    /// `y >= 0`, `Mᵀ y <= 0`, `q . y < 0` (Farkas).
    pub fn is_infeasible_by(&self, y: &[f64]) -> bool {
        if y.iter().any(|&y| y < 0.0) || first_not_finite(y).is_some() {
            return false;
        }
        let magnitude = self.magnitudes();
        // Everything in powers of two near the largest: y, q, and the terms of Mᵀ y.
        let terms = y.iter().zip(&magnitude).filter(|(y, _)| **y != 0.0);
        let Some(unit) = terms.map(|(&y, &m)| exponent(y) + exponent(m)).max() else {
            return false;
        };
        let Some(load_unit) = largest_exponent(self.q.iter().copied()) else { return false };
        let scaled = |x: &f64, e: i32| times_power_of_two(*x, e);
        let exponents: Vec<i32> = magnitude.iter().map(|&m| exponent(m)).collect();
        let share: Vec<f64> = y.iter().zip(&exponents).map(|(y, &e)| scaled(y, e - unit)).collect();
        let mantissa: Vec<f64> =
            magnitude.iter().zip(&exponents).map(|(m, &e)| scaled(m, -e)).collect();
        let size = largest_of(share.iter().zip(&mantissa).map(|(y, m)| y * m));
        // q . y in the unit of q and of the terms: (q / m) (y m).
        let load = |i: usize| scaled(&self.q[i], -load_unit);
        let most = (0..y.len()).filter(|&i| self.q[i] != 0.0).map(|i| -exponents[i]).max();
        let most = most.unwrap_or(0);
        let work: f64 =
            (0..y.len()).map(|i| scaled(&load(i), -exponents[i] - most) * share[i]).sum();
        let scale: f64 = (0..y.len())
            .map(|i| scaled(&load(i), -exponents[i] - most).abs() / mantissa[i] * size)
            .sum();
        // Zero is what rounding of the terms explains.
        let is_resisted = |j: usize| {
            let (sum, terms) = dot_in_own_unit(self.column(j), y);
            sum > NEGLIGIBLE * terms
        };
        let (own_work, terms) = dot_in_own_unit(self.q, y);
        let works = work < -LEAST_WORK * scale && own_work < -LEAST_WORK * terms;
        works && !(0..y.len()).any(is_resisted)
    }
}

/// Least scale at which sums may be taken as they are: what underflows beside it is below the rounding of
/// its last digit.
const LEAST_SCALE: f64 = 1e-280;

/// `|min(q + M z, m z)|` and `max(|q|, |M z|)` from `q` and `M z`; NaN where a number is NaN.
fn residual_and_scale((q, product): (&[f64], &[f64]), m: &[f64], z: &[f64]) -> (f64, f64) {
    let (load, inner) = (norm(q), norm(product));
    let entries = m.iter().zip(q).zip(product).zip(z);
    let residual = norm_of(entries.map(|(((m, q), mz), z)| (q + mz).min(m * z)));
    // `max` and `min` would drop a NaN.
    let scale = if inner.is_nan() { inner } else { load.max(inner) };
    (residual, scale)
}

/// Raises numbers to the sizes of others, of which the largest is returned; to be called inside [`vectorised`].
#[inline(always)]
fn raise_to(numbers: &mut [f64], others: &[f64]) -> f64 {
    let larger = |a: f64, b: f64| if b > a { b } else { a };
    // Two plain loops, for the vectoriser; a largest entry in one lane would wait for itself.
    let mut most = [0.0_f64; AT_ONCE];
    let (chunks, last) = others.as_chunks::<AT_ONCE>();
    for chunk in chunks {
        most = std::array::from_fn(|k| larger(most[k], chunk[k].abs()));
    }
    most[0] = last.iter().fold(most[0], |most, other| larger(most, other.abs()));
    numbers
        .iter_mut()
        .zip(others)
        .for_each(|(number, other)| *number = larger(*number, other.abs()));
    largest_of(most)
}
