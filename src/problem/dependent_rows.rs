//! Rows that depend on each other: a node on two planes, pairs in both directions between two surfaces, a
//! node named twice. Their relative displacements are those of independent variables `z`:
//!
//! ```text
//! d = C z + o,    K z = f + Cᵀ F
//! ```
//!
//! `C` has more rows than columns, and `d` does not determine `F`: forces with `Cᵀ F = 0` balance each
//! other. `Z` takes the variables from the displacements: `z = Z d`, `Z C = 1`, `Z o = 0`, and its rows are
//! orthonormal; the last variables of rows that nearly depend on each other have none ([`super::by_equilibrium`]). `o` comes from
//! values of fixed degrees of freedom.

use super::by_equilibrium::ByEquilibrium;
use super::dependence::{Dependence, unit_of_pair, units, units_of_variables};
use super::free_block::FreeBlock;
use super::relation::{Redundant, Relation};
use crate::linalg::free_motions::orthonormal;
use crate::linalg::matrix::Matrix;
use crate::linalg::sparse_matrix::{Csc, entries};
use crate::linalg::tolerances::NEGLIGIBLE;
use crate::linalg::vector::{largest_of, norm, norm_inf, normalise};
use crate::linalg::watched::GoesOn;

/// Why rows of surfaces nearly depend on each other, and what to do.
pub(crate) const NEARLY_DEPENDENT: &str = "if two surfaces are each other's slaves, let one side be the slave; if slaves along a \
     plane of symmetry are finer than what they face, name the plane where they are paired, or let the other side be \
     the slave";

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
    /// The unit of variables if `K` resists none: rigid bodies.
    pub(super) of_rigid: f64,
    by_equilibrium: Option<ByEquilibrium>,
}

impl<'a> DependentRows<'a> {
    /// `stiffness`, column-major, and `load` are `K` and `f`; `offset` is `o`; `of_rigid` is the unit of variables if `K` is zero, a
    /// force over a length.
    pub(crate) fn new(
        dependence: &'a Dependence,
        (stiffness, load): (&'a [f64], &'a [f64]),
        offset: &'a [f64],
        of_rigid: f64,
    ) -> Self {
        let stiffness = Matrix::contiguous(dependence.variables(), stiffness);
        let units = units(dependence, (&stiffness, of_rigid));
        let mut relative_load = dependence.on_relative(load);
        let offsets = units.iter().zip(offset).map(|(unit, offset)| unit * offset);
        relative_load.iter_mut().zip(offsets).for_each(|(load, offset)| *load += offset);
        let unit = |i: usize| unit_of_pair(&units, dependence.dim, i);
        let with_unit = (&stiffness, norm_inf(&units));
        let by_equilibrium = ByEquilibrium::new(dependence, with_unit, unit);
        DependentRows {
            dependence,
            stiffness,
            load,
            offset,
            units,
            relative_load,
            of_rigid,
            by_equilibrium,
        }
    }

    /// A basis of the displacements that `K` does not resist, orthonormal with each component times the root of its unit; `None` if
    /// rounding leaves `K` energies below zero, or where `goes_on` says no.
    pub(crate) fn free_motions(&self, goes_on: GoesOn<'_>) -> Option<Vec<Vec<f64>>> {
        let units = units_of_variables((&self.stiffness, self.of_rigid));
        let scale = units.iter().map(|unit| unit.sqrt().recip()).collect();
        let all = (0..self.stiffness.size()).collect();
        let block = FreeBlock::new(self.stiffness, all, scale, &mut *goes_on)?;
        let scaled = |motion: Vec<f64>| {
            let mut scaled = self.dependence.relative(&motion);
            scaled.iter_mut().zip(&self.units).for_each(|(d, unit)| *d *= unit.sqrt());
            normalise(&mut scaled);
            scaled
        };
        let motions: Vec<Vec<f64>> = block.null_vectors().map(scaled).collect();
        let count = motions.len();
        orthonormal(motions, count, goes_on)
    }

    /// `C z + o`.
    pub(crate) fn relative(&self, variables: &[f64]) -> Vec<f64> {
        let mut d = self.dependence.relative(variables);
        d.iter_mut().zip(self.offset).for_each(|(d, offset)| *d += offset);
        d
    }

    /// The variables of displacements and contact forces.
    pub(crate) fn variables(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let mut variables = self.dependence.of_relative(d);
        if let Some(by_equilibrium) = &self.by_equilibrium {
            let told = self.dependence.told();
            let springs = self.dependence.forces(&self.springs(d, &variables));
            let forces = self.unbalanced(&variables, force).into_iter().zip(springs).skip(told);
            let mut others: Vec<f64> = forces.map(|(left, springs)| left + springs).collect();
            by_equilibrium.solve(&mut others);
            variables[told..].copy_from_slice(&others);
        }
        variables
    }

    /// The unit of the pair times `d - C z - o`.
    fn springs(&self, d: &[f64], variables: &[f64]) -> Vec<f64> {
        let left = d.iter().zip(self.relative(variables)).enumerate();
        left.map(|(i, (d, relative))| self.unit_of_pair(i) * (d - relative)).collect()
    }

    fn unit_of_pair(&self, i: usize) -> f64 {
        unit_of_pair(&self.units, self.dependence.dim, i)
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

impl Relation for DependentRows<'_> {
    fn block(&self, i: usize, j: usize) -> f64 {
        if i == j { self.units[i] } else { 0.0 }
    }

    fn load(&self) -> &[f64] {
        &self.relative_load
    }

    /// `Zᵀ (K z - f - Cᵀ F)`, and the unit of the pair times `d - C z - o`, which is across it.
    fn residual(&self, d: &[f64], force: &[f64]) -> Vec<f64> {
        let variables = self.variables(d, force);
        let left = self.dependence.on_relative(&self.unbalanced(&variables, force));
        let springs = self.springs(d, &variables).into_iter();
        springs.zip(left).map(|(spring, left)| spring - left).collect()
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
        let named = dependence.by_equilibrium.iter().map(|&i| size[i]);
        of_variables[dependence.told()..].iter_mut().zip(named).for_each(|(z, size)| *z = size);
        let forces = self.stiffness.magnitude(&of_variables);
        let (mut sum, mut relative) = (vec![0.0; size.len()], size.to_vec());
        absolute(&dependence.from_relative, &forces, &mut sum, false);
        let others = dependence.by_equilibrium.iter().zip(&forces[dependence.told()..]);
        others.for_each(|(&i, force)| sum[i] += force);
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
