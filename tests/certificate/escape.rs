//! A motion proves that there is no equilibrium if and only if it strains nothing, contact cannot stop
//! it, and the loads do work on it.

use crate::common::problems::{Case, Law, block, uniform};
use fastrand::Rng;
use signorini::certificate::is_escape;
use signorini::{ContactData, ContactProblem, FrictionLaw};

/// A block of four pairs on a plane.
fn standing(press: f64, push: f64, law: Law) -> Case {
    let (mut rng, pairs) = (Rng::with_seed(1), 4);
    let k = block(&mut rng, pairs);
    let f = (0..pairs).flat_map(|_| [press / 4.0, push / 4.0]).collect();
    Case { dim: 2, pairs, k, f, gap: vec![0.0; pairs], law, slip: None }
}

/// Motions of all pairs alike, of any size: only their direction counts.
fn escapes(case: &Case, normal: f64, tangential: f64) -> bool {
    let at = |size: f64| {
        let r: Vec<f64> = (0..4).flat_map(|_| [normal * size, tangential * size]).collect();
        is_escape(&case.problem(), &r)
    };
    let answer = at(1.0);
    for exponent in [-200, -100, -30, -20, -10, 10, 20, 30, 100, 200] {
        assert_eq!(at(10_f64.powi(exponent)), answer, "({normal}, {tangential}) 1e{exponent}");
    }
    answer
}

#[test]
fn escapes_from_a_plane_are_those_of_statics() {
    let mu = |mu: f64| Law::Coulomb(vec![mu; 4]);
    // A push T against mu N: the way out slides and lifts along the edge of the friction cone.
    for (push, escapes_it) in [(3.9, false), (4.0, false), (4.1, true), (40.0, true)] {
        let case = standing(10.0, push, mu(0.4));
        assert_eq!(escapes(&case, -0.4, 1.0), escapes_it, "T = {push}");
        assert!(!escapes(&case, -0.4, -1.0), "against the push");
        assert!(!escapes(&case, -0.3, 1.0), "friction can resist a motion inside its cone");
        assert!(!escapes(&case, 0.0, 1.0), "friction can resist a slide");
        assert!(!escapes(&case, 1.0, 0.0), "the plane stops it");
    }
    // Lifted off, with any friction.
    for friction in [0.0, 0.4, 5.0] {
        let case = standing(-1.0, 0.0, mu(friction));
        assert!(escapes(&case, -1.0, 0.0));
        assert!(!escapes(&case, 1.0, 0.0));
    }
    // Without friction any push slides it; in balance nothing does.
    assert!(escapes(&standing(10.0, 0.1, mu(0.0)), 0.0, 1.0));
    assert!(!escapes(&standing(10.0, 0.0, mu(0.0)), 0.0, 1.0));
    // Given thresholds resist a push up to their sum.
    for (push, escapes_it) in [(1.9, false), (2.0, false), (2.1, true)] {
        let case = standing(10.0, push, Law::Tresca(vec![0.5; 4]));
        assert_eq!(escapes(&case, 0.0, 1.0), escapes_it, "T = {push}");
        assert!(!escapes(&case, 1e-3, 1.0), "the plane stops it");
    }
    // Without an obstacle nothing stops it, and there is no friction.
    let mut case = standing(10.0, 0.1, mu(0.4));
    case.gap.fill(f64::INFINITY);
    assert!(escapes(&case, 1.0, 0.0) && escapes(&case, 0.0, 1.0));
}

#[test]
fn motions_that_strain_prove_nothing() {
    let case = standing(-1.0, 5.0, Law::Coulomb(vec![0.0; 4]));
    let problem = case.problem();
    for seed in 0..500 {
        let mut rng = Rng::with_seed(seed);
        // Away from the plane and along the loads, but each pair its own way.
        let mut r: Vec<f64> =
            (0..4).flat_map(|_| [-rng.f64(), 1.0 + uniform(&mut rng, -0.5, 0.5)]).collect();
        for exponent in [-200, -100, -30, -20, -16, -12, -8, 0, 8, 20, 100, 200] {
            let r: Vec<f64> = r.iter().map(|r| r * 10_f64.powi(exponent)).collect();
            assert!(!is_escape(&problem, &r), "seed {seed}, 1e{exponent}");
        }
        // A rigid lift with a little strain.
        for (i, r) in r.iter_mut().enumerate() {
            let strain = uniform(&mut rng, -1e-8, 1e-8);
            *r = if i % 2 == 0 { -1.0 } else { 0.0 } + strain;
        }
        assert!(!is_escape(&problem, &r), "seed {seed}");
    }
    for r in [[0.0; 8], [f64::NAN; 8], [f64::NEG_INFINITY; 8]] {
        assert!(!is_escape(&problem, &r), "{r:?}");
    }
}

