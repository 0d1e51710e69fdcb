//! Rows of any degrees of freedom: chains, nodes in several pairs, slaves with supports, and rows that depend on
//! each other.
//!
//! Each axis of a pair is an equation `sum a_k u_k = delta` in degrees of freedom of the host. Independent
//! equations give a degree of freedom each, and with it the change of variables `u = T x + P p`; a slave
//! of its own gives its equation. What an equation says that follows
//! from others is a combination of their right sides and of fixed values. What an equation says that nearly follows from others is
//! such a combination too, with a little of other degrees of freedom, `delta_i = sum c_j delta_j + sum a_k u_k`: divided by the
//! `a_k` it would give one of them, and enlarge rounding in the stiffness by the square.
//!
//! The variables kept are the relative displacements `d` of a pair whose equations are all independent, or that
//! supports hold along directions of its frame, and the independent `delta` of other pairs. If there are others,
//! rows depend on each other, and the `u_k` above are kept too.

use std::collections::BTreeSet;

use super::change_of_variables::ChangeOfVariables;
use super::supports::FixedComponent;
use crate::error::Error;
use crate::linalg::row_elimination::{Expression, LEAST_PIVOT, Solved, Terms, solve};
use crate::linalg::sparse_matrix::OutOfMemory;
use crate::linalg::tolerances::SUSPICIOUS_PIVOT;
use crate::linalg::vector::norm_inf;
use crate::linalg::vector3::{self, Vector3, unit, without};
use crate::problem::Dependence;
use crate::reduce::equations::Dependents;
use crate::reduce::frame::Frame;
use crate::reduce::pairs::Rows;

/// The host's degrees of freedom, solved for general rows.
pub(super) struct GeneralRows {
    pub(super) variables: ChangeOfVariables,
    pub(super) supports: Vec<FixedComponent>,
    /// `None` if no row depends on others: the kept variables are `d`.
    pub(super) dependent: Option<Dependence>,
}

/// A pair's place among the variables.
enum RowPlace {
    /// `dim` variables from this one on: its components in its frame.
    Frame(usize),
    /// One for each axis that is independent.
    Axes(Vec<Option<usize>>),
}

/// The data that the parts share.
struct KeptRows<'r> {
    dim: usize,
    frames: &'r [Frame],
    /// The components that supports hold.
    held: Vec<bool>,
    /// The place of each degree of freedom among the fixed ones.
    fixed: &'r [Option<usize>],
    places: Vec<RowPlace>,
    /// The degrees of freedom that equations name which nearly follow from others, ascending; they are the last ones that are kept.
    hosts: Vec<usize>,
    kept: usize,
}

/// Solves `rows` for degrees of freedom of the host, of which `places` are those among the fixed ones, and which have a `stiffness` of
/// their own. Turns `frames` along what supports hold; about their normals at
/// will if they `may_turn`.
///
/// # Errors
/// Not enough memory.
pub(super) fn general_rows(
    rows: &Rows,
    (frames, may_turn): (&mut [Frame], bool),
    (places, stiffness, dependents): (&[Option<usize>], &[f64], &Dependents),
) -> Result<GeneralRows, Error> {
    let may_choose: Vec<bool> = places.iter().map(Option::is_none).collect();
    let units = units(rows, stiffness, dependents);
    // Where no row depends on others, each has its own stiffness as long as that keeps half of its digits.
    let mut least = SUSPICIOUS_PIVOT.sqrt();
    loop {
        let solved = solve(&rows.equations, &units, &may_choose, least);
        let mut supports = Vec::new();
        for (pair, frame) in frames.iter_mut().enumerate() {
            let pair = (pair, rows.dim);
            supports.extend(held_components((&solved, places), pair, (frame, may_turn)));
        }
        let kept = KeptRows::new(rows.dim, frames, places, &solved, &mut supports);
        if kept.are_independent() || least == LEAST_PIVOT {
            return kept.assembled(&solved, supports, dependents).map_err(|_| {
                Error::OutOfMemory("the contact rows, solved for degrees of freedom")
            });
        }
        least = LEAST_PIVOT;
    }
}

