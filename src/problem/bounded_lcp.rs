//! The linear complementarity problem with lower bounds, which contact without friction is.

use super::remembered::Remembered;
use crate::linalg::matrix::Matrix;
use crate::linalg::vector::{norm, norm_of};

/// `w = q + M x`, `x >= l`, `w >= 0`, `(x - l) . w = 0`; where a bound is `-inf` the variable is free
/// and `w = 0`. A view of its arrays.
///
/// [`super::Lcp`] is the problem with `l = 0`. Contact without friction is the problem in `x = -d` with
/// `M = K`, `q = f`, `w = -F` and `l = -gap`; tangential components are free.
#[derive(Clone, Copy, Debug)]
pub struct BoundedLcp<'a> {
    /// `M`.
    pub matrix: Matrix<'a>,
    /// `q`.
    pub q: &'a [f64],
    /// `l`, `-inf` for a free variable.
    pub lower: &'a [f64],
    /// `true` if `M` is symmetric, as far as rounding goes.
    pub symmetric: bool,
    /// The memory that problems with this matrix share; `None`: this one stands alone.
    pub remembered: Option<&'a Remembered>,
}

impl BoundedLcp<'_> {
    /// `q + M x`.
    pub fn w(&self, x: &[f64]) -> Vec<f64> {
        let mut w = self.q.to_vec();
        self.matrix.add_product(x, &mut w);
        w
    }

    /// Returns `true` if variable `i` has no bound.
    #[inline(always)]
    pub fn is_free(&self, i: usize) -> bool {
        self.lower[i] == f64::NEG_INFINITY
    }

    /// The value nearest to `x` that variable `i` may have.
    #[inline(always)]
    pub fn admissible(&self, i: usize, x: f64) -> f64 {
        x.max(self.lower[i])
    }

    /// Residual `|min(w, m (x - l))|` of `x` and its `w`, relative to `max(|q|, |w|)`, with `m` the
    /// diagonal of `M`. Zero at solutions only, if the diagonal is positive; infinite where the forces
    /// overflow.
    pub fn eta(&self, x: &[f64], w: &[f64]) -> f64 {
        // m (x - l) is infinite of a free variable.
        let part =
            |(i, (w, x)): (usize, (&f64, &f64))| w.min(self.matrix.at(i, i) * (x - self.lower[i]));
        let residual = norm_of(w.iter().zip(x).enumerate().map(part));
        let scale = norm(self.q).max(norm(w));
        match residual {
            0.0 => 0.0,
            _ if scale.is_finite() => residual / scale,
            _ => f64::INFINITY,
        }
    }

    /// Returns `true` if variable `i` is off its bound on the branch of `min(w, m (x - l))` that `x` and `w` are
    /// on: `w = 0` holds there, otherwise `x = l`.
    pub fn is_basic(&self, i: usize, x: &[f64], w: &[f64]) -> bool {
        self.is_free(i) || self.matrix.at(i, i) * (x[i] - self.lower[i]) >= w[i]
    }
}
