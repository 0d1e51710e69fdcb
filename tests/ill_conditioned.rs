//! Definite matrices next to singular ones: solved, whatever their condition number, because a motion that
//! they resist is no proof that no equilibrium exists.

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
