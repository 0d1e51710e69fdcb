//! A structure of which only products and solutions are known: the host multiplies and solves by itself. Its unknowns are the
//! relative displacements, or all of its own, of which they are some: products are exact then, and solutions those of a
//! preconditioner.

use std::sync::{Mutex, PoisonError};

use super::probes::{called, check_units, checked_images, measured_units, probe, refuse};
use super::{Condensed, Held, HostLoad, HostOperator, Reduction, SolvedCase};
use crate::error::{Error, entry, index, number};
use crate::linalg::last_case::LastCase;
use crate::linalg::tolerances::AGREES;
use crate::linalg::vector::{dot, opposite};
use crate::problem::{GoesOn, HeldSet, Solved, StiffnessOperator, iterated};

/// Every component of this number is held in the check of solutions with components held.
const HELD_IN_CHECK: usize = 3;

/// The part of the forces inside that a recovery leaves: near the rounding of doubles.
const RECOVERED: f64 = 1e-12;

/// The operator, checked.
pub struct OperatorReduction {
    operator: Box<dyn HostOperator>,
    dim: usize,
    pairs: usize,
    /// `true` if solutions are those of a preconditioner.
    is_preconditioned: bool,
    /// The host's unknown of each unknown here: the inner ones, then the components of `d`.
    places: Vec<usize>,
    /// Of each unknown here.
    units: Vec<f64>,
    /// The components held in the last call of the host, and the springs, if it has succeeded.
    held: Mutex<Option<(Vec<bool>, Vec<f64>)>>,
    last: LastCase,
}

impl OperatorReduction {
    /// Checks the operator of `pairs` pairs by some products. `units` are of the size of its diagonal; `None`: by
    /// the products.
    ///
    /// # Errors
    /// Which product has failed or is not finite; that the operator is not linear, symmetric, positive or
    /// reproducible; units that are not positive.
    pub fn new(
        operator: Box<dyn HostOperator>,
        (dim, pairs): (usize, usize),
        units: Option<&[f64]>,
    ) -> Result<Self, Error> {
        let size = dim * pairs;
        if !(operator.has_inverse() || operator.has_held()) {
            return refuse("neither inverse nor held is given: give one of them".into());
        }
        check_units(units.unwrap_or_default())?;
        let agrees = operator.accuracy();
        // Written so that NaN is refused.
        if !(agrees > 0.0 && agrees < 1.0) {
            let said = number(agrees);
            return refuse(format!("accuracy is {said}, it must be between 0 and 1"));
        }
        let places = ((0..size).collect(), vec![1.0; size]);
        let mut reduction = Self::unchecked((operator, false), (dim, pairs), places);
        if size == 0 {
            return Ok(reduction);
        }
        let probes = [probe(size, 1), probe(size, 2)];
        let products = checked_images(("K_rel", agrees), &probes, |x| (&reduction).product(x))?;
        if reduction.operator.has_inverse() {
            let images = checked_images(("W", agrees), &probes, |x| reduction.by_inverse(x))?;
            for (x, image) in probes.iter().zip(&images) {
                if !(dot(x, image) > 0.0) {
                    return refuse("W is not positive definite: x . W x is not positive".into());
                }
            }
        }
        if reduction.operator.has_held() {
            let held: Vec<bool> = (0..size).map(|i| i.is_multiple_of(HELD_IN_CHECK)).collect();
            let held_set = HeldSet { held, ..HeldSet::all(dim, pairs) };
            let [_, name] = reduction.names();
            let image = |x: &[f64]| reduction.by_held(&held_set, x);
            for image in checked_images((name, agrees), &probes, image)? {
                if let Some(i) = (0..size).find(|&i| held_set.held[i] && image[i] != 0.0) {
                    let place = entry("y", [i]);
                    return refuse(format!("{name}: {place} is held and is not 0"));
                }
            }
        }
        let measured = || measured_units(dim, &probes, &products);
        let Some(units) = units.map(<[f64]>::to_vec).or_else(measured) else {
            return refuse("K_rel resists nothing: x . K_rel x is not positive: give units".into());
        };
        reduction.units = units;
        Ok(reduction)
    }