/// Loads that do nothing on a slide do nothing on a slide with rounding in it, whatever its sign.
#[test]
fn work_of_rounding_proves_nothing() {
    let mut case = standing(10.0, 0.0, Law::Coulomb(vec![0.0; 4]));
    let problem = case.problem();
    for pair in 0..4 {
        for noise in [1e-17, -1e-17, 1e-16, -1e-16, 1e-15] {
            for slide in [1.0, -1.0] {
                let mut r: Vec<f64> = (0..4).flat_map(|_| [0.0, slide]).collect();
                r[2 * pair] = noise;
                assert!(!is_escape(&problem, &r), "{r:?}");
            }
        }
    }
    // A single load leaves a work that is all noise.
    case.f.fill(0.0);
    case.f[2] = 10.0;
    let r = [0.0, -1.0, 1e-17, -1.0, 0.0, -1.0, 0.0, -1.0];
    assert!(!is_escape(&case.problem(), &r));
}

/// A body of two pairs that nothing holds, of the stiffness `a` in each direction, under `load`.
fn body(a: f64, unit: f64, load: [f64; 4], gap: f64) -> Case {
    let mut k = vec![0.0; 16];
    for c in 0..2 {
        (k[5 * c], k[5 * c + 2], k[5 * c + 8], k[5 * c + 10]) = (a, -a, -a, a);
    }
    let (f, law) = (load.map(|f| unit * f).to_vec(), Law::Coulomb(vec![0.0; 2]));
    Case { dim: 2, pairs: 2, k, f, gap: vec![gap; 2], law, slip: None }
}

/// A tension of 1 at each of two pairs holds a body that is pulled away by less, and does not hold one that is pulled away
/// by more. Without an obstacle the tension acts all the same: the law has no memory.
#[test]
fn a_tension_is_a_load() {
    for gap in [0.0, 1.0, f64::INFINITY] {
        for (pull, proves) in [(0.75, false), (1.0, false), (1.25, true)] {
            let mut case = body(1.0, 1.0, [-pull, 0.0, -pull, 0.0], gap);
            case.law = Law::Cohesive([0.0, 0.0, 1.0].repeat(2));
            let away = [-1.0, 0.0, -1.0, 0.0];
            assert_eq!(is_escape(&case.problem(), &away), proves, "{pull} at {gap}");
            // Towards the obstacle the tension drives it where nothing stops it.
            let towards = [1.0, 0.0, 1.0, 0.0];
            let driven = gap == f64::INFINITY && pull < 1.0;
            assert_eq!(is_escape(&case.problem(), &towards), driven, "{pull} at {gap}");
        }
    }
}

/// The thresholds, each from both sides and in all units: problems in powers of two, exact but for the length of
/// the motion. Work counts from 1e-9 on of what the loads could do, here 2; strain from 1e-11 on of the stiffness,
/// and an approach to an obstacle from 1e-11 on of the motion.
#[test]
fn thresholds_of_the_proof_have_no_units() {
    for stiffness in [-80, 0, 80].map(|exponent| 2_f64.powi(exponent)) {
        for unit in [-70, 0, 70].map(|exponent| 2_f64.powi(exponent)) {
            for (exponent, proves) in [(-27, true), (-28, true), (-29, false), (-31, false)] {
                let load = [1.0 + 2_f64.powi(exponent), 0.0, -1.0, 0.0];
                let case = body(stiffness, unit, load, f64::INFINITY);
                let motion = [1.0, 0.0, 1.0, 0.0];
                assert_eq!(is_escape(&case.problem(), &motion), proves, "work 2^{exponent}");
            }
            for (exponent, proves) in [(-35, false), (-36, false), (-37, true), (-39, true)] {
                let small = 2_f64.powi(exponent);
                let case = body(stiffness, unit, [1.0, 0.0, 1.0, 0.0], f64::INFINITY);
                let motion = [1.0, 0.0, 1.0 + small, 0.0];
                assert_eq!(is_escape(&case.problem(), &motion), proves, "strain 2^{exponent}");
                let case = body(stiffness, unit, [0.0, 1.0, 0.0, 1.0], 0.0);
                let motion = [small, 1.0, small, 1.0];
                assert_eq!(is_escape(&case.problem(), &motion), proves, "approach 2^{exponent}");
            }
        }
    }
}

/// Where a matrix is not symmetric, internal forces do work on a motion that strains nothing, and nothing is proved.
/// With the symmetric matrix of the body the same motion is a proof.
#[test]
fn nothing_is_proved_of_a_matrix_that_is_not_symmetric() {
    let (gap, motion) = ([f64::INFINITY; 2], [1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    for (back, expected) in [(1.0, true), (0.5, false)] {
        let mut k = vec![0.0; 36];
        for c in 0..3 {
            (k[7 * c], k[7 * c + 3], k[7 * c + 18], k[7 * c + 21]) = (1.0, -back, -1.0, back);
        }
        let data = ContactData {
            dim: 3,
            pairs: 2,
            stiffness: &k,
            ld: 6,
            load: &motion,
            gap: &gap,
            law: FrictionLaw::Frictionless,
            reference_slip: None,
        };
        let problem =
            if expected { ContactProblem::new(data) } else { ContactProblem::unsymmetric(data) };
        assert_eq!(is_escape(&problem.expect("the data are valid"), &motion), expected);
    }
}
