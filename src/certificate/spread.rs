//! The measure of bodies whose stiffness is not condensed: displacements of all unknowns.

use super::measure::{Certificate, Terms, measure_pair};
use crate::law::Contact;
use crate::problem::{MatrixFree, StiffnessOperator};

/// Measures the displacements `x` of all unknowns of `bodies`, whose residual `A x - b` is given. What the
/// inner unknowns lack to equilibrium counts in `eta` as a force.
pub(crate) fn measure_spread(
    contact: &Contact<'_, MatrixFree<'_>>,
    bodies: &dyn StiffnessOperator,
    x: &[f64],
    residual: &[f64],
) -> Certificate {
    let d = &x[bodies.inner()..];
    let (inner, raw) = residual.split_at(bodies.inner());
    let terms = Terms::of_all(contact, d, x, &|size| bodies.magnitude(size));
    measure_pair(contact, (d, &[]), &terms, raw.to_vec(), (&[], inner))
}
