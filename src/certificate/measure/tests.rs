//! Rounding in a certificate.

use super::{Certificate, UNIT, certify};
use crate::problem::{ContactProblem, FrictionLaw};

/// A problem of two pairs without obstacles, held to each other by springs of 1 along the normals, loaded in balance.
fn of_two_pairs<T>(work: impl FnOnce(&ContactProblem<'_>) -> T) -> T {
    let mut k = [0.0; 16];
    (k[0], k[2], k[8], k[10]) = (1.0, -1.0, -1.0, 1.0);
    (k[5], k[15]) = (1.0, 1.0);
    let of_pairs = (&[f64::INFINITY; 2][..], FrictionLaw::Frictionless, None);
    work(&ContactProblem::of_test(2, (&k, &[1.0, 0.0, -1.0, 0.0]), of_pairs))
}

/// A measure that meets a tolerance without its rounding alone is told as that tolerance, if it is not exactly 0; one that
/// meets it with its rounding, as the bound; and what is no number stays none.
#[test]
fn what_is_told_meets_no_tolerance_that_rounding_may_miss() {
    let measured = of_two_pairs(|problem| certify(problem, &[0.0; 4]));
    let told = |eta: f64, residual: f64| {
        Certificate { eta, residual, ..measured.clone() }.with_rounding(1e-10).eta
    };
    for (eta, residual, expected) in [
        (1e-12, 2e-12, 2e-12),
        (0.0, 2e-12, 2e-12),
        (1e-12, 1e-9, 1e-10),
        (0.0, 1e-9, 0.0),
        (1e-8, 2e-8, 1e-8),
        (f64::INFINITY, f64::INFINITY, f64::INFINITY),
    ] {
        assert_eq!(told(eta, residual), expected, "{eta:e}, {residual:e}");
    }
    for residual in [1e-12, 1e-9, f64::NAN] {
        assert!(!(told(f64::NAN, residual) <= 1e-10) || residual <= 1e-10, "{residual}");
    }
}

/// Far away as a whole, the body has the forces of where it is, and sums that lose them: in twice the precision a sum of terms
/// `t` has the rounding `2^-106 t`, which is counted, beside loads of `sqrt 2` here. At `2^110` that is `2^4` and more.
#[test]
fn the_residual_counts_the_rounding_of_sums_in_twice_the_precision() {
    for (exponent, counts) in [(0, false), (60, false), (110, true), (120, true)] {
        let far = 2.0_f64.powi(exponent);
        let certificate = of_two_pairs(|problem| certify(problem, &[far, 0.0, far, 0.0]));
        let (eta, residual) = (certificate.eta, certificate.residual);
        let lost = UNIT * UNIT * 2.0 * far / 2.0_f64.sqrt();
        assert!(residual >= eta, "2^{exponent}: {residual:e} < {eta:e}");
        assert!(!counts || residual >= lost, "2^{exponent}: {residual:e} < {lost:e}");
    }
}
