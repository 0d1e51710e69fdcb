//! Rows of any nodes: chains, nodes in several pairs, slaves with supports, and rows that depend on each
//! other.
//!
//! Each axis of a pair is an equation `sum a_k u_k = delta` in degrees of freedom of the host. Independent
//! equations give a degree of freedom each, and with it the change of variables `u = T x + P p`; a slave
//! of its own gives its equation. What an equation says that follows
//! from others is a combination of their right sides and of fixed values.
//!
//! The variables kept are the relative displacements `d` of a pair whose axes are all independent, or fixed
//! along a direction of its frame, and the independent `delta` of other pairs. If there are others, rows
//! depend on each other.

use super::change_of_variables::{ChangeOfVariables, VariableColumns};
use super::messages;
use super::supports::FixedComponent;
use crate::error::{Argument, Error};
use crate::linalg::row_elimination::{Expression, Solved, Terms, solve};
use crate::linalg::sparse_matrix::OutOfMemory;
use crate::problem::Dependence;
use crate::reduce::frame::Frame;
use crate::reduce::pairs::ContactPairs;

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
struct Rows<'r> {
    dim: usize,
    frames: &'r [Frame],
    /// The place of each degree of freedom among the fixed ones.
    fixed: &'r [Option<usize>],
    places: Vec<RowPlace>,
    kept: usize,
}

/// Solves the rows of `pairs` for degrees of freedom; `places` are those of fixed ones in `fixed`. Turns
/// frames along axes that supports fix.
///
/// # Errors
/// A pair that moves nothing; not enough memory.
pub(super) fn general_rows(
    pairs: &ContactPairs<'_>,
    frames: &mut [Frame],
    places: &[Option<usize>],
) -> Result<GeneralRows, Error> {
    let equations: Vec<Terms> = (0..pairs.count)
        .flat_map(|pair| (0..pairs.dim).map(move |axis| (pair, axis)))
        .map(|(pair, axis)| pairs.row(pair).map(|(weight, dofs)| (dofs[axis], weight)).collect())
        .collect();
    let may_choose: Vec<bool> = places.iter().map(Option::is_none).collect();
    let solved = solve(&equations, places.len(), &may_choose);
    let (mut supports, own) = (Vec::new(), pairs.have_own_slaves(places.len()));
    for (pair, frame) in frames.iter_mut().enumerate() {
        supports.extend(held((pair, own), frame, &solved, places)?);
    }
    let rows = Rows::new(pairs.dim, frames, places, &solved, &mut supports);
    rows.assembled(&solved, supports)
        .map_err(|_| Error::OutOfMemory("the contact rows, solved for degrees of freedom"))
}

/// Equation `axis` of a pair in terms of others, if it follows from them.
fn dependent(solved: &Solved, pair: usize, dim: usize, axis: usize) -> Option<&Expression> {
    solved.dependent[dim * pair + axis].as_ref()
}

/// The components of a pair that supports fix, and its frame turned exactly along them; none if one of its
/// axes follows from other pairs, or is fixed and no direction of the frame.
///
/// # Errors
/// A pair that supports fix wholly, as general rows by mistake may be. With a slave of its `own` it is legal if its
/// frame stands along the axes.
fn held(
    (pair, own): (usize, bool),
    frame: &mut Frame,
    solved: &Solved,
    places: &[Option<usize>],
) -> Result<Vec<FixedComponent>, Error> {
    let dim = frame.directions().count();
    let is_held = |axis: usize| {
        let expression = dependent(solved, pair, dim, axis);
        expression.is_some_and(|expression| expression.right_sides.is_empty())
    };
    let held: Vec<usize> = (0..dim).filter(|&axis| is_held(axis)).collect();
    let along: Option<Vec<usize>> = held.iter().map(|&axis| frame.component_along(axis)).collect();
    if held.len() == dim && !(own && along.is_some()) {
        return Err(Error::invalid(Argument::Pairs, messages::moves_nothing(pair)));
    }
    let dependent_axes = (0..dim).filter(|&axis| dependent(solved, pair, dim, axis).is_some());
    if dependent_axes.count() != held.len() {
        return Ok(Vec::new());
    }
    let Some(along) = along else { return Ok(Vec::new()) };
    let fixed = |(&axis, &along): (&usize, &usize)| {
        frame.align(along, axis);
        let terms = dependent(solved, pair, dim, axis).map_or(&[][..], |terms| &terms.unknowns);
        let jump = terms.iter().filter_map(|&(dof, a)| Some((places[dof]?, a))).collect();
        let component = dim * pair + along;
        FixedComponent { pair, component, variable: component, jump }
    };
    Ok(held.iter().zip(&along).map(fixed).collect())
}

