//! The linear complementarity problem (LCP) `w = q + M z`, `w >= 0`, `z >= 0`, `w . z = 0`.

use crate::error::{Argument, Error, entry};
use crate::linalg::matrix::{Matrix, required_length};
use crate::linalg::tolerances::{LEAST_WORK, NEGLIGIBLE};
use crate::linalg::vector::{NormSum, dot, first_not_finite, largest_of, norm};

/// A checked problem, a view of the caller's arrays.
#[derive(Clone, Copy, Debug)]
pub struct Lcp<'a> {
    matrix: Matrix<'a>,
    q: &'a [f64],
    covering: Option<&'a [f64]>,
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
        let refuse = |argument, message| Err(Error::invalid(argument, message));
        let entries = required_length("M", size, ld)
            .map_err(|message| Error::invalid(Argument::LeadingDimension, message))?;
        if matrix.len() < entries {
            let given = matrix.len();
            return refuse(
                Argument::Matrix,
                format!("M has {given} entries, it must have {entries}"),
            );
        }
        if q.len() < size {
            return refuse(
                Argument::Load,
                format!("q has {} entries, it must have {size}", q.len()),
            );
        }
        if covering.is_some_and(|covering| covering.len() < size) {
            return refuse(Argument::Covering, format!("cover must have {size} entries"));
        }
        let (q, covering) = (&q[..size], covering.map(|covering| &covering[..size]));
        let lcp = Lcp { matrix: Matrix::new(size, matrix, ld), q, covering };
        for j in 0..size {
            if let Some(i) = first_not_finite(lcp.column(j)) {
                return refuse(Argument::Matrix, entry("M", [i, j]) + " is not finite");
            }
        }
        if let Some(i) = first_not_finite(q) {
            return refuse(Argument::Load, entry("q", [i]) + " is not finite");
        }
        if let Some(covering) = covering
            && let Some(i) = covering.iter().position(|&d| !(d > 0.0 && d.is_finite()))
        {
            let message =
                format!("{} is {}, it must be positive", entry("cover", [i]), covering[i]);
            return refuse(Argument::Covering, message);
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

    /// `M`.
    pub(crate) fn matrix(&self) -> Matrix<'a> {
        self.matrix
    }

    /// `q`.
    pub fn q(&self) -> &'a [f64] {
        self.q
    }

    /// Entry `i` of the covering vector.
    pub fn covering(&self, i: usize) -> f64 {
        self.covering.map_or(1.0, |covering| covering[i])
    }

    /// The covering vector, `None` for ones.
    pub(crate) fn covering_vector(&self) -> Option<&'a [f64]> {
        self.covering
    }

    /// `M z`.
    pub fn product(&self, z: &[f64]) -> Vec<f64> {
        self.matrix.product(z)
    }

    /// Largest entry of `M` in row or column `i`, which carries `z_i` to the unit of `w_i`.
    pub fn magnitudes(&self) -> Vec<f64> {
        let mut magnitude = vec![0.0_f64; self.size()];
        for j in 0..self.size() {
            // Two plain loops, for the vectoriser; a largest entry in one lane would wait for itself.
            let mut most = [0.0_f64; 8];
            for chunk in self.column(j).chunks(most.len()) {
                for (most, m) in most.iter_mut().zip(chunk) {
                    *most = if m.abs() > *most { m.abs() } else { *most };
                }
            }
            for (magnitude, m) in magnitude.iter_mut().zip(self.column(j)) {
                *magnitude = if m.abs() > *magnitude { m.abs() } else { *magnitude };
            }
            magnitude[j] = magnitude[j].max(largest_of(most));
        }
        for magnitude in &mut magnitude {
            if *magnitude == 0.0 {
                *magnitude = 1.0;
            }
        }
        magnitude
    }

    /// `|min(w, m z)| / max(|q|, |M z|)` with `w = q + M z` and `m` of [`Self::magnitudes`]:
    /// zero at solutions only.
    pub fn eta(&self, z: &[f64]) -> f64 {
        self.measure(z, &self.magnitudes()).0
    }

    /// `eta`, and the product `M z` that it takes, from the [`Self::magnitudes`].
    pub(crate) fn measure(&self, z: &[f64], magnitudes: &[f64]) -> (f64, Vec<f64>) {
        let product = self.product(z);
        let scale = norm(self.q).max(norm(&product));
        let mut residual = NormSum::default();
        for (((m, q), mz), z) in magnitudes.iter().zip(self.q).zip(&product).zip(z) {
            residual.add((q + mz).min(m * z));
        }
        let residual = residual.root();
        (if residual == 0.0 { 0.0 } else { residual / scale }, product)
    }

    /// Whether `y` proves that no `w, z >= 0` satisfy `w = q + M z`:
    /// `y >= 0`, `Mᵀ y <= 0`, `q . y < 0` (Farkas).
    pub fn is_infeasible_by(&self, y: &[f64]) -> bool {
        let magnitude = self.magnitudes();
        let size = largest_of(y.iter().zip(&magnitude).map(|(y, m)| y * m));
        if y.iter().any(|&y| y < 0.0) || size == 0.0 || !size.is_finite() {
            return false;
        }
        let work = dot(self.q, y);
        let scale: f64 = self.q.iter().zip(&magnitude).map(|(q, m)| (q / m).abs() * size).sum();
        work < -LEAST_WORK * scale
            && (0..self.size()).all(|j| dot(self.column(j), y) <= NEGLIGIBLE * size)
    }
}
