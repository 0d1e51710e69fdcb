//! A structure of which the host gives exact products and a preconditioner on all of its unknowns.

use std::sync::{Mutex, PoisonError};

use super::probes::{called, check_units, checked_images, probe, refuse};
use super::{HostLoad, Reduction, SolvedCase};
use crate::error::{Error, entry, index};
use crate::linalg::last_case::LastCase;
use crate::linalg::tolerances::AGREES;
use crate::problem::{GoesOn, HeldSet, Solved, StiffnessOperator, iterated};

/// The matrix that the host's preconditioner stands for: `A` with components of `d` held, and with springs.
#[derive(Clone, Copy, Debug)]
pub struct Held<'a> {
    /// One for each component of `d`: `true` if it is held at zero.
    pub components: &'a [bool],
    /// Springs to add to `A` between the tangential components of each pair: a symmetric, positive semi-definite matrix,
    /// `(dim - 1)²` entries for each pair. Those of held components do not count.
    pub springs: &'a [f64],
    /// `false` if both are those of the call before, and that call has not failed.
    pub changed: bool,
}

/// The functions of a host on all of its unknowns, of which the relative displacements `d` are some. A function that
/// returns `Err` has failed; the message names its number.
pub trait PreconditionedOperator: Send + Sync {
    /// `y = A x`, symmetric and positive semi-definite, exact but for rounding.
    ///
    /// # Errors
    /// A number of the host.
    fn product(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32>;

    /// `z` near the solution of `A z = r` with components held and springs. No accuracy is asked, nor that the
    /// map is linear or symmetric. Entries of `r` and `z` at held components do not count.
    ///
    /// # Errors
    /// A number of the host.
    fn precondition(&self, held: &Held<'_>, r: &[f64], z: &mut [f64]) -> Result<(), i32>;
}

/// The part of the forces inside that a recovery leaves: near the rounding of doubles.
const RECOVERED: f64 = 1e-12;

/// The operator, checked.
pub struct PreconditionedReduction {
    operator: Box<dyn PreconditionedOperator>,
    dim: usize,
    pairs: usize,
    /// The host's unknown of each unknown here: the inner ones, then the components of `d`.
    places: Vec<usize>,
    /// Of each unknown here.
    units: Vec<f64>,
    /// The components held in the last call of the preconditioner, if it has succeeded.
    held: Mutex<Option<HeldSet>>,
    last: LastCase,
}

impl PreconditionedReduction {
    /// Checks the operator by some products. `units` are of the size of its diagonal, one for each unknown of the host;
    /// `components` are the unknowns that are the components of `d`, `dim` for each pair.
    ///
    /// # Errors
    /// Units that are not positive; components that are no unknowns, or one twice; which product has failed or
    /// is not finite; that the operator is not linear, symmetric, positive or reproducible.
    pub fn new(
        operator: Box<dyn PreconditionedOperator>,
        dim: usize,
        units: &[f64],
        components: &[usize],
    ) -> Result<Self, Error> {
        check_units(units)?;
        let places = places(units.len(), components)?;
        let of_place = |place: &usize| units[*place];
        let reduction = PreconditionedReduction {
            dim,
            pairs: components.len() / dim,
            units: places.iter().map(of_place).collect(),
            places,
            operator,
            held: Mutex::new(None),
            last: LastCase::default(),
        };
        if !units.is_empty() {
            let probes = [probe(units.len(), 1), probe(units.len(), 2)];
            checked_images(("A", AGREES), &probes, |x| reduction.product(x))?;
        }
        Ok(reduction)
    }

    fn inner(&self) -> usize {
        self.places.len() - self.dim * self.pairs
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

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        let x = self.to_host(x);
        Ok(self.of_host(&called("A x", x.len(), |y| self.operator.product(&x, y))?))
    }

    fn precondition(&self, held_set: &HeldSet, forces: &[f64]) -> Result<Vec<f64>, Error> {
        let mut forces = forces.to_vec();
        held_set.clear(&mut forces);
        let forces = self.to_host(&forces);
        let across = self.dim - 1;
        let rows = held_set.springs.iter().flat_map(|springs| springs.iter().take(across));
        let springs: Vec<f64> = rows.flat_map(|row| row.iter().take(across)).copied().collect();
        // One call of the host at a time, so that it knows what has changed: after a failure all may have.
        let mut last = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let changed = last.take().is_none_or(|last| last != *held_set);
        let held = Held { components: &held_set.held, springs: &springs, changed };
        let call = |z: &mut [f64]| self.operator.precondition(&held, &forces, z);
        let mut z = self.of_host(&called("the preconditioner", forces.len(), call)?);
        *last = Some(held_set.clone());
        held_set.clear(&mut z);
        Ok(z)
    }

    /// All unknowns where those of the pairs are `d`.
    fn with_pairs_at(&self, load: &[f64], d: &[f64], goes_on: GoesOn<'_>) -> Solved {
        let load = self.of_host(load);
        let inner = self.inner();
        if let Some(x) = self.last.of(&load, |x| &x[inner..] == d) {
            return Ok(Some(x));
        }
        let mut x = vec![0.0; load.len()];
        x[inner..].copy_from_slice(d);
        let (mut bodies, held_set) = (self, HeldSet::all(self.dim, self.pairs));
        let lack = bodies.residual(&x, &[], &load)?;
        let found = iterated(&mut bodies, &held_set, (&lack, RECOVERED), goes_on)?;
        let Some((step, _)) = found else {
            return Ok(None);
        };
        x.iter_mut().zip(step).take(inner).for_each(|(x, step)| *x -= step);
        Ok(Some(x))
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

impl Reduction for PreconditionedReduction {
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

    fn condense_cases(
        &self,
        cases: &[HostLoad<'_>],
        goes_on: GoesOn<'_>,
    ) -> Result<Option<Vec<Vec<f64>>>, Error> {
        let (inner, mut condensed) = (self.inner(), Vec::new());
        let nothing = vec![0.0; self.dim * self.pairs];
        for (load, _) in cases {
            let Some(x) = self.with_pairs_at(load, &nothing, goes_on)? else { return Ok(None) };
            let forces = self.product(&x)?;
            let load = self.of_host(load);
            condensed.push((inner..x.len()).map(|i| load[i] - forces[i]).collect());
        }
        Ok(Some(condensed))
    }

    fn recover_cases(&self, cases: &[SolvedCase<'_>]) -> Result<Vec<Vec<f64>>, Error> {
        let nothing = vec![0.0; self.places.len()];
        let recovered = cases.iter().map(|case| {
            let load = case.load.unwrap_or(&nothing);
            let x = self.with_pairs_at(load, case.d, &mut || true)?;
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

impl StiffnessOperator for &PreconditionedReduction {
    fn inner(&self) -> usize {
        PreconditionedReduction::inner(self)
    }

    fn units(&self) -> &[f64] {
        &self.units
    }

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        PreconditionedReduction::product(self, x)
    }

    fn is_sparse(&self) -> bool {
        true
    }

    fn is_exact(&self) -> bool {
        false
    }

    fn remember(&mut self, load: &[f64], x: &[f64]) {
        self.last.keep(load, x);
    }

    fn solve(&mut self, held: Option<&HeldSet>, forces: &[f64], _: GoesOn<'_>) -> Solved {
        let solution = match held {
            Some(held_set) => self.precondition(held_set, forces),
            None => self.precondition(&HeldSet::none(self.dim, self.pairs), forces),
        };
        solution.map(Some)
    }
}
