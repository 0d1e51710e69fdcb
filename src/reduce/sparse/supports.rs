//! Supports at contact pairs: where the slave and what it faces are both fixed, a component of the
//! relative displacement is zero.

use crate::error::{Argument, Error, index, number};
use crate::linalg::tolerances::ROUNDING_OF_SUM;
use crate::reduce::equations::Dependents;

/// Place in `fixed` of each degree of freedom.
///
/// # Errors
/// A degree of freedom that does not exist, is listed twice or is dependent.
pub(super) fn places_in_fixed(
    size: usize,
    fixed: &[usize],
    dependents: &Dependents,
) -> Result<Vec<Option<usize>>, Error> {
    let refuse = |message: String| Argument::Fixed.refuse(message);
    let mut places = vec![None; size];
    for (k, &dof) in fixed.iter().enumerate() {
        let Some(place) = places.get_mut(dof) else {
            return refuse(format!("fixed: there is no degree of freedom {}", index(dof)));
        };
        if place.replace(k).is_some() {
            return refuse(format!("fixed: degree of freedom {} is listed twice", index(dof)));
        }
        if dependents.have(dof) {
            return refuse(format!(
                "fixed: degree of freedom {} is dependent by an equation: leave it out of fixed, or leave its \
                 equation out",
                index(dof)
            ));
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
        Argument::Prescribed.refuse(format!(
            "prescribed values move both sides of pair {pair} apart by {}, along an axis along which \
             both are fixed: they must move alike",
            number(jump)
        ))
    }
}
