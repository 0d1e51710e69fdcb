//! Definite matrices next to singular ones: solved, whatever their condition number, because a motion that
//! they resist is no proof that no equilibrium exists.

use crate::common::problems::definite;
use fastrand::Rng;
use signorini::certificate::is_escape;
use signorini::{
    ContactData, ContactProblem, FrictionLaw, Monitor, Settings, Solution, Status, solve,
};

/// One pair without friction, pulled off its obstacle: `K = [[1 + e, -1], [-1, 1 + e]]`, `f = (-1, 0)`.
fn pulled(k: &[f64]) -> ContactProblem<'_> {
    ContactProblem::new(ContactData {
        dim: 2,
        pairs: 1,
        stiffness: k,
        ld: 2,
        load: &[-1.0, 0.0],
        gap: &[0.0],
        law: FrictionLaw::Frictionless,
        reference_slip: None,
    })
    .expect("the data are valid")
}

fn solved(problem: &ContactProblem<'_>) -> Solution {
    let settings = Settings::default();
    solve(problem, &settings, None, &mut Monitor::new(&settings, None)).expect("the settings fit")
}

/// The pair is open, so that `d = K⁻¹ f = -(1 + e, 1) / (e (2 + e))`, with the `e` that is left of it in
/// `1 + e`. A residual of the tolerance, 1e-10, is a load that changes by as much; `d` follows it.
#[test]
fn a_pair_on_a_soft_spring_is_solved() {
    for power in -11..=-6 {
        let a = 1.0 + 10_f64.powi(power);
        let e = a - 1.0;
        let k = [a, -1.0, -1.0, a];
        let solution = solved(&pulled(&k));
        assert_eq!(solution.status, Status::Solved, "1e{power}: {}", solution.message);
        for (d, exact) in solution.d.iter().zip([a, 1.0].map(|x| -x / (e * (2.0 + e)))) {
            assert!((d / exact - 1.0).abs() <= 2e-10, "1e{power}: {d:e} is not {exact:e}");
        }
    }
}

/// A spring of 1e-11 may be the rounding of a condensation, and `d` is 5e10 times what the load asks for; one of 1e-6 is
/// neither.
#[test]
fn what_only_rounding_may_hold_gets_a_remark() {
    for (power, remarked) in [(-11, true), (-6, false)] {
        let a = 1.0 + 10_f64.powi(power);
        let solution = solved(&pulled(&[a, -1.0, -1.0, a]));
        assert_eq!(solution.status, Status::Solved, "1e{power}: {}", solution.message);
        assert_eq!(solution.remarks.held_by_rounding, remarked, "1e{power}");
        let said = solution.message.contains("only rounding of K holds a body");
        assert_eq!(said, remarked, "1e{power}: {}", solution.message);
    }
}

/// The energy `r . K r = 2 e` of `r = (-1, -1)` is above what the last digits of the entries explain,
/// `eps |r| . |K| |r| = 4 eps`, from `e = 1e-15` on; without the spring the motion is a proof.
#[test]
fn the_motion_along_a_soft_spring_is_no_proof() {
    let along = [-1.0, -1.0];
    for power in -15..=-6 {
        let a = 1.0 + 10_f64.powi(power);
        assert!(!is_escape(&pulled(&[a, -1.0, -1.0, a]), &along), "1e{power}");
    }
    let k = [1.0, -1.0, -1.0, 1.0];
    assert!(is_escape(&pulled(&k), &along));
    assert_eq!(solved(&pulled(&k)).status, Status::NoEquilibrium);
}

/// Components whose stiffnesses are up to 1e290 apart: `D A D` with a definite `A`, condition at most 100, and a
/// diagonal `D`, so that the matrix is definite and a solution exists under every law. Loads as small as the softest
/// component, so that motions without any resistance and those with a little are far apart in length too.
#[test]
fn components_far_apart_are_no_rigid_motion() {
    let mut rng = Rng::with_seed(14);
    for round in 0..600 {
        let (dim, pairs) = (rng.usize(2..=3), rng.usize(1..=3));
        let n = dim * pairs;
        let soft = 10_f64.powf(-[4.0, 8.0, 25.0, 72.0, 145.0][rng.usize(..5)]);
        let is_soft = |i: usize| i.is_multiple_of(dim) == (round % 2 == 0);
        let scale: Vec<f64> = (0..n).map(|i| if is_soft(i) { soft } else { 1.0 }).collect();
        let mut k = definite(&mut rng, n, 100.0);
        for (i, k) in k.iter_mut().enumerate() {
            *k *= scale[i % n] * scale[i / n];
        }
        let size = if rng.bool() { soft * soft } else { 1.0 };
        let load: Vec<f64> = (0..n).map(|_| size * (2.0 * rng.f64() - 1.0)).collect();
        let gap: Vec<f64> = (0..pairs).map(|_| if rng.bool() { rng.f64() } else { 0.0 }).collect();
        let numbers: Vec<f64> = (0..pairs).map(|_| rng.f64()).collect();
        let law = [FrictionLaw::Coulomb(&numbers), FrictionLaw::Tresca(&numbers)][rng.usize(..2)];
        let law = if rng.u8(..4) == 0 { FrictionLaw::Frictionless } else { law };
        let problem = ContactProblem::new(ContactData {
            dim,
            pairs,
            stiffness: &k,
            ld: n,
            load: &load,
            gap: &gap,
            law,
            reference_slip: None,
        });
        let solution = solved(&problem.expect("the data are valid"));
        assert_ne!(
            solution.status,
            Status::NoEquilibrium,
            "{round}: {k:?} {load:?} {gap:?} {law:?}"
        );
    }
}