/// The unit of each degree of freedom's coefficients: the largest of them where it is that of an angle, whose coefficients are
/// arms. Small weights of a node in all rows are no unit of their own, and a small coefficient of a displacement in an equation is
/// none beside its weights, and beside its `stiffness`, by which an angle has the square of an arm.
fn units(rows: &Rows, stiffness: &[f64], dependents: &Dependents) -> Vec<f64> {
    // Coefficients of displacements are 1 at most; those this much larger or smaller are of another unit.
    let other = 1e4;
    let mut largest = dependents.largest_coefficients(stiffness.len());
    for &(k, a) in rows.equations.iter().flatten() {
        largest[k] = largest[k].max(a.abs());
    }
    let stiffest = norm_inf(stiffness).max(f64::MIN_POSITIVE);
    for (largest, own) in largest.iter_mut().zip(stiffness) {
        *largest = largest.max((own.abs() / stiffest).sqrt());
    }
    let is_of_length = |a: f64| (1.0 / other..=other).contains(&a);
    largest.into_iter().map(|a| if is_of_length(a) { 1.0 } else { a }).collect()
}

/// Equation `axis` of a pair in terms of others, if it follows from them.
fn dependent(solved: &Solved, pair: usize, dim: usize, axis: usize) -> Option<&Expression> {
    solved.dependent[dim * pair + axis].as_ref()
}

/// The components of a pair that supports hold along directions, with its frame turned exactly along them: none if none
/// are, or if one of its equations follows from those of other pairs or has other degrees of freedom left. A pair whose
/// nodes are fixed along every axis rests, as where a surface ends at a wall.
fn held_components(
    (solved, places): (&Solved, &[Option<usize>]),
    (pair, dim): (usize, usize),
    (frame, may_turn): (&mut Frame, bool),
) -> Vec<FixedComponent> {
    // The equations that follow from others of the pair and from fixed values, by axis.
    let of_axis = |axis| Some((axis, dependent(solved, pair, dim, axis)?));
    let of_axes: Vec<(usize, &Expression)> = (0..dim).filter_map(of_axis).collect();
    let own = dim * pair..dim * (pair + 1);
    let mut sides = of_axes.iter().flat_map(|(_, expression)| &expression.right_sides);
    let mut unknowns = of_axes.iter().flat_map(|(_, expression)| &expression.unknowns);
    let is_held = sides.all(|(equation, _)| own.contains(equation))
        && unknowns.all(|(dof, _)| places[*dof].is_some());
    if !is_held {
        return Vec::new();
    }
    let along = frame.along(&held_directions(&of_axes, dim), may_turn).unwrap_or_default();
    let fixed = |component: usize| {
        let direction = frame.direction(component);
        let of_axis = |(axis, expression): &(usize, &Expression)| {
            let part = direction[*axis];
            let values = expression.unknowns.iter();
            values.filter_map(|&(dof, a)| Some((places[dof]?, part * a))).collect::<Terms>()
        };
        let jump = of_axes.iter().flat_map(of_axis).filter(|(_, a)| *a != 0.0).collect();
        let component = dim * pair + component;
        FixedComponent { pair, component, variable: component, jump }
    };
    along.into_iter().map(fixed).collect()
}

/// Orthonormal directions along which a pair is held: of those with `delta_a = sum c_b delta_b + fixed values`.
fn held_directions(of_axes: &[(usize, &Expression)], dim: usize) -> Vec<Vector3> {
    let mut directions: Vec<Vector3> = Vec::new();
    for (axis, expression) in of_axes {
        let mut direction = vector3::axis(*axis);
        for (equation, share) in &expression.right_sides {
            direction[equation % dim] -= share;
        }
        directions.extend(unit(without(direction, &directions)));
    }
    directions
}

impl<'r> KeptRows<'r> {
    /// Numbers the variables, those of `supports` too.
    fn new(
        dim: usize,
        frames: &'r [Frame],
        fixed: &'r [Option<usize>],
        solved: &Solved,
        supports: &mut [FixedComponent],
    ) -> Self {
        let mut held = vec![false; dim * frames.len()];
        supports.iter().for_each(|support| held[support.component] = true);
        let mut kept = 0;
        let mut next = |count: usize| {
            kept += count;
            kept - count
        };
        let places: Vec<RowPlace> = (0..frames.len())
            .map(|pair| {
                let is_independent = |axis: usize| dependent(solved, pair, dim, axis).is_none();
                let independent = (0..dim).filter(|&axis| is_independent(axis)).count();
                let own = &held[dim * pair..dim * (pair + 1)];
                if independent + own.iter().filter(|held| **held).count() == dim {
                    RowPlace::Frame(next(dim))
                } else {
                    let place = |axis: usize| is_independent(axis).then(|| next(1));
                    RowPlace::Axes((0..dim).map(place).collect())
                }
            })
            .collect();
        for support in supports {
            if let RowPlace::Frame(first) = places[support.pair] {
                support.variable = first + support.component % dim;
            }
        }
        let named = solved.dependent.iter().flatten().flat_map(|expression| &expression.unknowns);
        let named = named.map(|(dof, _)| *dof).filter(|dof| fixed[*dof].is_none());
        let hosts: Vec<usize> = named.collect::<BTreeSet<usize>>().into_iter().collect();
        kept += hosts.len();
        KeptRows { dim, frames, held, fixed, places, hosts, kept }
    }

