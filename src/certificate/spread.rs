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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
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

        fn product(&mut self, x: &[f64]) -> Result<Vec<f64>, Error> {
            Ok(vec![2.0 * x[0] - x[1], x[1] - x[0], x[2]])
        }

        fn residual(&mut self, x: &[f64], _: &[f64], load: &[f64]) -> Result<Vec<f64>, Error> {
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
            let mut springs = Springs;
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
