//! A structure of which only products and solutions are known: the host multiplies and solves by itself.

use std::sync::{Mutex, PoisonError};

use super::Reduction;
use super::probes::{called, check_units, checked_images, measured_units, probe, refuse};
use crate::error::{Error, entry, number};
use crate::linalg::tolerances::AGREES;
use crate::linalg::vector::dot;
use crate::problem::{GoesOn, HeldSet, Solved, StiffnessOperator};

/// The functions of a host. Vectors are relative displacements and forces of the pairs. A function that returns
/// `Err` has failed; the message names its number.
pub trait HostOperator: Send + Sync {
    /// `y = K_rel x`, symmetric and positive semi-definite.
    ///
    /// # Errors
    /// A number of the host.
    fn stiffness(&self, x: &[f64], y: &mut [f64]) -> Result<(), i32>;

    /// The part of their sizes to which products and solutions are linear, symmetric and the same each time: no tolerance
    /// below it can be met.
    fn accuracy(&self) -> f64 {
        AGREES
    }

    /// Returns `true` if there is [`Self::inverse`].
    fn has_inverse(&self) -> bool {
        false
    }

    /// `y = W x`, symmetric and positive definite, close to the inverse of `K_rel`.
    ///
    /// # Errors
    /// A number of the host.
    fn inverse(&self, _x: &[f64], _y: &mut [f64]) -> Result<(), i32> {
        Err(-1)
    }

    /// Returns `true` if there is [`Self::held`].
    fn has_held(&self) -> bool {
        false
    }

    /// `y`, zero in components that are `held`, with `K_rel y = x` in the others. `changed`: others are held than in
    /// the call before, or that call has failed.
    ///
    /// # Errors
    /// A number of the host.
    fn held(&self, _held: &[bool], _changed: bool, _x: &[f64], _y: &mut [f64]) -> Result<(), i32> {
        Err(-1)
    }
}

/// Every component of this number is held in the check of solutions with components held.
const HELD_IN_CHECK: usize = 3;

/// The operator, checked.
pub struct OperatorReduction {
    operator: Box<dyn HostOperator>,
    units: Vec<f64>,
    /// The components that were held in the last call of the host, if it has succeeded.
    held: Mutex<Vec<bool>>,
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
        let held = Mutex::new(Vec::new());
        let reduction = OperatorReduction { operator, units: vec![1.0; size], held };
        if size == 0 {
            return Ok(reduction);
        }
        let probes = [probe(size, 1), probe(size, 2)];
        let products = checked_images(("K_rel", agrees), &probes, |x| reduction.product(x))?;
        if reduction.operator.has_inverse() {
            let images = checked_images(("W", agrees), &probes, |x| reduction.by_inverse(x))?;
            for (x, image) in probes.iter().zip(&images) {
                if !(dot(x, image) > 0.0) {
                    return refuse("W is not positive definite: x . W x is not positive".into());
                }
            }
        }
        if reduction.operator.has_held() {
            let mask: Vec<bool> = (0..size).map(|i| i.is_multiple_of(HELD_IN_CHECK)).collect();
            let name = "the solution with components held";
            let images = checked_images((name, agrees), &probes, |x| reduction.by_held(&mask, x))?;
            for image in images {
                if let Some(i) = (0..size).find(|&i| mask[i] && image[i] != 0.0) {
                    let place = entry("y", [i]);
                    return refuse(format!("{name}: {place} is held and is not 0"));
                }
            }
        }
        let measured = || measured_units(dim, &probes, &products);
        let Some(units) = units.map(<[f64]>::to_vec).or_else(measured) else {
            return refuse("K_rel resists nothing: x . K_rel x is not positive: give units".into());
        };
        Ok(OperatorReduction { units, ..reduction })
    }

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        called("K_rel x", x.len(), |y| self.operator.stiffness(x, y))
    }

    fn by_inverse(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        called("W x", x.len(), |y| self.operator.inverse(x, y))
    }

    fn by_held(&self, held: &[bool], x: &[f64]) -> Result<Vec<f64>, Error> {
        // One call of the host at a time, so that it knows what has changed: after a failure all may have.
        let mut last = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let changed = last.as_slice() != held;
        last.clear();
        let name = "the solution with components held";
        let y = called(name, x.len(), |y| self.operator.held(held, changed, x, y))?;
        last.extend_from_slice(held);
        Ok(y)
    }
}

impl Reduction for OperatorReduction {
    fn inner_unknowns(&self) -> Option<usize> {
        Some(0)
    }

    fn bodies(&self) -> Option<Box<dyn StiffnessOperator + '_>> {
        Some(Box::new(self))
    }

    fn host_size(&self) -> usize {
        self.units.len()
    }
}

impl StiffnessOperator for &OperatorReduction {
    fn inner(&self) -> usize {
        0
    }

    fn units(&self) -> &[f64] {
        &self.units
    }

    fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
        OperatorReduction::product(self, x)
    }

    fn is_sparse(&self) -> bool {
        false
    }

    fn can_hold(&self) -> bool {
        self.operator.has_held()
    }

    fn solve(&mut self, held: Option<&HeldSet>, forces: &[f64], _: GoesOn<'_>) -> Solved {
        let solution = match held {
            Some(held_set) => self.by_held(&held_set.held, forces),
            None => self.by_inverse(forces),
        };
        solution.map(Some)
    }
}