    /// Checks an operator on all unknowns with a preconditioner by some products. `units` are of the size of its diagonal, one
    /// for each unknown of the host; `components` are the unknowns that are the components of `d`, `dim` for each pair.
    ///
    /// # Errors
    /// As [`Self::new`]; components that are no unknowns, or one twice.
    pub fn preconditioned(
        operator: Box<dyn HostOperator>,
        dim: usize,
        units: &[f64],
        components: &[usize],
    ) -> Result<Self, Error> {
        check_units(units)?;
        let places = places(units.len(), components)?;
        let own = places.iter().map(|&place| units[place]).collect();
        let pairs = (dim, components.len() / dim);
        let reduction = Self::unchecked((operator, true), pairs, (places, own));
        if !units.is_empty() {
            let probes = [probe(units.len(), 1), probe(units.len(), 2)];
            checked_images(("A", AGREES), &probes, |x| (&reduction).product(x))?;
        }
        Ok(reduction)
    }

    fn unchecked(
        (operator, is_preconditioned): (Box<dyn HostOperator>, bool),
        (dim, pairs): (usize, usize),
        (places, units): (Vec<usize>, Vec<f64>),
    ) -> Self {
        let (held, last) = (Mutex::new(None), LastCase::default());
        OperatorReduction { operator, dim, pairs, is_preconditioned, places, units, held, last }
    }

    /// A vector here as the host has it.
    fn to_host(&self, x: &[f64]) -> Vec<f64> {
        let mut host = vec![0.0; x.len()];
        self.places.iter().zip(x).for_each(|(&place, x)| host[place] = *x);
        host
    }

    fn of_host(&self, host: &[f64]) -> Vec<f64> {
        self.places.iter().map(|&place| host[place]).collect()
    }

    fn by_inverse(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        called("W x", x.len(), |y| self.operator.inverse(x, y))
    }

    /// Its product and its solution, in words.
    fn names(&self) -> [&'static str; 2] {
        match self.is_preconditioned {
            true => ["A x", "the preconditioner"],
            false => ["K_rel x", "the solution with components held"],
        }
    }

    fn by_held(&self, held_set: &HeldSet, forces: &[f64]) -> Result<Vec<f64>, Error> {
        let clear = |x: &mut [f64]| {
            if self.is_preconditioned {
                held_set.clear(x);
            }
        };
        let mut forces = forces.to_vec();
        clear(&mut forces);
        let forces = self.to_host(&forces);
        let across = if self.is_preconditioned { self.dim - 1 } else { 0 };
        let rows = held_set.springs.iter().flat_map(|springs| springs.iter().take(across));
        let springs = rows.flat_map(|row| row.iter().take(across)).copied().collect();
        let now = (held_set.held.clone(), springs);
        // One call of the host at a time, so that it knows what has changed: after a failure all may have.
        let mut last = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let changed = last.take().is_none_or(|last| last != now);
        let held = Held { components: &now.0, springs: &now.1, changed };
        let call = |y: &mut [f64]| self.operator.held(&held, &forces, y);
        let mut y = self.of_host(&called(self.names()[1], forces.len(), call)?);
        *last = Some(now);
        clear(&mut y);
        Ok(y)
    }

