//! Equations between degrees of freedom of a host: multi-point constraints, rigid bodies, turned axes.

use std::collections::{BTreeMap, HashMap};

use crate::error::{Argument, Error, MOST_NAMED, index};
use crate::linalg::row_elimination::{Terms, gathered, largest, replaced};
use crate::linalg::tolerances::ROUNDING;

/// `u[dependent] = sum coefficient * u[dof]`, equation by equation; one without terms says `u[dependent] = 0`.
///
/// A dependent may be a degree of freedom of the matrix, which is eliminated then, or any other number, by which
/// pairs and other equations name it. No order of the equations is needed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Equations<'a> {
    /// The degree of freedom that each equation gives.
    pub dependent: &'a [usize],
    /// Start of each equation's terms, and their number: one entry more than equations. Without equations empty.
    pub start: &'a [usize],
    /// The degree of freedom of each term.
    pub dofs: &'a [usize],
    /// Its coefficient.
    pub coefficients: &'a [f64],
}

pub(super) fn refuse<T>(message: String) -> Result<T, Error> {
    Argument::Pairs.refuse(message)
}

impl Equations<'_> {
    /// Degree of freedom and coefficient of each term of an equation.
    fn terms(&self, equation: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.start[equation]..self.start[equation + 1];
        range.map(|k| (self.dofs[k], self.coefficients[k]))
    }

    fn check(&self) -> Result<(), Error> {
        let (start, count) = (self.start, self.dependent.len());
        let (given, needed) = (start.len(), count + usize::from(count > 0));
        if given != needed {
            return refuse(format!("equations: start has {given} entries, it must have {needed}"));
        }
        let descends = (0..count).find(|&k| start[k] > start[k + 1]);
        if let Some(k) = descends {
            return refuse(format!(
                "equation {}: its terms begin after they end, start must not descend",
                index(k)
            ));
        }
        let (first, last) = (start.first().copied(), start.last().copied());
        let terms = self.dofs.len();
        if first.unwrap_or(0) != 0 || [last.unwrap_or(0), self.coefficients.len()] != [terms; 2] {
            return refuse(format!(
                "equations: start must lead from the first of dofs, which are {terms}, to the last one, and each \
                 of dofs must have a coefficient"
            ));
        }
        let is_wrong = |k: &usize| self.terms(*k).any(|(_, a)| !a.is_finite());
        match (0..count).find(is_wrong) {
            Some(k) => refuse(format!("equation {}: a coefficient is not finite", index(k))),
            None => Ok(()),
        }
    }

    /// The equation of each dependent degree of freedom.
    fn places(&self) -> Result<HashMap<usize, usize>, Error> {
        let mut places = HashMap::new();
        for (k, &dof) in self.dependent.iter().enumerate() {
            if let Some(before) = places.insert(dof, k) {
                return refuse(format!(
                    "equation {}: it gives degree of freedom {}, as equation {} does: name another one of \
                     its degrees of freedom dependent",
                    index(k),
                    index(dof),
                    index(before)
                ));
            }
        }
        Ok(places)
    }

    /// The equations of the dependents of which an equation makes its own: not those that it names with coefficient 0.
    fn awaited(&self, k: usize, places: &HashMap<usize, usize>) -> impl Iterator<Item = usize> {
        let named = self.terms(k).filter(|(_, a)| *a != 0.0);
        named.filter_map(|(dof, _)| places.get(&dof).copied())
    }

    /// The equations, each behind those of the dependents of which it makes its own.
    fn order(&self, places: &HashMap<usize, usize>) -> Result<Vec<usize>, Error> {
        let count = self.dependent.len();
        let (mut waits_for, mut awaited_by) = (vec![0; count], vec![Vec::new(); count]);
        for (k, waits_for) in waits_for.iter_mut().enumerate() {
            for other in self.awaited(k, places) {
                awaited_by[other].push(k);
                *waits_for += 1;
            }
        }
        let mut order: Vec<usize> = (0..count).filter(|&k| waits_for[k] == 0).collect();
        let mut done = 0;
        while let Some(&next) = order.get(done) {
            done += 1;
            for &k in &awaited_by[next] {
                waits_for[k] -= 1;
                if waits_for[k] == 0 {
                    order.push(k);
                }
            }
        }
        match (0..count).find(|&k| waits_for[k] > 0) {
            Some(k) => refuse(self.circle(k, places, &waits_for)),
            None => Ok(order),
        }
    }

    /// A circle that equations lead to which wait for each other, `first` among them.
    fn circle(&self, first: usize, places: &HashMap<usize, usize>, waits_for: &[usize]) -> String {
        let (mut path, mut at) = (Vec::new(), first);
        while !path.contains(&at) {
            path.push(at);
            at = self.awaited(at, places).find(|&k| waits_for[k] > 0).unwrap_or(at);
        }
        let begin = path.iter().position(|&k| k == at).unwrap_or(0);
        let name = |k: &usize| index(self.dependent[*k]).to_string();
        let names: Vec<String> = path[begin..].iter().take(MOST_NAMED).map(name).collect();
        let more = if path.len() - begin > MOST_NAMED { ", ..." } else { "" };
        format!(
            "equation {}: its dependent degree of freedom follows from itself, by way of {}{more}: solve the \
             equations of the circle for one of them",
            index(at),
            names.join(", ")
        )
    }
}

