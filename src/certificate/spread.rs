//! The measure of bodies whose stiffness is not condensed: displacements of all unknowns.

use super::condensation::has_no_forces;
use super::escape::{of_size_one, outworks_contact};
use super::measure::{Certificate, Terms, measure_pair};
use crate::error::Error;
use crate::law::Contact;
use crate::linalg::tolerances::FREE;
use crate::linalg::vector::{dot, sizes};
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

/// True if the motion `r` of all unknowns of `bodies` proves that no equilibrium exists, as [`super::is_escape`] says of
/// one of the pairs.
///
/// # Errors
/// A failure in the host.
pub(crate) fn is_spread_escape(
    contact: &Contact<'_, MatrixFree<'_>>,
    bodies: &dyn StiffnessOperator,
    r: &[f64],
) -> Result<bool, Error> {
    let Some(r) = of_size_one(r) else { return Ok(false) };
    Ok(outworks_contact(contact, &r[bodies.inner()..]) && is_unresisted(bodies, &r)?)
}

/// True if the bodies resist the motion `r` of all their unknowns by no more than rounding of the entries of `A`.
///
/// # Errors
/// A failure in the host.
pub(crate) fn is_unresisted(bodies: &dyn StiffnessOperator, r: &[f64]) -> Result<bool, Error> {
    let nothing = vec![0.0; r.len()];
    let forces = bodies.residual(r, &nothing[..bodies.inner()], &nothing)?;
    let (size, rounding) = (sizes(r), FREE * f64::EPSILON);
    let root: Vec<f64> = bodies.units().iter().map(|unit| unit.sqrt()).collect();
    let is_free = dot(r, &forces).abs() <= rounding * dot(&size, &bodies.magnitude(&size));
    Ok(is_free && has_no_forces(r, &forces, rounding, &root))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{ContactProblem, FrictionLaw, GoesOn, HeldSet};

    /// Two springs in a row from a support to a pair, and one along its tangent.
    struct Springs;

    impl StiffnessOperator for Springs {
        fn inner(&self) -> usize {
            1
        }

        fn units(&self) -> &[f64] {
            &[2.0, 1.0, 1.0]
        }

        fn coupling(&self, _: usize, _: usize) -> f64 {
            0.0
        }

        fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
            Ok(vec![2.0 * x[0] - x[1], x[1] - x[0], x[2]])
        }

        fn residual(&self, x: &[f64], _: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
            Ok(self.product(x)?.iter().zip(load).map(|(force, load)| force - load).collect())
        }

        fn magnitude(&self, size: &[f64]) -> Vec<f64> {
            vec![2.0 * size[0] + size[1], size[0] + size[1], size[2]]
        }

        fn is_sparse(&self) -> bool {
            true
        }

        fn can_hold(&self) -> bool {
            false
        }

        fn hold(&mut self, _: &HeldSet, _: GoesOn<'_>) -> Result<bool, Error> {
            Ok(false)
        }

        fn solve(&mut self, forces: &[f64]) -> Result<Vec<f64>, Error> {
            Ok(forces.to_vec())
        }
    }

    /// The pair is pressed against its obstacle by 1 and lacks nothing whatever its force. The inner node is off by
    /// `off` from where it is in equilibrium: it lacks `2 off`, all in powers of two. Loads and forces are 1 or below.
    #[test]
    fn an_imbalance_inside_is_no_equilibrium() {
        let load = [0.0, 1.0, 0.0];
        for off in [-30, -12, -2].map(|exponent| 2_f64.powi(exponent)) {
            let springs = Springs;
            let relation = MatrixFree::new(&springs, 2, &load[1..]);
            let law = FrictionLaw::Coulomb(&[0.5]);
            let problem = ContactProblem::with_relation(relation, 2, &[0.0], law, None).unwrap();
            let contact = Contact::new(&problem);
            let x = [off, 0.0, 0.0];
            let residual = springs.residual(&x, &[], &load).unwrap();
            let certificate = measure_spread(&contact, &springs, &x, &residual);
            let scale = residual[1].abs().max(1.0);
            assert_eq!((certificate.eta, certificate.equilibrium), (2.0 * off / scale, 2.0 * off));
            assert!(!certificate.holds(off));
        }
    }
}