    /// All unknowns where those of the pairs are `d`.
    fn with_pairs_at(&self, load: &[f64], d: &[f64], goes_on: GoesOn<'_>) -> Solved {
        let inner = self.inner();
        if let Some(x) = self.last.of(load, |x| &x[inner..] == d) {
            return Ok(Some(x));
        }
        let mut x = vec![0.0; load.len()];
        x[inner..].copy_from_slice(d);
        if inner == 0 {
            return Ok(Some(x));
        }
        let (mut bodies, held_set) = (self, HeldSet::all(self.dim, self.pairs));
        let lack = bodies.residual(&x, &[], load)?;
        let found = iterated(&mut bodies, &held_set, (&lack, RECOVERED), goes_on)?;
        Ok(found.map(|(step, _)| {
            x.iter_mut().zip(step).take(inner).for_each(|(x, step)| *x -= step);
            x
        }))
    }
}

/// The host's unknown of each unknown here.
fn places(unknowns: usize, components: &[usize]) -> Result<Vec<usize>, Error> {
    let mut is_inner = vec![true; unknowns];
    for (k, &place) in components.iter().enumerate() {
        let (name, number) = (entry("place", [k]), index(place));
        match is_inner.get_mut(place) {
            Some(is_inner) if *is_inner => *is_inner = false,
            Some(_) => return refuse(format!("{name} is {number}, as one before it is")),
            None => return refuse(format!("{name} is {number}, there is no such unknown")),
        }
    }
    Ok((0..unknowns).filter(|&i| is_inner[i]).chain(components.iter().copied()).collect())
}

impl Reduction for OperatorReduction {
    fn inner_unknowns(&self) -> Option<usize> {
        Some(self.inner())
    }

    fn bodies(&self) -> Option<Box<dyn StiffnessOperator + '_>> {
        Some(Box::new(self))
    }

    fn all_loads(&self, load: &[f64], _prescribed: Option<&[f64]>) -> Vec<f64> {
        self.of_host(load)
    }

    fn host_size(&self) -> usize {
        self.places.len()
    }

    fn condense_cases(&self, cases: &[HostLoad<'_>], goes_on: GoesOn<'_>) -> Condensed {
        let mut condensed = Vec::new();
        let nothing = vec![0.0; self.dim * self.pairs];
        for (load, _) in cases {
            let load = self.of_host(load);
            let Some(x) = self.with_pairs_at(&load, &nothing, goes_on)? else { return Ok(None) };
            condensed.push(opposite(&self.residual(&x, &[], &load)?[self.inner()..]));
        }
        Ok(Some(condensed))
    }

    fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        let nothing = vec![0.0; self.places.len()];
        let recovered = cases.iter().map(|case| {
            let load = self.of_host(case.load.unwrap_or(&nothing));
            let x = self.with_pairs_at(&load, case.d, &mut || true)?;
            Ok(self.to_host(&x.unwrap_or_default()))
        });
        recovered.collect()
    }

    fn nodal_forces(&self, force: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.inner()];
        all.extend_from_slice(force);
        self.to_host(&all)
    }
}

impl StiffnessOperator for &OperatorReduction {
    fn inner(&self) -> usize {
        self.places.len() - self.dim * self.pairs
    }

    fn units(&self) -> &[f64] {
        &self.units
    }

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        let ([name, _], x) = (self.names(), self.to_host(x));
        Ok(self.of_host(&called(name, x.len(), |y| self.operator.stiffness(&x, y))?))
    }

    fn is_sparse(&self) -> bool {
        self.is_preconditioned
    }

    fn is_exact(&self) -> bool {
        !self.is_preconditioned
    }

    fn can_hold(&self) -> bool {
        self.is_preconditioned || self.operator.has_held()
    }

    fn remember(&mut self, load: &[f64], x: &[f64]) {
        if self.is_preconditioned {
            self.last.keep(load, x);
        }
    }

    fn solve(&mut self, held: Option<&HeldSet>, forces: &[f64], _: GoesOn<'_>) -> Solved {
        let none = HeldSet::none(self.dim, self.pairs);
        let held = held.or(self.is_preconditioned.then_some(&none));
        let by_held = |held_set| self.by_held(held_set, forces);
        held.map_or_else(|| self.by_inverse(forces), by_held).map(Some)
    }
}