    /// `true` if no row depends on others.
    fn are_independent(&self) -> bool {
        self.places.iter().all(|place| matches!(place, RowPlace::Frame(_)))
    }

    /// The place of a degree of freedom that is kept.
    fn host(&self, dof: usize) -> Option<usize> {
        let first = self.kept - self.hosts.len();
        self.hosts.binary_search(&dof).ok().map(|k| first + k)
    }

    /// The right side of an independent equation in variables.
    fn right_side(&self, equation: usize) -> Terms {
        let (pair, axis) = (equation / self.dim, equation % self.dim);
        match &self.places[pair] {
            RowPlace::Frame(first) => {
                // A held component moves nothing.
                let directions = self.frames[pair].directions().enumerate();
                let moves = directions.filter(|(c, _)| !self.held[self.dim * pair + c]);
                moves.map(|(c, direction)| (first + c, direction[axis])).collect()
            }
            RowPlace::Axes(places) => places[axis].map(|place| (place, 1.0)).into_iter().collect(),
        }
    }

    fn right_sides(&self, terms: &Terms) -> Terms {
        let scaled = |&(equation, share): &(usize, f64)| {
            self.right_side(equation).into_iter().map(move |(k, part)| (k, share * part))
        };
        terms.iter().flat_map(scaled).collect()
    }

    fn assembled(
        &self,
        solved: &Solved,
        supports: Vec<FixedComponent>,
        dependents: &Dependents,
    ) -> Result<GeneralRows, OutOfMemory> {
        let sides = |terms: &Terms| self.right_sides(terms);
        let (places, given) = ((self.fixed, dependents), (&solved.given[..], self.kept));
        let variables = ChangeOfVariables::new(places, given, sides, (&self.hosts, &supports))?;
        let dependent = if self.are_independent() { None } else { Some(self.dependence(solved)?) };
        Ok(GeneralRows { variables, supports, dependent })
    }

    /// `d` of the variables and of fixed values.
    fn dependence(&self, solved: &Solved) -> Result<Dependence, OutOfMemory> {
        let (mut to_relative, mut from_relative, mut of_fixed) = (vec![], vec![], vec![]);
        let mut dependent_pairs = Vec::new();
        for (pair, place) in self.places.iter().enumerate() {
            if let RowPlace::Frame(first) = place {
                let same = (0..self.dim).map(|i| (self.dim * pair + i, first + i, 1.0));
                to_relative.extend(same.clone());
                from_relative.extend(same);
                continue;
            }
            dependent_pairs.push(pair);
            for (component, direction) in self.frames[pair].directions().enumerate() {
                let row = self.dim * pair + component;
                for (axis, &part) in direction.iter().enumerate() {
                    let entry = |(k, a): (usize, f64)| (row, k, part * a);
                    let Some(expression) = dependent(solved, pair, self.dim, axis) else {
                        let own = self.right_side(self.dim * pair + axis).into_iter().map(entry);
                        from_relative.extend(own.clone());
                        to_relative.extend(own);
                        continue;
                    };
                    let sides = self.right_sides(&expression.right_sides);
                    to_relative.extend(sides.into_iter().map(entry));
                    for &(dof, a) in &expression.unknowns {
                        let (entries, place) = match self.fixed[dof] {
                            Some(place) => (&mut of_fixed, Some(place)),
                            None => (&mut to_relative, self.host(dof)),
                        };
                        entries.extend(place.map(|place| entry((place, a))));
                    }
                }
            }
        }
        let count = self.dim * self.places.len();
        let matrices = [to_relative, from_relative];
        let shape = (count, self.kept);
        let fixed = self.fixed.iter().flatten().count();
        let rest = (self.hosts.len(), dependent_pairs);
        Dependence::new(self.dim, shape, matrices, (fixed, of_fixed), rest)
    }
}