impl<'r> Rows<'r> {
    /// Numbers the variables, those of `supports` too.
    fn new(
        dim: usize,
        frames: &'r [Frame],
        fixed: &'r [Option<usize>],
        solved: &Solved,
        supports: &mut [FixedComponent],
    ) -> Self {
        let mut held = vec![0; frames.len()];
        supports.iter().for_each(|support| held[support.pair] += 1);
        let mut kept = 0;
        let mut next = || {
            kept += 1;
            kept - 1
        };
        let places: Vec<RowPlace> = (0..frames.len())
            .map(|pair| {
                let is_independent = |axis: usize| dependent(solved, pair, dim, axis).is_none();
                let independent = (0..dim).filter(|&axis| is_independent(axis)).count();
                if independent + held[pair] == dim {
                    let first = next();
                    (1..dim).for_each(|_| _ = next());
                    RowPlace::Frame(first)
                } else {
                    RowPlace::Axes(
                        (0..dim).map(|axis| is_independent(axis).then(&mut next)).collect(),
                    )
                }
            })
            .collect();
        for support in supports {
            if let RowPlace::Frame(first) = places[support.pair] {
                support.variable = first + support.component % dim;
            }
        }
        Rows { dim, frames, fixed, places, kept }
    }

    /// The right side of an independent equation in variables.
    fn right_side(&self, equation: usize) -> Terms {
        let (pair, axis) = (equation / self.dim, equation % self.dim);
        match &self.places[pair] {
            RowPlace::Frame(first) => {
                let directions = self.frames[pair].directions().enumerate();
                directions
                    .map(|(component, direction)| (first + component, direction[axis]))
                    .collect()
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
    ) -> Result<GeneralRows, OutOfMemory> {
        let given = solved.given.iter().map(|(dof, _)| *dof);
        let mut columns = VariableColumns::new(self.fixed, given, self.kept);
        let VariableColumns { free, of_dof: column, entries, .. } = &mut columns;
        for (dof, expression) in &solved.given {
            // Unknowns that no equation gives have a column.
            let unknowns = expression.unknowns.iter();
            entries.extend(unknowns.filter_map(|&(k, a)| Some((*dof, column[k]?, a))));
            let sides = self.right_sides(&expression.right_sides);
            entries.extend(sides.into_iter().map(|(k, a)| (*dof, free.len() + k, a)));
        }
        let fixed = columns.fixed;
        let variables = ChangeOfVariables::new(columns, &supports)?;
        let depends = self.places.iter().any(|place| matches!(place, RowPlace::Axes(_)));
        let dependent = if depends { Some(self.dependence(solved, fixed)?) } else { None };
        Ok(GeneralRows { variables, supports, dependent })
    }

    /// `d` of the variables and of fixed values.
    fn dependence(&self, solved: &Solved, fixed: usize) -> Result<Dependence, OutOfMemory> {
        let (mut to_relative, mut from_relative, mut of_fixed) = (vec![], vec![], vec![]);
        let mut dependent_pairs = Vec::new();
        for (pair, place) in self.places.iter().enumerate() {
            let places = match place {
                RowPlace::Frame(first) => {
                    let same = (0..self.dim).map(|i| (self.dim * pair + i, first + i, 1.0));
                    to_relative.extend(same.clone());
                    from_relative.extend(same);
                    continue;
                }
                RowPlace::Axes(places) => places,
            };
            dependent_pairs.push(pair);
            for (component, direction) in self.frames[pair].directions().enumerate() {
                let row = self.dim * pair + component;
                for (axis, &part) in direction.iter().enumerate() {
                    let entry = |(k, a): (usize, f64)| (row, k, part * a);
                    match (places[axis], dependent(solved, pair, self.dim, axis)) {
                        (Some(place), _) => {
                            to_relative.push((row, place, part));
                            from_relative.push((row, place, part));
                        }
                        (None, Some(expression)) => {
                            let sides = self.right_sides(&expression.right_sides);
                            to_relative.extend(sides.into_iter().map(entry));
                            let values = expression.unknowns.iter();
                            let values = values.filter_map(|&(dof, a)| Some((self.fixed[dof]?, a)));
                            of_fixed.extend(values.map(entry));
                        }
                        (None, None) => {}
                    }
                }
            }
        }
        let count = self.dim * self.places.len();
        let matrices = [to_relative, from_relative];
        let shape = (count, self.kept);
        Dependence::new(self.dim, shape, matrices, (fixed, of_fixed), dependent_pairs)
    }
}
