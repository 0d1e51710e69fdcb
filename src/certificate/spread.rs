//! The measure of bodies whose stiffness is not condensed: displacements of all unknowns.

use super::condensation::has_no_forces;
use super::escape::{of_size_one, outworks_contact};
use super::measure::{Certificate, Terms, measure_pair};
use crate::error::Error;
use crate::law::Contact;
use crate::linalg::tolerances::FREE;
use crate::linalg::vector::{dot, norm, sizes};
use crate::problem::{MatrixFree, StiffnessOperator};

/// Measures the displacements `x` of all unknowns of `bodies`, whose residual `A x - b` is given. What the
/// inner unknowns lack to equilibrium counts in `eta` as a force.
///
/// A motion that nothing holds moves the pairs: with all of them held the bodies are definite. So it is no part of the
/// displacements `x0` where those of the pairs are zero, however large the loads are that they come from, and rounding
/// that may hide it is that of the terms `|A| |x - x0|`.
pub(crate) fn measure_spread(
    contact: &Contact<'_, MatrixFree<'_>>,
    bodies: &dyn StiffnessOperator,
    x: &[f64],
    residual: &[f64],
) -> Certificate {
    let d = &x[bodies.inner()..];
    let (inner, raw) = residual.split_at(bodies.inner());
    let at_zero = contact.problem().relation().at_zero;
    let moved: Vec<f64> = x.iter().zip(at_zero).map(|(x, at_zero)| x - at_zero).collect();
    let terms = Terms::of_all(contact, d, (&moved, None), &|size| bodies.magnitude(size));
    let terms = terms.among(bodies.magnitude(&sizes(x)));
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
    let r = of_size_one(r);
    let rounding = contact.problem().relation().rounding * norm(&r);
    let of_pairs = &r[bodies.inner()..];
    Ok(outworks_contact(contact, of_pairs, rounding) && is_unresisted(bodies, &r)?)
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
    use crate::problem::{ContactProblem, FrictionLaw, GoesOn, HeldSet, Solved};

    /// Two springs in a row from a support to a pair, the first of the stiffness `support`, and one along its tangent.
    struct Springs {
        support: f64,
        units: [f64; 3],
    }

    impl Springs {
        fn on(support: f64) -> Self {
            Springs { support, units: [1.0 + support, 1.0, 1.0] }
        }
    }

    impl StiffnessOperator for Springs {
        fn inner(&self) -> usize {
            1
        }

        fn units(&self) -> &[f64] {
            &self.units
        }

        fn product(&self, x: &[f64]) -> Result<Vec<f64>, Error> {
            Ok(vec![self.support * x[0] + (x[0] - x[1]), x[1] - x[0], x[2]])
        }

        fn magnitude(&self, size: &[f64]) -> Vec<f64> {
            vec![self.units[0] * size[0] + size[1], size[0] + size[1], size[2]]
        }

        fn is_sparse(&self) -> bool {
            true
        }

        fn can_hold(&self) -> bool {
            false
        }

        fn solve(&mut self, _: Option<&HeldSet>, forces: &[f64], _: GoesOn<'_>) -> Solved {
            Ok(Some(forces.to_vec()))
        }
    }

    /// The pair is pressed against its obstacle by 1 and lacks nothing whatever its force. The inner node is off by
    /// `off` from where it is in equilibrium: it lacks `2 off`, all in powers of two. Loads and forces are 1 or below.
    #[test]
    fn an_imbalance_inside_is_no_equilibrium() {
        let load = [0.0, 1.0, 0.0];
        for off in [-30, -12, -2].map(|exponent| 2_f64.powi(exponent)) {
            let springs = Springs::on(1.0);
            let relation = MatrixFree::new(&springs, 2, &load[1..], &[0.0; 3]);
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

    /// True if a motion proves that two parts, with springs of these stiffnesses, have no equilibrium under a load on the pair.
    fn escapes(support: f64, (load, gap): (f64, f64), motion: [f64; 3]) -> bool {
        let (springs, load, gap) = (Springs::on(support), [load, 0.0], [gap]);
        let relation = MatrixFree::new(&springs, 2, &load, &[0.0; 3]);
        let law = FrictionLaw::Coulomb(&[0.5]);
        let problem = ContactProblem::with_relation(relation, 2, &gap, law, None).unwrap();
        is_spread_escape(&Contact::new(&problem), &springs, &motion).unwrap()
    }

    /// Two parts without a support are driven towards the pair, where no obstacle stops them, or away from it.
    #[test]
    fn free_bodies_escape_where_the_load_drives_them() {
        let none = f64::INFINITY;
        for size in [1e-200, 1e-20, 1.0, 1e20, 1e200] {
            let of = |motion: [f64; 3]| motion.map(|r| size * r);
            assert!(escapes(0.0, (1.0, none), of([1.0, 1.0, 0.0])));
            assert!(escapes(0.0, (-1.0, 0.0), of([-1.0, -1.0, 0.0])));
            assert!(!escapes(0.0, (1.0, 0.0), of([1.0, 1.0, 0.0])), "the obstacle stops it");
            assert!(!escapes(0.0, (1.0, none), of([-1.0, -1.0, 0.0])), "against the load");
            assert!(!escapes(0.0, (0.0, none), of([1.0, 1.0, 0.0])), "nothing drives it");
            assert!(!escapes(1.0, (1.0, none), of([1.0, 1.0, 0.0])), "the support holds it");
            for strained in [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [-1.0, 1.0, 0.0]] {
                assert!(!escapes(0.0, (1.0, none), of(strained)), "{strained:?}");
            }
        }
        for nothing in [0.0, f64::NAN, f64::INFINITY] {
            assert!(!escapes(0.0, (1.0, none), [nothing, nothing, 0.0]), "{nothing}");
            assert!(!escapes(0.0, (1.0, none), [nothing, 0.0, 0.0]), "{nothing} inside");
        }
    }

    /// The thresholds, each from both sides, in powers of two. A strain counts from 1e-11 of the motion on; a spring
    /// `e` that holds both parts from 3 roundings of the energy on, whose terms are 4: `e` against 2.7e-15.
    #[test]
    fn little_strain_and_soft_springs_resist() {
        let power = |exponent| 2_f64.powi(exponent);
        for (exponent, is_free) in [(-35, false), (-36, false), (-37, true), (-39, true)] {
            let motion = [1.0, 1.0 - power(exponent), 0.0];
            let answer = is_unresisted(&Springs::on(0.0), &motion).unwrap();
            assert_eq!(answer, is_free, "strain 2^{exponent}");
        }
        for (exponent, is_free) in [(-40, false), (-48, false), (-49, true), (-52, true)] {
            let springs = Springs::on(power(exponent));
            let answer = is_unresisted(&springs, &[1.0, 1.0, 0.0]).unwrap();
            assert_eq!(answer, is_free, "spring 2^{exponent}");
        }
    }
}
