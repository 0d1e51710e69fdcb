//! The linear complementarity problem (LCP) `w = q + M z`, `w >= 0`, `z >= 0`, `w . z = 0`.

use super::arguments::{OF_MATRIX, check_finite, check_finite_matrix, check_length, dense};
use crate::error::{Argument, Error, entry, number};
use crate::linalg::matrix::Matrix;
use crate::linalg::simd::{AT_ONCE, vectorised};
use crate::linalg::vector::largest_of;

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
            let (place, value) = (entry("cover", [i]), number(covering[i]));
            return Argument::Covering.refuse(format!("{place} is {value}, it must be positive"));
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

    /// Largest entry of `M` in row or column `i`, which carries `z_i` to the unit of `w_i`; where both are zero that of all.
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
        let largest = largest_of(magnitude.iter().copied());
        let otherwise = if largest > 0.0 { largest } else { 1.0 };
        magnitude.iter_mut().filter(|most| **most == 0.0).for_each(|most| *most = otherwise);
        magnitude
    }
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
