//! The default method on bodies that only contact supports: solved, or proved to have no equilibrium.

use crate::common::measures::{eta, flaw_of_escape, motion, rounding};
use crate::common::problems::{
    Case, Law, block, coulomb, decades, floating, floating_case, frictionless, loaded, tresca,
    uniform,
};
use crate::common::verdict::{Verdict, run};
use fastrand::Rng;
use signorini::{Settings, Status};

fn decided(verdict: Verdict) -> bool {
    !matches!(verdict, Verdict::Unsolved { .. })
}

/// Without friction Lemke's method decides: a ray proves that nothing is feasible.
#[test]
fn frictionless_bodies_are_decided() {
    let make = |rng: &mut Rng| floating_case(rng, 6.0, |_, pairs| frictionless(pairs));
    run(3000, Settings::default(), make, decided);
}

/// Convex duality: an equilibrium or a motion that proves the contrary.
#[test]
fn bodies_under_given_thresholds_are_decided() {
    let make = |rng: &mut Rng| floating_case(rng, 2.0, tresca);
    run(1500, Settings::default(), make, decided);
}

/// With friction there may be neither equilibrium nor a proof of this kind. The ray in which Lemke's
/// method ends otherwise is a rigid motion `r`, `r_n <= 0`, that the loads drive against all that
/// friction at one state can do, which is less than a proof. So an answer may be missing, and never
/// be wrong; and where there is an equilibrium it is found in all but 1 %.
#[test]
fn bodies_with_law_are_never_judged_wrongly_and_mostly_solved() {
    let little = |rng: &mut Rng| floating_case(rng, 2.0, |rng, pairs| coulomb(rng, pairs, 0.3));
    let unsolved = run(2000, Settings::default(), little, |_| true);
    println!("{unsolved} of 2000 with little friction");
    assert!(unsolved <= 20, "{unsolved} of 2000");
    let much = |rng: &mut Rng| floating_case(rng, 4.0, |rng, pairs| coulomb(rng, pairs, 5.0));
    let settings = Settings { max_iterations: 20_000, ..Settings::default() };
    let unsolved = run(2000, settings, much, |_| true);
    println!("{unsolved} of 2000 with much friction");
    assert!(unsolved <= 20, "{unsolved} of 2000");
}

/// Where some rigid motion proves that there is no equilibrium, one is found, in all but 1 % (where a
/// pair's `r_n = 0` is no more than rounding away from `r_n > 0`). With one or two rigid motions all
/// are tried here, by half a degree.
#[test]
fn what_a_rigid_motion_can_prove_is_proved() {
    let (mut proved, mut missed) = (0, 0);
    for seed in 0..2000 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(1..=4);
        let condition = decades(&mut rng, 2.0);
        let (k, motions) = floating(&mut rng, pairs, condition);
        let law = coulomb(&mut rng, pairs, if seed % 2 == 0 { 0.3 } else { 3.0 });
        let case = loaded(&mut rng, 2, k, law);
        let solution = case.solve(&Settings { max_iterations: 2000, ..Settings::default() });
        match solution.status {
            Status::Solved => {}
            Status::NoEquilibrium => {
                assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "seed {seed}");
                proved += 1;
            }
            _ => {
                let proves = |step: u32| {
                    let (sin, cos) = f64::from(step).mul_add(0.5, 0.25).to_radians().sin_cos();
                    let second = motions.get(1);
                    let at = |i: usize| cos * motions[0][i] + second.map_or(0.0, |r| sin * r[i]);
                    let r: Vec<f64> = (0..case.size()).map(at).collect();
                    flaw_of_escape(&case, &r).is_none()
                };
                let found = (0..720).any(proves);
                if found {
                    println!("seed {seed}: a proof is missed");
                }
                missed += usize::from(found);
            }
        }
    }
    println!("{proved} proved, {missed} missed");
    assert!(proved > 200 && 100 * missed <= proved, "{missed} missed, {proved} proved");
}

/// Coulomb: a block pressed by `N` and pushed by `T` rests for `T < mu N` and slides away for
/// `T > mu N`; so close to the angle that sweeps need long.
#[test]
fn a_block_rests_below_the_friction_angle_and_slides_above() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(3..=10);
        let mu = uniform(&mut rng, 0.05, 1.0);
        let press: Vec<f64> = (0..pairs).map(|_| uniform(&mut rng, 0.9, 1.1)).collect();
        let share: Vec<f64> = (0..pairs).map(|_| rng.f64()).collect();
        let total = mu * press.iter().sum::<f64>() / share.iter().sum::<f64>();
        let side = if rng.bool() { 1.0 } else { -1.0 };
        let k = block(&mut rng, pairs);
        for ratio in [0.0, 0.5, 0.99, 1.01, 3.0] {
            let push = |i: usize| side * ratio * total * share[i];
            let case = Case {
                dim: 2,
                pairs,
                k: k.clone(),
                f: (0..pairs).flat_map(|i| [press[i], push(i)]).collect(),
                gap: vec![0.0; pairs],
                law: Law::Coulomb(vec![mu; pairs]),
                slip: None,
            };
            let solution = case.solve(&Settings::default());
            let context = || format!("seed {seed}, T = {ratio} mu N, mu {mu}: {solution:?}");
            // High friction may let edges rise as the block bends, and statics alone does not
            // promise an equilibrium; up to 0.3 all pairs stay pressed.
            if ratio < 1.0 && mu <= 0.3 {
                assert_eq!(solution.status, Status::Solved, "{}", context());
                let allowed = 1e-10 + rounding(&case, &solution.d);
                assert!(eta(&case, &solution.d) <= allowed, "{}", context());
            } else if ratio > 1.0 {
                assert_eq!(solution.status, Status::NoEquilibrium, "{}", context());
                assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "{}", context());
            }
        }
    }
}

/// Lifted off: no equilibrium, whatever the friction.
#[test]
fn a_block_that_is_lifted_leaves() {
    for seed in 0..300 {
        let mut rng = Rng::with_seed(seed);
        let pairs = rng.usize(3..=10);
        let law = match rng.bool() {
            true => coulomb(&mut rng, pairs, 2.0),
            false => frictionless(pairs),
        };
        let k = block(&mut rng, pairs);
        let mut case = loaded(&mut rng, 2, k, law);
        // Symmetric about the middle, so that it does not turn: only up.
        for i in 0..pairs {
            case.f[2 * i] = -1.0;
            case.f[2 * i + 1] = 0.0;
        }
        let solution = case.solve(&Settings::default());
        assert_eq!(solution.status, Status::NoEquilibrium, "seed {seed}: {solution:?}");
        assert_eq!(flaw_of_escape(&case, motion(&solution)), None, "seed {seed}: {solution:?}");
    }
}
