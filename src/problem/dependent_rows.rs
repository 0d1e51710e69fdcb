//! Rows that depend on each other: a node on two planes, pairs in both directions between two surfaces, a
//! node named twice. Their relative displacements are those of independent variables `z`:
//!
//! ```text
//! d = C z + o,    K z = f + Cᵀ F
//! ```
//!
//! `C` has more rows than columns, and `d` does not determine `F`: forces with `Cᵀ F = 0` balance each
//! other. `Z` takes the variables from the displacements: `z = Z d`, `Z C = 1`, `Z o = 0`, and its rows are
//! orthonormal. `o` comes from values of fixed degrees of freedom.

use super::free_block::FreeBlock;
use super::relation::{Redundant, Relation};
use crate::linalg::matrix::Matrix;
use crate::linalg::sparse_matrix::{
    Csc, OutOfMemory, column, entries, from_entries, times, transpose_times,
};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{largest_of, norm, norm_inf};
use crate::linalg::watched::GoesOn;

/// Why rows of surfaces nearly depend on each other, and what to do.
pub(crate) const NEARLY_DEPENDENT: &str = "if two surfaces are each other's slaves, let one side be the slave; if slaves along a \
     plane of symmetry are finer than what they face, name the plane where they are paired, or let the other side be \
     the slave";

/// How displacements follow from independent variables, `C` and `Z`, and from values of fixed degrees of freedom.
#[derive(Clone, Debug)]
pub struct Dependence {
    dim: usize,
    /// `C`.
    pub(crate) to_relative: Csc,
    /// `Zᵀ`.
    from_relative: Csc,
    /// A row for each displacement, a column for each fixed degree of freedom.
    of_fixed: Csc,
    /// Pairs whose rows follow from others.
    dependent_pairs: Vec<usize>,
}

