//! The thresholds of the certificate, each from both sides: problems in powers of two, whose products and
//! sums are exact, so that `eta` is zero on either side and the threshold alone decides.

use crate::common::problems::{Case, Law};
use signorini::State::{Open, Slip, Stick};
use signorini::certificate::{Certificate, certify};

/// Two pairs whose normal components have the stiffness `[[a, b], [b, c]]`; nothing couples the tangents.
fn coupled([a, b, c]: [f64; 3], load: [f64; 2], gap: [f64; 2]) -> Case {
    let mut k = vec![0.0; 16];
    (k[0], k[2], k[8], k[10]) = (a, b, b, c);
    (k[5], k[15]) = (1.0, 1.0);
    let f = vec![load[0], 0.0, load[1], 0.0];
    Case { dim: 2, pairs: 2, k, f, gap: gap.to_vec(), law: Law::Coulomb(vec![0.5; 2]), slip: None }
}

fn normal(case: &Case, d: [f64; 2]) -> Certificate {
    let certificate = certify(&case.problem(), &[d[0], 0.0, d[1], 0.0]);
    assert_eq!(certificate.eta, 0.0, "{case:?}: {certificate:?}");
    certificate
}

fn power(exponent: i32) -> f64 {
    2_f64.powi(exponent)
}

/// A body in two parts that hold each other, `[[1, -1], [-1, 1 + e]]`, is held as a whole by `e` alone. Under
/// the load 1 it moves by `1/e`, exactly. Where `e` is below 1e-12, what a host's condensation may leave of a
/// zero, the same structure may as well be free (`e = 0`), and has no equilibrium then: nothing is
/// certified. From 4e-12 on, a condition number below 1e12, it is a solution.
#[test]
fn a_body_that_rounding_alone_holds_is_not_certified() {
    for exponent in -44..=-30 {
        let e = power(exponent);
        let case = coupled([1.0, -1.0, 1.0 + e], [0.0, 1.0], [f64::INFINITY; 2]);
        let certificate = normal(&case, [1.0 / e, 1.0 / e]);
        if e < 1e-12 {
            assert!(!certificate.holds(1e-2), "2^{exponent}: {certificate:?}");
        } else if e > 4e-12 {
            assert!(certificate.holds(1e-10), "2^{exponent}: {certificate:?}");
        }
    }
}

/// No displacement that is infinite, or no number, is a solution, loaded or not: beside an interference that is nearly
/// as large as numbers are, and with any tolerance.
#[test]
fn no_infinite_displacement_is_certified() {
    for gap in [[-1e306, f64::INFINITY], [0.0, -1.0], [f64::INFINITY; 2]] {
        for load in [[0.0; 2], [1.0, 0.0], [0.0, -1.0]] {
            let case = coupled([1.0, -1.0, 1.0], load, gap);
            for (at, wrong) in (0..4).flat_map(|at| {
                [f64::INFINITY, f64::NEG_INFINITY, f64::NAN].map(|wrong| (at, wrong))
            }) {
                let mut d = [0.0, 0.0, gap[0].clamp(-1e306, 0.0), 0.0];
                d[0] = d[2];
                d[at] = wrong;
                let certificate = certify(&case.problem(), &d);
                assert!(!certificate.holds(f64::MAX), "{case:?} {d:?}: {certificate:?}");
            }
        }
    }
}

/// An interference of 1 pushes a rigid body aside that nothing else holds or loads: no force acts, and
/// rounding of the displacement has nothing to be compared with.
#[test]
fn a_free_body_is_pushed_aside_without_a_force() {
    for stiffness in [power(-40), 1.0, power(40)] {
        for gap in [power(-30), 1.0, power(30)] {
            let k = [stiffness, -stiffness, stiffness];
            let case = coupled(k, [0.0; 2], [-gap, f64::INFINITY]);
            let certificate = normal(&case, [-gap, -gap]);
            assert!(certificate.holds(1e-14), "{certificate:?}");
            assert_eq!(certificate.force, [0.0; 4]);
        }
    }
}

/// A body without loads that turns about a point: the motion `(1, L)` costs the energy `e` alone, stiffness
/// `[[L² + e, -L], [-L, 1]]`, with `e / L²` of 2e-13, rounding of a host. An interference of 1 at the first pair
/// turns it by `L` at the other. This is free up to lever arms of 1000; beyond, rounding might drive it. The unit of
/// lengths does not matter: lengths that are longer by a power of two are rounded alike.
#[test]
fn a_body_turns_about_a_gap_by_its_lever_arm() {
    for (exponent, unit) in (4..=18).flat_map(|exponent| [-40, 0, 40].map(|unit| (exponent, unit)))
    {
        let (lever, length) = (power(exponent), power(unit));
        let e = power(2 * exponent - 42);
        let k = [lever * lever + e, -lever, 1.0];
        let case = coupled(k, [0.0; 2], [-length, f64::INFINITY]);
        let certificate = normal(&case, [-length, -lever * length]);
        assert_eq!(certificate.force, [-e * length, 0.0, 0.0, 0.0]);
        let expected = lever < 1000.0;
        let place = format!("2^{exponent}, lengths of 2^{unit}: {certificate:?}");
        assert_eq!(certificate.holds(1e-10), expected, "{place}");
    }
}

/// Pairs that carry little beside others have their own states: forces of 1e-9 of the largest one are no
/// rounding, which is 1e-16 in what is computed and some 1e-13 in what a host has condensed.
#[test]
fn small_forces_tell_states() {
    for exponent in -30..=0 {
        let small = power(exponent);
        // (d, F) of the second pair, on unit stiffness with mu 1/2 and no gap: sticking, slipping, open.
        let states = [
            (Stick, [0.0, 0.0], [-small, small / 4.0]),
            (Slip, [0.0, small], [-small, -small / 2.0]),
            (Slip, [0.0, -small / 2.0], [-small, small / 2.0]),
            (Open, [-small, 0.0], [0.0, 0.0]),
        ];
        for (state, d, force) in states {
            let mut k = vec![0.0; 16];
            (0..4).for_each(|i| k[5 * i] = 1.0);
            let f = vec![1.0, 0.0, d[0] - force[0], d[1] - force[1]];
            let law = Law::Coulomb(vec![0.5; 2]);
            let case = Case { dim: 2, pairs: 2, k, f, gap: vec![0.0; 2], law, slip: None };
            let certificate = certify(&case.problem(), &[0.0, 0.0, d[0], d[1]]);
            assert!(certificate.holds(1e-14), "2^{exponent} {state:?}: {certificate:?}");
            assert_eq!(certificate.states, [Stick, state], "2^{exponent}");
            let counts = [Open, Slip, Stick].map(|state| certificate.count(state));
            let stuck = 1 + usize::from(state == Stick);
            assert_eq!(counts, [usize::from(state == Open), usize::from(state == Slip), stuck]);
            assert_eq!(certificate.force[2..], force, "2^{exponent} {state:?}");
        }
    }
}