/// Equations that were checked and solved: each dependent in terms of degrees of freedom that are none.
#[derive(Default)]
pub(super) struct Dependents {
    terms: BTreeMap<usize, Terms>,
}

impl Dependents {
    /// Solves the equations of a host of `size` degrees of freedom.
    ///
    /// # Errors
    /// Arrays that are wrong, a dependent that two equations give or that follows from itself, a term that is no
    /// degree of freedom: which equation.
    pub(super) fn new(equations: &Equations<'_>, size: usize) -> Result<Self, Error> {
        equations.check()?;
        let places = equations.places()?;
        let mut found = Dependents::default();
        for k in equations.order(&places)? {
            let is_nothing = |&(dof, _): &(usize, f64)| dof >= size && !places.contains_key(&dof);
            if let Some((dof, _)) = equations.terms(k).find(is_nothing) {
                let (equation, dof) = (index(k), index(dof));
                return refuse(format!(
                    "equation {equation}: there is no degree of freedom {dof}, and no equation gives it"
                ));
            }
            let mut terms = gathered(found.replaced(equations.terms(k).collect()));
            // The cosine of a right angle, or the arm of a node on the axis, is the rounding of zero and no number of its own.
            let least = ROUNDING * largest(&terms);
            terms.retain(|(_, a)| a.abs() > least);
            // Energies have its square.
            if let Some((dof, _)) = terms.iter().find(|(_, a)| !(a * a).is_finite()) {
                let (equation, dof) = (index(k), index(*dof));
                return refuse(format!(
                    "equation {equation}: the coefficient of degree of freedom {dof} overflows; choose units in \
                     which it is smaller"
                ));
            }
            found.terms.insert(equations.dependent[k], terms);
        }
        Ok(found)
    }

    /// `true` if an equation gives the degree of freedom.
    pub(super) fn have(&self, dof: usize) -> bool {
        self.terms.contains_key(&dof)
    }

    /// `true` without equations.
    pub(super) fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    /// Terms in which dependents are replaced.
    pub(super) fn replaced(&self, terms: Terms) -> Terms {
        let names_some = terms.iter().any(|(dof, _)| self.have(*dof));
        if names_some { replaced(terms, &self.terms) } else { terms }
    }

    /// The degrees of freedom below `size` that may have no stiffness of their own: dependents, and those of which they are
    /// made, as of the reference point of a rigid body.
    pub(super) fn without_own_stiffness(&self, size: usize) -> Vec<bool> {
        let mut may = vec![false; size];
        self.of_matrix(size).for_each(|(dof, _)| may[dof] = true);
        self.terms.values().flatten().for_each(|(dof, _)| may[*dof] = true);
        may
    }

    /// The largest coefficient of each degree of freedom below `size` among the terms of all dependents; 1 of one that they do not
    /// name.
    pub(super) fn largest_coefficients(&self, size: usize) -> Vec<f64> {
        let mut largest = vec![0.0_f64; size];
        for &(dof, a) in self.terms.values().flatten() {
            largest[dof] = largest[dof].max(a.abs());
        }
        largest.iter_mut().filter(|a| **a == 0.0).for_each(|a| *a = 1.0);
        largest
    }

    /// The dependents below `size`, ascending, with their terms.
    pub(super) fn of_matrix(&self, size: usize) -> impl Iterator<Item = (usize, &Terms)> {
        self.terms.range(..size).map(|(dof, terms)| (*dof, terms))
    }
}
