//! Two condensed bodies on matching contact nodes (paper, section 3).
//!
//! With each body in its own outward frame, `d = u_A + u_B` is the relative displacement and both
//! carry the same `F`. Eliminating `u_A` leaves
//!
//! ```text
//! K_rel = K_B - K_B (K_A + K_B)⁻¹ K_B          (symmetric in A and B: the parallel sum)
//! f_rel = f_B + K_B (K_A + K_B)⁻¹ (f_A - f_B)
//! u_A   = (K_A + K_B)⁻¹ (f_A - f_B + K_B d),   u_B = d - u_A
//! ```
//!
//! It needs only that no rigid motion is free in both bodies. The bodies may change roles; here B is
//! the softer one, so that `K_rel` is not the small difference of large numbers.

use super::condensed::{settled, view};
use super::probes::refuse;
use super::{Condensed, HostLoad, Reduction, SolvedCase, motion};
use crate::error::{Argument, Error, Message, index};
use crate::linalg::matrix::Matrix;
use crate::linalg::pivoted_cholesky::PivotedCholesky;
use crate::linalg::tolerances::{MOVING, NEGLIGIBLE, ROUNDING_OF_SUM};
use crate::linalg::vector::norm_inf;
use crate::linalg::watched::GoesOn;

/// The reduction of two bodies, kept for further load cases.
pub struct TwoBodyReduction {
    /// Components of `d`, and of the displacements of each body.
    size: usize,
    /// `true` if the host's first body is the softer one.
    exchanged: bool,
    /// The softer body's matrix.
    second: Vec<f64>,
    /// For each component the root of the diagonal of `K_A + K_B`, inverted.
    scale: Vec<f64>,
    /// Factor of `K_A + K_B`, scaled to a unit diagonal.
    sum: PivotedCholesky,
    /// `K_rel`.
    stiffness: Vec<f64>,
}

impl TwoBodyReduction {
    /// Displacements of both bodies.
    fn displacements(&self, load: Option<&[f64]>, d: &[f64]) -> Vec<f64> {
        let mut right = self.times_second(d);
        if let Some(load) = load {
            let (first, second) = self.split(load);
            for (right, (a, b)) in right.iter_mut().zip(first.iter().zip(second)) {
                *right += a - b;
            }
        }
        let stiffer = self.solve(&right);
        let softer: Vec<f64> = d.iter().zip(&stiffer).map(|(d, u)| d - u).collect();
        if self.exchanged { [softer, stiffer].concat() } else { [stiffer, softer].concat() }
    }

    /// Reduces `K_A` and `K_B`, each with `dim` components for each pair. `go_on` is asked now and then; once it ends the
    /// work, the result is none to use.
    ///
    /// # Errors
    /// Entries that are not finite or symmetric, negative diagonals, zeros there in rows that are not zero;
    /// a motion that neither body resists, named by its largest component.
    pub(crate) fn new(
        dim: usize,
        first: Matrix<'_>,
        second: Matrix<'_>,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Self, Error> {
        let size = first.size();
        let cleaned_first = settled(dim, &first, ("K_A", Argument::Matrix), go_on)?;
        let cleaned_second = settled(dim, &second, ("K_B", Argument::SecondMatrix), go_on)?;
        let (first, second) = (view(&first, &cleaned_first), view(&second, &cleaned_second));
        let trace = |k: &Matrix<'_>| (0..size).map(|i| k.at(i, i)).sum::<f64>();
        let exchanged = trace(&first) < trace(&second);
        let (first, second) = if exchanged { (second, first) } else { (first, second) };
        let second_units = second.units(dim);
        let units = first.units(dim).into_iter().zip(second_units).map(|(a, b)| a + b);
        let scale: Vec<f64> = units.map(|unit| unit.sqrt().recip()).collect();
        if let Some(i) = scale.iter().position(|&scale| scale == 0.0) {
            return refuse(format!(
                "K_A + K_B: component {} overflows; choose units in which it is smaller",
                index(i)
            ));
        }
        let entry = |i: usize, j: usize| scale[i] * (first.at(i, j) + second.at(i, j)) * scale[j];
        // A work that is ended tells no error.
        let not_semidefinite =
            || Error::invalid(Argument::Matrix, "K_A + K_B is not positive semi-definite");
        let sum = PivotedCholesky::within(size, NEGLIGIBLE, entry, go_on);
        let sum = sum.ok_or_else(not_semidefinite)?;
        if let Some(&free) = sum.dependent.first() {
            let free = index(free);
            return refuse(format!("neither body resists a common motion of component {free}"));
        }
        let coupling = |i: usize, j: usize| scale[i] * second.at(i, j);
        let stiffness = sum.schur_complement(size, coupling, |i, j| second.at(i, j), go_on);
        let stiffness = stiffness.ok_or_else(not_semidefinite)?;
        let stiffness = without_rounding(stiffness, &second, dim);
        let second = second.to_vec();
        Ok(TwoBodyReduction { size, exchanged, second, scale, sum, stiffness })
    }

