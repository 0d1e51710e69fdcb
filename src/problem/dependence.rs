//! How relative displacements follow from independent variables.

use crate::linalg::matrix::Matrix;
use crate::linalg::sparse_matrix::{
    Csc, OutOfMemory, entries_of, from_entries, times, transpose_times,
};
use crate::linalg::tolerances::ROUNDING;
use crate::linalg::vector::norm_inf;

/// How displacements follow from independent variables, `C` and `Z`, and from values of fixed degrees of freedom.
#[derive(Clone, Debug)]
pub struct Dependence {
    pub(super) dim: usize,
    /// `C`.
    pub(crate) to_relative: Csc,
    /// `Zᵀ`.
    pub(super) from_relative: Csc,
    /// A row for each displacement, a column for each fixed degree of freedom.
    of_fixed: Csc,
    /// For each variable that equilibrium tells, the last ones, the displacement that names it most: its forces are measured there.
    pub(super) by_equilibrium: Vec<usize>,
    /// Pairs whose rows follow from others.
    dependent_pairs: Vec<usize>,
}

impl Dependence {
    /// The dependence of pairs of `dim` components with the entries (row, column, value) of `C` and of
    /// `Zᵀ`; `shape` has their numbers of rows and columns. `of_fixed` has the entries for so many fixed degrees of
    /// freedom. Equilibrium tells the last `by_equilibrium` variables.
    pub(crate) fn new(
        dim: usize,
        shape: (usize, usize),
        [to_relative, from_relative]: [Vec<(usize, usize, f64)>; 2],
        (fixed, of_fixed): (usize, Vec<(usize, usize, f64)>),
        (by_equilibrium, dependent_pairs): (usize, Vec<usize>),
    ) -> Result<Self, OutOfMemory> {
        let to_relative = from_entries(shape, to_relative.into_iter())?;
        let names_most = |j: usize| {
            let named = entries_of(&to_relative, j);
            named.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(0, |(row, _)| row)
        };
        let by_equilibrium = (shape.1 - by_equilibrium..shape.1).map(names_most).collect();
        Ok(Dependence {
            dim,
            to_relative,
            by_equilibrium,
            from_relative: from_entries(shape, from_relative.into_iter())?,
            of_fixed: from_entries((shape.0, fixed), of_fixed.into_iter())?,
            dependent_pairs,
        })
    }

    /// Pairs whose rows follow from those of others, or from supports.
    pub fn dependent_pairs(&self) -> &[usize] {
        &self.dependent_pairs
    }

    /// Number of variables.
    pub fn variables(&self) -> usize {
        self.to_relative.ncols()
    }

    /// Number of variables that displacements tell: the first ones.
    pub(super) fn told(&self) -> usize {
        self.variables() - self.by_equilibrium.len()
    }

    /// `C z`.
    pub(crate) fn relative(&self, variables: &[f64]) -> Vec<f64> {
        times(&self.to_relative, variables)
    }

    /// `Z d`.
    pub(super) fn of_relative(&self, d: &[f64]) -> Vec<f64> {
        transpose_times(&self.from_relative, d)
    }

    /// Forces on the variables as forces of displacements, `Zᵀ`.
    pub(super) fn on_relative(&self, forces: &[f64]) -> Vec<f64> {
        let mut relative = times(&self.from_relative, forces);
        let others = self.by_equilibrium.iter().zip(&forces[self.told()..]);
        others.for_each(|(&i, force)| relative[i] += force);
        relative
    }

    /// The displacements that values of the fixed degrees of freedom (`None`: zero) add to those of the variables. Values that
    /// cancel, as those of a rigid turn, add none: their rounding would pass for gaps.
    pub(crate) fn offset(&self, prescribed: Option<&[f64]>) -> Vec<f64> {
        let (mut offset, mut sizes) = (vec![0.0; self.of_fixed.nrows()], Vec::new());
        sizes.clone_from(&offset);
        for (j, value) in prescribed.unwrap_or_default().iter().enumerate() {
            for (i, part) in entries_of(&self.of_fixed, j) {
                offset[i] += part * value;
                sizes[i] += (part * value).abs();
            }
        }
        let left = offset.iter_mut().zip(sizes).filter(|(sum, size)| sum.abs() <= ROUNDING * size);
        left.for_each(|(sum, _)| *sum = 0.0);
        offset
    }

    /// `Cᵀ F`.
    pub(crate) fn forces(&self, force: &[f64]) -> Vec<f64> {
        transpose_times(&self.to_relative, force)
    }
}

/// The diagonal of `K`, positive: where nothing resists a variable, its largest entry, and without any `of_rigid`. Entries of the
/// variables are off by rounding, so that energies of the square of it are none.
pub(super) fn units_of_variables((stiffness, of_rigid): (&Matrix<'_>, f64)) -> Vec<f64> {
    let largest = stiffness.largest_diagonal();
    let otherwise = if largest > 0.0 { largest } else { of_rigid };
    let rounding = (f64::EPSILON * stiffness.size() as f64).powi(2) * largest;
    let is_resisted = |j: &usize| stiffness.at(*j, *j) > rounding;
    (0..stiffness.size())
        .map(|j| if is_resisted(&j) { stiffness.unit(j, 1, otherwise) } else { otherwise })
        .collect()
}

/// The diagonal of `K` in series over the variables of a row, the least of a pair for its tangents.
pub(super) fn units(
    dependence: &Dependence,
    (stiffness, of_rigid): (&Matrix<'_>, f64),
) -> Vec<f64> {
    let of_variables = units_of_variables((stiffness, of_rigid));
    let otherwise = if of_variables.is_empty() { of_rigid } else { norm_inf(&of_variables) };
    let mut compliance = vec![0.0; dependence.to_relative.nrows()];
    for (j, unit) in of_variables.iter().enumerate() {
        let column = entries_of(&dependence.to_relative, j);
        column.for_each(|(i, c)| compliance[i] += c * c / unit);
    }
    let unit = |compliance: &f64| if *compliance > 0.0 { 1.0 / compliance } else { otherwise };
    let mut units: Vec<f64> = compliance.iter().map(unit).collect();
    for pair in units.chunks_exact_mut(dependence.dim) {
        let least = pair[1..].iter().copied().fold(f64::INFINITY, f64::min);
        pair[1..].fill(least);
    }
    units
}

/// The least unit of the pair of a component.
pub(super) fn unit_of_pair(units: &[f64], dim: usize, i: usize) -> f64 {
    let first = i - i % dim;
    units[first].min(units[first + 1])
}