impl Dependence {
    /// The dependence of pairs of `dim` components with the entries (row, column, value) of `C` and of
    /// `Zᵀ`; `shape` has their numbers of rows and columns. `of_fixed` has the entries for so many fixed degrees of
    /// freedom.
    pub(crate) fn new(
        dim: usize,
        shape: (usize, usize),
        [to_relative, from_relative]: [Vec<(usize, usize, f64)>; 2],
        (fixed, of_fixed): (usize, Vec<(usize, usize, f64)>),
        dependent_pairs: Vec<usize>,
    ) -> Result<Self, OutOfMemory> {
        Ok(Dependence {
            dim,
            to_relative: from_entries(shape, to_relative.into_iter())?,
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

    /// `C z`.
    pub(crate) fn relative(&self, variables: &[f64]) -> Vec<f64> {
        times(&self.to_relative, variables)
    }

    /// `Z d`.
    pub(crate) fn of_relative(&self, d: &[f64]) -> Vec<f64> {
        transpose_times(&self.from_relative, d)
    }

    /// The displacements that values of the fixed degrees of freedom (`None`: zero) add to those of the variables.
    pub(crate) fn offset(&self, prescribed: Option<&[f64]>) -> Vec<f64> {
        match prescribed {
            Some(values) => times(&self.of_fixed, values),
            None => vec![0.0; self.of_fixed.nrows()],
        }
    }

    /// `Cᵀ F`.
    pub(crate) fn forces(&self, force: &[f64]) -> Vec<f64> {
        transpose_times(&self.to_relative, force)
    }
}

/// The relation of rows that depend on each other.
#[derive(Clone, Debug)]
pub struct DependentRows<'a> {
    /// `C` and `Z`.
    pub(crate) dependence: &'a Dependence,
    /// `K`.
    pub(crate) stiffness: Matrix<'a>,
    /// `f`.
    pub(super) load: &'a [f64],
    offset: &'a [f64],
    /// Positive units of force per length, one for each component, the same for all tangents of a pair.
    pub(crate) units: Vec<f64>,
    /// `Zᵀ f`, and what drives the offsets.
    relative_load: Vec<f64>,
    /// The growth of the row of each variable; empty: none has grown.
    pub(super) growth: &'a [f64],
    /// The unit of variables if `K` resists none: rigid bodies.
    pub(super) of_rigid: f64,
    /// Size of the relative load without it.
    size_of_load: f64,
}

impl<'a> DependentRows<'a> {
    /// `stiffness`, column-major, and `load` are `K` and `f`; `offset` is `o`; `growth` is that of the variables' rows, empty if
    /// none has grown; `of_rigid` is the unit of variables if `K` is zero, a force over a length.
    pub(crate) fn new(
        dependence: &'a Dependence,
        (stiffness, load): (&'a [f64], &'a [f64]),
        offset: &'a [f64],
        (growth, of_rigid): (&'a [f64], f64),
    ) -> Self {
        let size = dependence.variables();
        let stiffness = Matrix::new(size, stiffness, size.max(1));
        let units = units(dependence, (&stiffness, of_rigid));
        let relative = |load: &[f64]| {
            let mut relative = times(&dependence.from_relative, load);
            let offsets = units.iter().zip(offset).map(|(unit, offset)| unit * offset);
            relative.iter_mut().zip(offsets).for_each(|(load, offset)| *load += offset);
            relative
        };
        let relative_load = relative(load);
        let size_of_load = match growth.is_empty() {
            true => norm(&relative_load),
            false => {
                let grown = load.iter().zip(growth).map(|(load, growth)| load / growth);
                norm(&relative(&grown.collect::<Vec<f64>>()))
            }
        };
        DependentRows {
            dependence,
            stiffness,
            load,
            offset,
            units,
            relative_load,
            growth,
            of_rigid,
            size_of_load,
        }
    }

    /// A basis of the displacements that `K` does not resist; `None` if rounding leaves `K` energies below zero, or where
    /// `goes_on` says no.
    pub(crate) fn free_motions(&self, goes_on: GoesOn<'_>) -> Option<Vec<Vec<f64>>> {
        let scale =
            units_of((&self.stiffness, self.of_rigid)).map(|unit| unit.sqrt().recip()).collect();
        let all = (0..self.stiffness.size()).collect();
        let block = FreeBlock::new(self.stiffness, all, scale, goes_on)?;
        Some(block.null_vectors().map(|motion| self.dependence.relative(&motion)).collect())
    }

    /// `C z + o`.
    pub(crate) fn relative(&self, variables: &[f64]) -> Vec<f64> {
        let mut d = self.dependence.relative(variables);
        d.iter_mut().zip(self.offset).for_each(|(d, offset)| *d += offset);
        d
    }

    /// The unbalanced part `f + Cᵀ F - K z`: a force for each variable.
    pub(crate) fn unbalanced(&self, variables: &[f64], force: &[f64]) -> Vec<f64> {
        let mut left = self.dependence.forces(force);
        left.iter_mut().zip(self.load).for_each(|(left, load)| *left += load);
        let internal = self.stiffness.product(variables);
        left.iter_mut().zip(internal).for_each(|(left, internal)| *left -= internal);
        left
    }
}

/// The diagonal of `K`, positive: where nothing resists a variable, its largest entry, and without any `of_rigid`.
fn units_of((stiffness, of_rigid): (&Matrix<'_>, f64)) -> impl Iterator<Item = f64> {
    let otherwise = match stiffness.largest_diagonal() {
        largest if largest > 0.0 => largest,
        _ => of_rigid,
    };
    (0..stiffness.size()).map(move |j| stiffness.unit(j, 1, otherwise))
}

/// The diagonal of `K` in series over the variables of a row, the least of a pair for its tangents.
fn units(dependence: &Dependence, (stiffness, of_rigid): (&Matrix<'_>, f64)) -> Vec<f64> {
    let largest = units_of((stiffness, of_rigid)).fold(0.0, f64::max);
    let otherwise = if largest > 0.0 { largest } else { of_rigid };
    let mut compliance = vec![0.0; dependence.to_relative.nrows()];
    for (j, unit) in units_of((stiffness, of_rigid)).enumerate() {
        let (rows, values) = column(&dependence.to_relative, j);
        rows.iter().zip(values).for_each(|(&i, c)| compliance[i] += c * c / unit);
    }
    let unit = |compliance: &f64| if *compliance > 0.0 { 1.0 / compliance } else { otherwise };
    let mut units: Vec<f64> = compliance.iter().map(unit).collect();
    for pair in units.chunks_exact_mut(dependence.dim) {
        let least = pair[1..].iter().copied().fold(f64::INFINITY, f64::min);
        pair[1..].fill(least);
    }
    units
}

impl Relation for DependentRows<'_> {
    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.units[i] } else { 0.0 }
    }

    fn load(&self) -> &[f64] {
        &self.relative_load
    }

    fn size_of_load(&self) -> f64 {
        self.size_of_load
    }

    /// `Zᵀ (K z - f - Cᵀ F)` with `z = Z d`, and the unit of the pair times `d - C z - o`, which is across it.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let variables = self.dependence.of_relative(d);
        let left = self.unbalanced(&variables, force);
        let mut residual = times(&self.dependence.from_relative, &left);
        residual.iter_mut().for_each(|left| *left = -*left);
        let relative = self.relative(&variables);
        for (i, residual) in residual.iter_mut().enumerate() {
            *residual += self.unit_of_pair(i) * (d[i] - relative[i]);
        }
        residual
    }

    fn magnitude(&self, size: &[f64]) -> Vec<f64> {
        let absolute = |a: &Csc, x: &[f64], y: &mut [f64], transpose: bool| {
            for (i, j, value) in entries(a) {
                let (to, from) = if transpose { (j, i) } else { (i, j) };
                y[to] += value.abs() * x[from];
            }
        };
        let dependence = self.dependence;
        let mut of_variables = vec![0.0; dependence.variables()];
        absolute(&dependence.from_relative, size, &mut of_variables, true);
        let forces = self.stiffness.magnitude(&of_variables);
        let (mut sum, mut relative) = (vec![0.0; size.len()], size.to_vec());
        absolute(&dependence.from_relative, &forces, &mut sum, false);
        absolute(&dependence.to_relative, &of_variables, &mut relative, false);
        sum.iter_mut().zip(&relative).enumerate().for_each(|(i, (sum, relative))| {
            *sum += self.unit_of_pair(i) * relative;
        });
        sum
    }

    /// Forces that balance each other may be of any size, and would hide what is left of all others. `Cᵀ F` is the norm of the
    /// forces `Zᵀ Cᵀ F`, which move what `F` moves.
    fn size_of_force(&self, force: &[f64]) -> f64 {
        norm(force).min(norm(&self.dependence.forces(force)))
    }
}

impl DependentRows<'_> {
    fn unit_of_pair(&self, i: usize) -> f64 {
        let first = i - i % self.dependence.dim;
        self.units[first].min(self.units[first + 1])
    }
}

impl Redundant for DependentRows<'_> {
    fn offset(&self) -> &[f64] {
        self.offset
    }

    /// `Cᵀ F = 0`, up to rounding of the size of the forces.
    fn balance_each_other(&self, force: &[f64], within: f64) -> bool {
        let coefficients = largest_of(self.dependence.to_relative.val().iter().map(|c| c.abs()));
        norm_inf(&self.dependence.forces(force))
            <= within.max(NEGLIGIBLE) * coefficients * norm_inf(force)
    }
}