    /// The stiffer body's part, then the softer one's.
    fn split<'a>(&self, load: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        let (first, second) = load.split_at(self.size);
        if self.exchanged { (second, first) } else { (first, second) }
    }

    /// `(K_A + K_B)⁻¹ b`.
    fn solve(&self, b: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.size];
        for (i, y) in self.sum.solution(|i| self.scale[i] * b[i]) {
            x[i] = self.scale[i] * y;
        }
        x
    }

    /// `K_B x`.
    fn times_second(&self, x: &[f64]) -> Vec<f64> {
        Matrix::contiguous(self.size, &self.second).product(x)
    }
}

/// `K_rel`, all zero where the motions that one body or the other does not resist are all there are, so that rounding of
/// `K_B` is left.
fn without_rounding(mut stiffness: Vec<f64>, second: &Matrix<'_>, dim: usize) -> Vec<f64> {
    let matrix = Matrix::contiguous(second.size(), &stiffness);
    let mut units = second.units_of_groups(dim, 0.0).enumerate();
    let is_rounding = |(i, unit): (usize, f64)| matrix.at(i, i).abs() <= ROUNDING_OF_SUM * unit;
    if units.all(is_rounding) {
        stiffness.fill(0.0);
    }
    stiffness
}

/// Vectors of the host are those of its first body, then those of its second.
impl Reduction for TwoBodyReduction {
    fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    fn is_condensed_by_host(&self) -> bool {
        true
    }

    fn host_size(&self) -> usize {
        2 * self.size
    }

    fn condense_cases(&self, cases: &[HostLoad<'_>], goes_on: GoesOn<'_>) -> Condensed {
        let condensed = |(load, _): &HostLoad<'_>| {
            if !goes_on() {
                return None;
            }
            let (first, second) = self.split(load);
            let difference: Vec<f64> = first.iter().zip(second).map(|(a, b)| a - b).collect();
            let x = self.solve(&difference);
            let carried = self.times_second(&x);
            Some(carried.iter().zip(second).map(|(carried, f)| carried + f).collect())
        };
        Ok(cases.iter().map(condensed).collect())
    }

    fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        Ok(cases.iter().map(|case| self.displacements(case.load, case.d)).collect())
    }

    /// `F` acts on both bodies, each in its own outward frame.
    fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        [force, force].concat()
    }

    fn motion_in_words(&self, dim: usize, d: &[f64]) -> Message {
        let u = self.displacements(None, d);
        let largest = norm_inf(&u);
        let (first, second) = u.split_at(self.size);
        let moving = |name, u: &[f64]| {
            if norm_inf(u) <= MOVING * largest {
                format!("body {name} not at all")
            } else {
                format!("body {name}: {}", motion::of_pairs(dim, u))
            }
        };
        format!("{}; {}", moving("A", first), moving("B", second)).into()
    }
}
