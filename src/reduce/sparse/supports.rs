//! Supports at contact pairs: where the slave and what it faces are both fixed, a component of the
//! relative displacement is zero.

use crate::error::{Argument, Error, index};
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::reduce::frame::Frame;
use crate::reduce::pairs::ContactPairs;

/// Place in `fixed` of each degree of freedom.
///
/// # Errors
/// A degree of freedom that does not exist or is listed twice.
pub(super) fn places_in_fixed(size: usize, fixed: &[usize]) -> Result<Vec<Option<usize>>, Error> {
    let refuse = |message: String| Err(Error::invalid(Argument::Fixed, message));
    let mut places = vec![None; size];
    for (k, &dof) in fixed.iter().enumerate() {
        let Some(place) = places.get_mut(dof) else {
            return refuse(format!("fixed: there is no degree of freedom {}", index(dof)));
        };
        if place.replace(k).is_some() {
            return refuse(format!("fixed: degree of freedom {} is listed twice", index(dof)));
        }
    }
    Ok(places)
}

/// A component of the relative displacement that supports fix.
pub(super) struct FixedComponent {
    /// The pair.
    pub(super) pair: usize,
    /// Which component of `d`.
    pub(super) component: usize,
    /// Which of the kept variables: the same, unless rows depend on each other.
    pub(super) variable: usize,
    /// The terms that fixed values give it: place in `fixed`, coefficient.
    pub(super) jump: Vec<(usize, f64)>,
}

impl FixedComponent {
    /// Rejects fixed values that would open the pair along the component.
    ///
    /// # Errors
    /// Names the pair.
    pub(super) fn check(&self, prescribed: &[f64]) -> Result<(), Error> {
        let terms = || self.jump.iter().map(|&(k, c)| c * prescribed[k]);
        let jump: f64 = terms().sum();
        if jump.abs() <= ROUNDING_OF_SUM * terms().map(f64::abs).sum::<f64>() {
            return Ok(());
        }
        let pair = index(self.pair);
        let message = format!(
            "prescribed values move both sides of pair {pair} apart by {jump}, along an axis along \
             which both are fixed: they must move alike"
        );
        Err(Error::invalid(Argument::Prescribed, message))
    }
}

/// Finds the components that supports fix, and turns their directions exactly along the axes. `None` if a
/// slave is fixed along an axis where its masters are not, or along one that is neither its normal nor a
/// tangent: then the rows are general.
pub(super) fn fixed_components(
    pairs: &ContactPairs<'_>,
    frames: &mut [Frame],
    places: &[Option<usize>],
) -> Option<Vec<FixedComponent>> {
    let mut found = Vec::new();
    for (pair, frame) in frames.iter_mut().enumerate() {
        for (axis, &slave) in pairs.slave(pair)?.iter().enumerate() {
            let Some(place) = places[slave] else { continue };
            let mut jump = vec![(place, 1.0)];
            for (weight, master) in pairs.masters_of(pair) {
                match places[master[axis]] {
                    Some(place) => jump.push((place, -weight)),
                    // A weight of rounding's size is none.
                    None if weight.abs() <= ROUNDING_OF_SUM => {}
                    None => return None,
                }
            }
            let along = frame.component_along(axis)?;
            frame.align(along, axis);
            let component = pairs.dim * pair + along;
            found.push(FixedComponent { pair, component, variable: component, jump });
        }
    }
    Some(found)
}
