//! Variables of rows that nearly depend on each other which displacements hardly tell, `d = C z + o` with small coefficients:
//! equilibrium tells them.
//!
//! Divided by such a coefficient, rounding of `d` would be an error of `z` beside which no force counts. With the forces, both
//! relations together tell them,
//!
//! ```text
//! (K_hh + C_hᵀ D C_h) z_h = f_h + C_hᵀ F - K_hi z_i + C_hᵀ D (d - C_i z_i - o)
//! ```
//!
//! with `D` of the size of `K`, and nothing is divided by what is small. Without forces, they are those of the least energy
//! with these displacements, and the forces are Lagrange's multipliers.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::dependence::{Dependence, unit_of_pair, units};
use crate::linalg::columns::Columns;
use crate::linalg::factor::Factor;
use crate::linalg::matrix::Matrix;
use crate::linalg::pivoted_cholesky::PivotedCholesky;
use crate::linalg::sparse_matrix::entries_of;
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::norm_inf;

/// The factor of the matrix above.
#[derive(Clone, Debug)]
pub(super) struct ByEquilibrium {
    scale: Vec<f64>,
    factor: Arc<PivotedCholesky>,
}

/// The entries of `C_h`, each a row, a variable from the first of these on, and a coefficient.
fn entries(dependence: &Dependence) -> impl Iterator<Item = (usize, usize, f64)> {
    let first = dependence.told();
    (0..dependence.variables() - first).flat_map(move |k| {
        entries_of(&dependence.to_relative, first + k).map(move |(i, c)| (i, k, c))
    })
}

/// `1 / sqrt(K_kk)` of these variables, with a unit of those that nothing resists, and a matrix of `size` rows whose upper
/// left corner is their scaled `K_hh`.
fn scaled(
    dependence: &Dependence,
    (stiffness, otherwise): (&Matrix<'_>, f64),
    size: usize,
) -> (Vec<f64>, Columns) {
    let first = dependence.told();
    let of_variable = |k| stiffness.unit(k, 1, otherwise).sqrt().recip();
    let scale: Vec<f64> = (first..dependence.variables()).map(of_variable).collect();
    let mut matrix = Columns::zeros(size, size);
    for l in 0..scale.len() {
        for k in 0..scale.len() {
            matrix[(k, l)] = scale[k] * stiffness.at(first + k, first + l) * scale[l];
        }
    }
    (scale, matrix)
}

impl ByEquilibrium {
    /// `None` if there are no such variables. `units` are `D`, `otherwise` is the unit of a variable that nothing resists.
    pub(super) fn new(
        dependence: &Dependence,
        (stiffness, otherwise): (&Matrix<'_>, f64),
        units: impl Fn(usize) -> f64,
    ) -> Option<Self> {
        let size = dependence.variables() - dependence.told();
        if size == 0 {
            return None;
        }
        let (scale, mut matrix) = scaled(dependence, (stiffness, otherwise), size);
        let mut of_row: Vec<Vec<(usize, f64)>> = vec![Vec::new(); dependence.to_relative.nrows()];
        for (i, k, c) in entries(dependence) {
            of_row[i].push((k, c * scale[k]));
        }
        for (i, row) in of_row.iter().enumerate() {
            for &(k, b) in row {
                row.iter().for_each(|&(l, c)| matrix[(k, l)] += units(i) * b * c);
            }
        }
        let entry = |k: usize, l: usize| matrix[(k, l)];
        let factor = PivotedCholesky::within(size, NEGLIGIBLE, entry, &mut || true)?;
        Some(ByEquilibrium { scale, factor: Arc::new(factor) })
    }

    /// Overwrites the right side above with these variables; those that nothing tells are zero.
    pub(super) fn solve(&self, right: &mut [f64]) {
        let found = self.factor.solution(|k| self.scale[k] * right[k]);
        right.fill(0.0);
        found.into_iter().for_each(|(k, y)| right[k] = self.scale[k] * y);
    }
}

/// The variables of displacements whose contact forces are not known.
pub(crate) struct OfLeastEnergy<'d> {
    dependence: &'d Dependence,
    stiffness: Matrix<'d>,
    scale: Vec<f64>,
    /// The rows with such variables, ascending, and the roots of their units.
    rows: Vec<(usize, f64)>,
    /// Of `K_hh` and these rows, scaled; `None` if it is singular.
    factor: Option<Factor>,
}

impl<'d> OfLeastEnergy<'d> {
    /// `stiffness` is `K`, column-major.
    pub(crate) fn new(dependence: &'d Dependence, stiffness: &'d [f64]) -> Self {
        let variables = dependence.variables();
        let stiffness = Matrix::contiguous(variables, stiffness);
        let named: BTreeSet<usize> = entries(dependence).map(|(i, _, _)| i).collect();
        let units = units(dependence, (&stiffness, 1.0));
        let root = |i| unit_of_pair(&units, dependence.dim, i).sqrt();
        let rows: Vec<(usize, f64)> = named.into_iter().map(|i| (i, root(i))).collect();
        let size = variables - dependence.told();
        let all = size + rows.len();
        let (scale, mut matrix) = scaled(dependence, (&stiffness, norm_inf(&units)), all);
        for (i, k, c) in entries(dependence) {
            let place = rows.partition_point(|(row, _)| *row < i);
            let (scaled, place) = (rows[place].1 * c * scale[k], size + place);
            (matrix[(place, k)], matrix[(k, place)]) = (scaled, scaled);
        }
        // Displacements in doubles tell a variable as well as that.
        (size..all).for_each(|i| matrix[(i, i)] = -f64::EPSILON);
        let fill = |j: usize, column: &mut [f64]| column.copy_from_slice(matrix.column(j));
        let factor = Factor::new(all, false, 0.0, fill, &mut || true);
        OfLeastEnergy { dependence, stiffness, scale, rows, factor }
    }

    /// The variables of `d`, with `f`, which is asked if it is needed, and values of the fixed degrees of freedom.
    pub(crate) fn variables(
        &self,
        d: &[f64],
        load: impl FnOnce() -> Vec<f64>,
        prescribed: Option<&[f64]>,
    ) -> Vec<f64> {
        let mut variables = self.dependence.of_relative(d);
        let Some(factor) = self.factor.as_ref().filter(|_| !self.scale.is_empty()) else {
            return variables;
        };
        let told = self.dependence.told();
        let internal = self.stiffness.product(&variables);
        let forces = load().into_iter().zip(internal).skip(told).zip(&self.scale);
        let mut right: Vec<f64> = forces.map(|((f, own), scale)| scale * (f - own)).collect();
        let (relative, offset) =
            (self.dependence.relative(&variables), self.dependence.offset(prescribed));
        right.extend(self.rows.iter().map(|&(i, root)| root * (d[i] - relative[i] - offset[i])));
        factor.solve(&mut right);
        let others = variables[told..].iter_mut().zip(&self.scale).zip(&right);
        others.for_each(|((variable, scale), y)| *variable = scale * y);
        variables
    }
}
